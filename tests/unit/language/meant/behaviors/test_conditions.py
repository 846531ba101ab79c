"""Cells and lists of truths where a condition is needed."""

from __future__ import annotations

import pytest

from bbsd.language.fixing import fixed
from bbsd.language.loading import check
from tests.unit.language.meant.docking import corrected, made

HEAD = "  drive:\n"


def excited(condition: str) -> str:
    return f"  drive:\n    excited: {condition}\n"


@pytest.mark.parametrize(
    ("cells", "condition"),
    [
        ("{zone: below 0.2}", "distance < 0.2"),
        ("{zone: from 1}", "distance >= 1"),
        ("{zone: below 0.3}", "distance < 0.3"),
        ("{zone: [below 0.2, 0.2 to 1]}", "distance < 0.2 or 0.2 <= distance < 1"),
        ("{contact: true}", "contact"),
        ("{contact: false, mode: near}", "not contact and mode == near"),
        ("{contact: true, zone: [below 0.2, from 1]}", "contact and (distance < 0.2 or distance >= 1)"),
        ("{when: {contact: true}}", "contact"),
        ("{distance: below 0.5}", "distance < 0.5"),
        ("[contact]", "contact"),
    ],
)
def test_cells_are_written_as_their_condition(cells: str, condition: str) -> None:
    source = made(HEAD, excited(cells))
    right = made(HEAD, excited(condition)).text
    assert corrected(source) == right
    assert fixed(source).source.text == right


def test_cells_below_the_key_are_written_on_its_line() -> None:
    source = made(HEAD, "  drive:\n    excited:\n      zone: below 0.2\n      contact: true\n")
    assert corrected(source) == made(HEAD, excited("distance < 0.2 and contact")).text


def test_a_list_of_truths_is_one_of_two_conditions() -> None:
    source = made(HEAD, excited("[contact, distance < 1]"))
    assert corrected(source) == made(HEAD, excited("contact and distance < 1")).text
    assert "contact or distance < 1" in check(source)[0].advice
    assert fixed(source).source == source


@pytest.mark.parametrize("cells", ["{zone: near}", "{nothing: true}", "{mode: home}"])
def test_cells_that_are_none_are_told_without_a_line(cells: str) -> None:
    (mistake,) = check(made(HEAD, excited(cells)))
    assert mistake.message == "excited is a condition, not cells"
    assert mistake.correction is None
