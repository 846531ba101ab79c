"""Lists in brackets where an expression is needed."""

from __future__ import annotations

import pytest

from bbsd.language.fixing import fixed
from bbsd.language.loading import check
from bbsd.text import Source
from tests.unit.language.meant.docking import SPEC, corrected, made

STATE = "    speed: 0\n    seen"
REWARD = "  docked: 1 if distance == 0 else 0"


def goal(value: str) -> str:
    return f"    speed: 0\n    goal: {value}\n    seen"


@pytest.mark.parametrize(
    ("value", "right"),
    [
        ("[8, 8]", "list(8, 8)"),
        ("[[1, 2], [3, 4]]", "list(list(1, 2), list(3, 4))"),
        ("[9, 8, 7]", "list(9, 8, 7)"),
    ],
)
def test_a_list_is_written_as_an_expression(value: str, right: str) -> None:
    source = made(STATE, goal(value))
    assert corrected(source) == made(STATE, goal(right)).text
    assert fixed(source).source.text == made(STATE, goal(right)).text


def test_nothing_is_told_of_its_elements() -> None:
    text = made(STATE, goal("[2, 5]")).text.replace(
        REWARD, REWARD + "\n  near: sum(goal[r][1] for r in team)"
    )
    (mistake,) = check(Source("docking.yaml", text))
    assert mistake.correction is not None
    assert mistake.correction.is_certain
    assert check(Source("docking.yaml", text).edited(mistake.correction.edits)) == ()


def test_two_numbers_that_are_never_indexed_are_probably_drawn_between() -> None:
    source = made("    distance: uniform(2, 5)", "    distance: [2, 5]")
    assert corrected(source) == SPEC
    assert fixed(source).source == source


@pytest.mark.parametrize("value", ["(8, 8)", "8, 8", "list[8, 8]"])
def test_an_unreadable_list_is_told_once(value: str) -> None:
    text = made(STATE, goal(value)).text.replace(REWARD, REWARD + "\n  near: sum(goal[r][1] for r in team)")
    assert len(check(Source("docking.yaml", text))) == 1


def test_a_list_that_is_used_as_one_number_is_not_corrected_to_a_list() -> None:
    source = made("    distance: uniform(2, 5)", "    distance: [2, 5, 3]")
    (mistake,) = check(source)
    assert mistake.correction is None
    assert mistake.advice == "it is used as one number; a list would be list(2, 5, 3)"
    assert fixed(source).source == source


def test_two_expressions_that_are_used_as_one_number_are_probably_drawn_between() -> None:
    source = made("    distance: uniform(2, 5)", '    distance: [2, "2 + 3"]')
    assert corrected(source) == made("uniform(2, 5)", "uniform(2, 2 + 3)").text
    assert fixed(source).source == source
