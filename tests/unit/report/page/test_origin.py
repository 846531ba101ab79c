"""The spec's text with the designed lines marked."""

from bbsd.report.page.origin import designed_lines

GIVEN = """\
name: robot
behaviors:
  turn:
    inputs: [near]
reward:
  time: -1
""".splitlines()
DESIGNED = """\
name: robot
behaviors:
  turn:
    inputs: [near]
    rules:
      - otherwise: left

structure: [turn]

design:
  budget: 10
reward:
  time: -1
""".splitlines()


def test_lines_that_fill_holes_are_marked_and_those_that_were_set_are_not():
    marks = designed_lines(GIVEN, DESIGNED)
    marked = [line for line, mark in zip(DESIGNED, marks, strict=True) if mark]
    assert marked == ["    rules:", "      - otherwise: left", "structure: [turn]"]


def test_nothing_is_marked_where_nothing_was_designed():
    assert not any(designed_lines(DESIGNED, DESIGNED))
