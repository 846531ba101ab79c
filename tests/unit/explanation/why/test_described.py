"""Situations that are described by name, held against what traced episodes perceived in the same situations."""

from __future__ import annotations

import pytest

import bbsd
from bbsd.architecture import given_architecture
from bbsd.compiler import compile_meaning
from bbsd.evaluation import trace
from bbsd.explanation.why import described_situation, situation_in
from bbsd.explanation.why.described import STEP, BadSituation
from bbsd.explanation.why.situation import NoSuchMoment
from bbsd.language.meaning.situation import uncertain_sensors
from tests.unit.architecture.designs import SPECS, meaning_of

NAMES = ("object_lifting_hand", "grid_world_hand", "pursuit_hand", "forager_hand", "mobile_robot_hand",
         "tasks/cartpole_hand", "tasks/door_and_key_hand", "tasks/survival_hand")  # fmt: skip

RICH = """
bbsd: 1
name: rich
constants: {limit: 2}
environment:
  robots: 2
  steps: 20
  world: {tide: 0, flood: "false"}
  state: {x: "uniform(-3, 3)", n: "integers(0, 4)", awake: "true"}
  definitions: {"pull(r)": "x[r] - tide", step_back: before(x)}
  dynamics: {tide: tide + 0.1, flood: step > 9, x: "x + normal(0, 1)", n: (n + 1) % 5}
  sensors:
    pulls: "list(pull(robot), pull(1 - robot))"
    noisy: x + normal(0, 0.1)
    moved: x - step_back
    where: cut(noisy, -1, 0, 1)
    late: step > 12
behaviors:
  one:
    excited: awake and moved < limit
    inputs: {side: "pulls[0] > pulls[1]", where: where, count: "values(n, 0, 4)"}
    actions: {go: {x: x - 1}}
    rules: [{otherwise: go}]
  two: {excited: late, inputs: [late], actions: {stop: {x: 0}}, rules: [{otherwise: stop}]}
structure: [two, one]
reward: {right: x}
"""


def meaning_named(name):
    return meaning_of(RICH) if name == "rich" else bbsd.load(SPECS / f"{name}.yaml").meaning


def given_of(meaning, stored, step, without=()):
    """What a trace knew before a step, as somebody would describe it: by name, a list where each robot has its own."""
    robots, given = meaning.spec.environment.robots, {STEP: step}
    known = {
        *meaning.spec.environment.world,
        *meaning.spec.environment.state,
        *meaning.spec.environment.sensors,
    }
    for name in sorted(known - {*without}):
        own = [[value for slot, value in stored.items() if (slot.name, slot.robot) == (name, robot)] for robot in
               (range(robots) if name not in meaning.spec.environment.world else (None,))]  # fmt: skip
        is_list = any(slot.place for slot in stored if slot.name == name)
        values = own if is_list else [value for (value,) in own]
        given[name] = values if len(values) > 1 else values[0]
    return given


@pytest.mark.parametrize("name", [*NAMES, "rich"])
@pytest.mark.parametrize("all_sensors", [False, True])
def test_a_described_situation_is_perceived_as_in_an_episode(name, all_sensors):
    meaning = meaning_named(name)
    problem = compile_meaning(meaning, compiled=False)
    traced = trace(problem, given_architecture(problem), 5, 1)
    computed = () if all_sensors else {*meaning.spec.environment.sensors} - uncertain_sensors(meaning.spec)
    for step in range(1, len(traced.steps) + 1, max(1, len(traced.steps) // 8)):
        given = given_of(meaning, traced.before(step), step, computed)
        for robot in range(traced.robots):
            expected = situation_in(traced, step, robot)
            found = described_situation(meaning, given, robot, 1)
            assert (found.excited, found.cells) == (expected.excited, expected.cells)
            assert found.values == {name: value for name, value in expected.values.items() if name in given}


def test_the_sensors_that_must_be_given_are_those_that_draw_or_look_back():
    assert uncertain_sensors(meaning_of(RICH).spec) == {"noisy", "moved"}


def test_a_value_may_be_for_all_robots():
    meaning = meaning_named("object_lifting_hand")
    one = described_situation(meaning, {"height": [2.4, 2.1, 2.1], "speed": 1}, 0, 1)
    same = described_situation(meaning, {"height": [2.4, 2.1, 2.1], "speed": [1, 1.0, 1]}, 0, 1)
    assert one == same
    assert one.values == {"height": 2.4, "speed": 1}


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({}, r"not all given: height, speed$"),
        ({"height": 2}, "not all given: speed"),
        ({"hight": 2}, 'hight is no state, world or sensor; did you mean "height"'),
        ({"reached": True}, "reached is an input of stop_at_goal, computed from world, state and sensors"),
        ({"height": float("inf"), "speed": 1}, "height: inf is not finite"),
        ({"height": [1, 2], "speed": 1}, "there are 3 robots, and 2 values are given"),
        ({"height": "high", "speed": 1}, "height: 'high' is no number"),
        ({"height": True, "speed": 1}, "height: True is no number"),
        ({"height": [[1], [2], [3]], "speed": 1}, "height: one value for all robots is needed"),
        ({"height": 1, "speed": 1, "tilted": 3}, "tilted: 3 is neither true nor false"),
        (
            {"height": 1, "speed": 1, "place": "lowst"},
            "'lowst' is none of its cells; did you mean \"lowest\"",
        ),
        ({"height": 1, "speed": 1, "step": "one"}, "step: 'one' is no number"),
    ],
)
def test_what_is_wrong_or_missing_is_told_by_name(given, message):
    with pytest.raises(BadSituation, match=message):
        described_situation(meaning_named("object_lifting_hand"), given, 0, 1)


def test_sensors_that_must_be_given_are_told():
    message = r"sonar, light \(of sensors, those that draw or use before: sonar, light\)"
    with pytest.raises(BadSituation, match=message) as error:
        described_situation(meaning_named("mobile_robot_hand"), {}, 0, 1)
    assert error.value.advice == "add --at sonar=... --at light=..."


def test_a_list_of_a_sensor_must_be_as_long_as_it_is():
    with pytest.raises(BadSituation, match="has too few values"):
        described_situation(meaning_of(RICH), {"pulls": [1]}, 0, 1)
    with pytest.raises(BadSituation, match="must have 2 values"):
        described_situation(meaning_of(RICH), {"pulls": [1, 2, 3]}, 0, 1)


def test_there_must_be_such_a_robot():
    with pytest.raises(NoSuchMoment, match="no robot 3: robots are counted from 0 to 2"):
        described_situation(meaning_named("object_lifting_hand"), {"height": 1, "speed": 1}, 3, 1)
