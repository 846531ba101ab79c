"""Definitions without their parameters, and tables with one row of another length, are told where they are written."""

import pytest

from bbsd.language.loading import check
from tests.unit.language.specs import source

CALLED = """
constants: {least: 2}
environment:
  definitions: {"%s": "%s"}
reward: {near: "%s"}
"""
TABLE = """
constants: {room: %s}
environment:
  state: {x: "integers(0, 2)"}
reward: {free: "%s"}
"""


def messages(part: str) -> list[str]:
    return [each.message.partition(" (line")[0] for each in check(source(part))]


@pytest.mark.parametrize(
    ("key", "value", "use", "expected"),
    [
        ("gap", "abs(a - b) - least", "gap(height, speed)",
         ["gap has no parameters, but a and b in it are names of nothing, and it is called with 2 arguments"]),
        ("gap(a)", "abs(a - b) - least", "gap(height, speed)",
         ["gap has only 1 parameter, but b in it is a name of nothing, and it is called with 2 arguments"]),
        ("gap", "abs(a - b) - least", "gap(height)",
         ['unknown name "a"', 'unknown name "b"', "gap has no parameters; write it without parentheses"]),
        ("gap", "height - least", "gap(height)", ["gap has no parameters; write it without parentheses"]),
        ("gap(a, b)", "abs(a - b) - least", "gap(height, speed)", []),
    ],
)  # fmt: skip
def test_parameters_that_are_not_written(key: str, value: str, use: str, expected: list[str]) -> None:
    assert messages(CALLED % (key, value, use)) == expected


def test_the_key_with_its_parameters_is_shown() -> None:
    correction = check(source(CALLED % ("gap", "abs(a - b)", "gap(height, speed)")))[0].correction
    assert correction is not None
    assert [edit.text for edit in correction.edits] == ["gap(a, b)"]


@pytest.mark.parametrize(
    ("rows", "use", "expected"),
    [
        ("[[0, 1], [1], [0, 0]]", "room[x][0]", ["row 1 of room, counted from 0, has 1 value, the others 2"]),
        ("[[0, 1], [1, 0], [0, 0, 1]]", "room[x][1]", ["row 2 of room, counted from 0, has 3 values, the others 2"]),
        ("[[0, 1], [0 1], [0, 0]]", "room[x][0]", ["this cannot be read as an expression from '1' on"]),
        ("[[0, 1], [1]]", "room[x][0]", ["rows of different lengths can only be indexed by a plain number"]),
        ("[[0, 1], [1], [0, 0]]", "sum(sum(row) for row in room)", []),
        ("[[0, 1], [1], [0, 0]]", "room[1][0] + lost", ['unknown name "lost"']),
        ("[[0, 1], [1, 1], [0, 0]]", "room[x][0]", []),
    ],
)  # fmt: skip
def test_a_row_of_another_length(rows: str, use: str, expected: list[str]) -> None:
    assert messages(TABLE % (rows, use)) == expected
