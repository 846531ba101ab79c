from bbsd.compiler.details import checked_slots, first_decided_column, traced_columns
from tests.unit.problems import problem_of

GUARD = """
bbsd: 1
name: guard
environment:
  robots: 2
  steps: 10
  world: {w: 0}
  state: {x: "uniform(0, 5)", awake: "true"}
  definitions: {far: x > 3}
  dynamics: {w: step}
behaviors: {wait: {actions: {stay: {x: x}}, expects: x > 0}}
reward: {close: x}
"""


def test_a_record_has_a_column_for_everything():
    assert traced_columns(problem_of(GUARD).meaning) == [
        ("slot", ("w", None, ())),
        ("slot", ("x", 0, ())),
        ("slot", ("x", 1, ())),
        ("slot", ("awake", 0, ())),
        ("slot", ("awake", 1, ())),
        ("definition", ("far", 0, ())),
        ("definition", ("far", 1, ())),
        ("choice", ("controlling", 0, ())),
        ("choice", ("controlling", 1, ())),
        ("expectation", ("expectation", 0, ())),
        ("expectation", ("expectation", 1, ())),
        ("reward", ("close", 0, ())),
        ("reward", ("close", 1, ())),
        ("excited", ("wait", 0, ())),
        ("cell", ("wait", 0, ())),
        ("excited", ("wait", 1, ())),
        ("cell", ("wait", 1, ())),
    ]


def test_the_decisions_of_a_robot_stand_together():
    meaning = problem_of(GUARD).meaning
    columns = traced_columns(meaning)
    assert [columns[first_decided_column(meaning, robot)].slot for robot in (0, 1)] == [
        ("wait", 0, ()),
        ("wait", 1, ()),
    ]


def test_numbers_are_checked_for_being_finite():
    episode = problem_of(GUARD).meaning.episode
    assert checked_slots(episode) == [("w", None, ()), ("x", 0, ()), ("x", 1, ())]
