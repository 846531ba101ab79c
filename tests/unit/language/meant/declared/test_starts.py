"""Values that start as something else than they are used as are told at their start, and only there."""

import pytest

from bbsd.language.loading import check
from tests.unit.language.specs import source

LATE = """
environment:
  state: {late: %s}
  dynamics: {late: %s}
reward: {late: %s}
"""
WALK = """
constants: {room: [[0, 0, 1], [0, 1, 0], [1, 0, 0]]}
environment:
  state: {x: "%s"}
  definitions: {"wall(at)": "room[at][0] == 1"}
behaviors:
  stop:
    actions: {right: {x: "%s"}}
    inputs: {ahead: wall(x + 1)}
"""


def told(part: str) -> list[tuple[str, str | None]]:
    """Return the message of each mistake, and what is written for it."""
    found = check(source(part))
    return [(each.message, each.correction.edits[0].text if each.correction else None) for each in found]


@pytest.mark.parametrize(
    ("start", "after", "reward", "expected"),
    [
        ("0", "step > 3", "1 if late else 0", ["late starts as a number, 0, and is set to a truth everywhere else"]),
        ("1", "not late", "0", ["late starts as a number, 1, and is set to a truth everywhere else"]),
        ("0", "true if step > 3 else late", "0", ["late starts as a number, 0, and is set to a truth everywhere else"]),
        ("false", "late + 1", "late", ["late starts as a truth, false, and is set to a number everywhere else"]),
        ("0", "1", "1 if late and step > 2 else 0",
         ["late starts as a number, 0, and is used as a truth everywhere else"]),
        ("0", "step > 3", "2 * late", ["a truth, where a number is needed"]),
        ("0", "2", "1 if late else 0", ["a number, where a truth is needed"]),
        ("false", "1", "1 if late else 0", ["a number, where a truth is needed"]),
        ("0.5", "step > 3", "0", ["a truth, where a number is needed"]),
    ],
)  # fmt: skip
def test_a_truth_that_starts_as_a_number(start: str, after: str, reward: str, expected: list[str]) -> None:
    found = [message.partition(" (line")[0] for message, _ in told(LATE % (start, after, reward))]
    assert found == expected


def test_what_is_written_for_it() -> None:
    assert told(LATE % ("0", "step > 3", "1 if late else 0"))[0][1] == "false"
    assert told(LATE % ("1", "step > 3", "1 if late else 0"))[0][1] == "true"
    assert told(LATE % ("true", "late + 1", "late"))[0][1] == "1"
    both = check(source(LATE % ("0", "1", "1 if late else 0")))[0].correction
    assert both is not None
    assert [edit.text for edit in both.edits] == ["false", "true"]
    assert not both.is_certain


@pytest.mark.parametrize(
    ("start", "sets", "expected"),
    [
        ("uniform(0, 2)", "min(x + 1, 2)",
         [("uniform(0, 2) need not be a whole number, and x is used as an index", "integers(0, 2)")]),
        ("uniform(0, 2.5)", "x + 1",
         [("uniform(0, 2.5) need not be a whole number, and x is used as an index", "round(uniform(0, 2.5))")]),
        ("uniform(0, 2)", "x + 0.5",
         [("uniform(0, 2) need not be a whole number, and x is used as an index", None)]),
        ("integers(0, 2)", "x / 2", [("x / 2 need not be a whole number, and x is used as an index", None)]),
        ("0", "x + 6 / 2 + lost", [('unknown name "lost"', None)]),
        ("integers(0, 2)", "floor(x / 2)", []),
        ("integers(0, 2)", "x + 1", []),
    ],
)  # fmt: skip
def test_a_fraction_as_an_index(start: str, sets: str, expected: list[tuple[str, str | None]]) -> None:
    assert [
        (message.partition(" (line")[0], text) for message, text in told(WALK % (start, sets))
    ] == expected
