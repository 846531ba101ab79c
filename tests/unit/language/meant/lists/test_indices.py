"""Elements in parentheses, and counted from 1."""

from __future__ import annotations

import pytest

from bbsd.language.fixing import fixed
from bbsd.language.loading import check
from bbsd.text import Source
from tests.unit.language.meant.docking import corrected, made

HEAD = "constants:\n"
REWARD = "  docked: 1 if distance == 0 else 0"


def rewarded(*terms: str) -> str:
    """Return the spec with two constant lists and terms that use them."""
    text = made(HEAD, HEAD + "  lamp: [8, 6]\n  room: [[1, 2], [3, 4]]\n").text
    named = "".join(f"\n  term_{at}: {term}" for at, term in enumerate(terms))
    return text.replace(REWARD, REWARD + named)


def spec(*terms: str) -> Source:
    return Source("docking.yaml", rewarded(*terms))


@pytest.mark.parametrize(
    ("term", "right"),
    [
        ("lamp(1) + lamp(2)", "lamp[0] + lamp[1]"),
        ("hypot(lamp(1), lamp(end))", "hypot(lamp[0], lamp[1])"),
        ("room(1, 2) - lamp(1)", "room[0][1] - lamp[0]"),
        ("lamp[1] + lamp[2]", "lamp[0] + lamp[1]"),
        ("lamp{1} + lamp{2}", "lamp[0] + lamp[1]"),
    ],
)
def test_elements_counted_from_one_are_told_once_and_proposed(term: str, right: str) -> None:
    source = spec(term)
    assert corrected(source) == rewarded(right)
    assert fixed(source).source == source


@pytest.mark.parametrize(
    ("term", "right"),
    [
        ("lamp(0) + lamp(1)", "lamp[0] + lamp[1]"),
        ("sum(lamp(k) for k in range(2))", "sum(lamp[k] for k in range(2))"),
        ("sum(distance(r) for r in team)", "sum(distance[r] for r in team)"),
    ],
)
def test_elements_counted_from_zero_are_certain(term: str, right: str) -> None:
    assert fixed(spec(term)).source.text == rewarded(right)


def test_all_indices_of_a_list_are_corrected_together() -> None:
    assert corrected(spec("lamp[1]", "1 + lamp[2]", "room[1][1]")) == rewarded(
        "lamp[0]", "1 + lamp[1]", "room[1][1]"
    )


def test_a_list_that_begins_at_zero_elsewhere_is_corrected_where_it_does_not() -> None:
    assert corrected(spec("lamp[0]", "lamp[1] + lamp[2]")) == rewarded("lamp[0]", "lamp[0] + lamp[1]")


def test_one_index_too_large_is_the_last() -> None:
    (mistake,) = check(spec("lamp[0] + lamp[2]"))
    assert mistake.message == "there is no element 2; the 2 count from 0 to 1"
    assert mistake.advice == "the last is 1"


def test_what_is_wrong_beside_them_is_told_without_a_line() -> None:
    (element, name) = check(spec("lamp(1) + lamp(2) + lmp"))
    assert {element.code, name.code} == {"BB052", "BB053"}
    assert [each.code for each in (element, name) if each.correction] == ["BB053"]
