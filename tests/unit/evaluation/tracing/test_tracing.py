import math

import numpy as np
import pytest

from bbsd.architecture import given_architecture
from bbsd.evaluation import RewardNotFinite, agents_of, require_finite, returns_of, trace
from bbsd.kernel.keys import keys
from tests.unit.problems import problem_of

WALK = """
bbsd: 1
name: walk
environment:
  robots: 2
  steps: 5
  world: {w: 0}
  state: {x: 10 * robot, awake: "true"}
  definitions: {double: 2 * x, "both(a, b)": a + b}
  dynamics: {w: w + 1}
  sensors: {place: "values(floor(x / 10), 0, 1)"}
  ends: w == 3
behaviors:
  go:
    inputs: [place]
    actions: {near: {x: x + 1}, far: {x: x + 2, awake: "false"}}
    rules: [{when: {place: 0}, do: near}, {otherwise: far}]
  never: {excited: x < 0, actions: {stay: {x: x}}, rules: [otherwise: stay]}
structure: [never, go]
reward: {x: x, cost: -1}
"""

TERM = """
bbsd: 1
name: term
environment: {{robots: 2, steps: 4, state: {{x: robot}}}}
behaviors: {{b: {{actions: {{a: {{x: x}}}}, rules: [otherwise: a]}}}}
structure: [b]
reward: {{fine: 1, bad: "{bad}"}}
"""


def traced(text):
    problem = problem_of(text)
    return trace(problem, given_architecture(problem), 1, 1)


def test_a_trace_tells_everything_of_every_step():
    found = traced(WALK)
    assert found.steps.tolist() == [1, 2, 3]
    assert found.values["w", None, ()] == [1, 2, 3]
    assert found.values["x", 1, ()] == [12, 14, 16]
    assert found.values["awake", 0, ()] == [1, 1, 1]
    assert found.values["awake", 1, ()] == [0, 0, 0]
    assert found.values["double", 1, ()] == [24, 28, 32]
    assert found.values["place", 0, ()] == ["0", "0", "0"]
    assert found.values["place", 1, ()] == ["1", "1", "1"]
    assert found.controlling == [["go"] * 3] * 2
    assert found.actions == [["near"] * 3, ["far"] * 3]
    assert [[part.tolist() for part in found.rewards[term]] for term in ("x", "cost")] == [
        [[1, 2, 3], [12, 14, 16]],
        [[-1, -1, -1], [-1, -1, -1]],
    ]


def test_values_are_whole_numbers_and_truths_where_they_are_always():
    found = traced(WALK.replace("{w: 0}", '{w: 0, half: "0.5"}'))
    kinds = {slot.name: {type(value) for value in column} for slot, column in found.values.items()}
    assert kinds == {
        "w": {int},
        "half": {float},
        "x": {int},
        "awake": {bool},
        "place": {str},
        "double": {int},
    }


def test_a_trace_knows_what_was_before_each_step():
    found = traced(WALK)
    start = {("w", None): 0, ("x", 0): 0, ("x", 1): 10, ("awake", 0): True, ("awake", 1): True}
    start |= {("place", 0): "0", ("place", 1): "1", ("double", 0): 0, ("double", 1): 20}
    assert {(slot.name, slot.robot): value for slot, value in found.before(1).items()} == start
    assert found.before(3)["x", 1, ()] == found.values["x", 1, ()][1] == 14
    assert found.start.keys() == found.values.keys()


def test_definitions_are_known_at_the_start_where_before_is_the_same():
    found = traced(WALK.replace("double: 2 * x", "double: 2 * x, gain: x - before(x), seen: step + x"))
    assert [found.start[name, 1, ()] for name in ("double", "gain", "seen")] == [20, 0, 10]
    assert found.values["gain", 1, ()] == [2, 2, 2]


def test_nobody_in_control_is_told():
    found = traced(WALK.replace("[never, go]", "[never]"))
    assert found.controlling == [["nobody"] * 3] * 2
    assert found.actions == [[""] * 3] * 2


@pytest.mark.parametrize(
    ("bad", "step", "robot", "value"),
    [
        ("1 / (step - 3)", 3, 0, math.inf),
        ("log(-robot * (step - 1))", 1, 0, -math.inf),
        ("sqrt(-1) if robot == 1 and step > 1 else 0", 2, 1, math.nan),
    ],
)
def test_a_reward_that_is_not_finite_is_named(bad, step, robot, value):
    problem = problem_of(TERM.format(bad=bad))
    with pytest.raises(
        RewardNotFinite, match=f"the reward term bad was .* in step {step} for robot {robot}"
    ) as error:
        returns_of(problem, agents_of([given_architecture(problem)]), keys(1, 0, 2), 1)
    assert str(error.value.value) == str(value)
    assert "episode 1" in error.value.episode


def test_a_sum_that_overflows_is_named():
    problem = problem_of(TERM.format(bad="1e308"))
    with pytest.raises(RewardNotFinite, match="the sum of all rewards was inf in step 4"):
        returns_of(problem, agents_of([given_architecture(problem)]), keys(1, 0, 1), 1)


def test_finite_returns_pass():
    problem = problem_of(WALK)
    require_finite(problem, agents_of([given_architecture(problem)]), keys(1, 0, 1), np.array([1.0]), 1)


def test_what_is_not_finite_but_not_earned_is_no_mistake():
    text = TERM.format(bad="x").replace(
        "state: {x: robot}", "world: {zero: 'uniform(0, 0)'}, state: {x: robot, y: 1 / zero}"
    )
    problem = problem_of(text)
    assert returns_of(problem, agents_of([given_architecture(problem)]), keys(1, 0, 1), 1).tolist() == [[6.0]]


def test_a_trace_tells_whether_what_is_expected_came_only_where_anything_is():
    assert traced(WALK).expectations == []
    text = WALK.replace(
        "    rules: [{when: {place: 0}",
        "    expects: x - before(x) <= (step + 1) / 3\n    rules: [{when: {place: 0}",
    )
    found = traced(text)
    assert found.expectations == [["failed", "held", "held"], ["failed", "failed", "failed"]]
    nobody = traced(text.replace("[never, go]", "[never]"))
    assert nobody.expectations == [[""] * 3] * 2
