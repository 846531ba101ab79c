"""The phases of a step, by what the values of one mean in terms of the values before it."""

from typing import Any

import pytest

from bbsd.expression.graph import Node, evaluate
from bbsd.language.meaning import Meaning
from tests.unit.language.specs import codes, meaning_of, source


def value(node: Node, now: dict[Any, float] | None = None, choice: int = 0, step: int = 1) -> Any:
    """What a node is, given the values stored before the step (or at the start: none) and the action in control."""

    def leaf(node: Node, _operands: list[Any]) -> Any:
        if node.operation == "slot":
            return (now or {})[node.data]
        return {"choice": choice, "step": step}[node.operation]

    return evaluate([node], leaf)[0]


PHASES = """
bbsd: 1
name: phases
environment:
  steps: 10
  state: {x: 1, y: 10}
  dynamics: {y: y + x + sensed}
  sensors: {sensed: 100 * x}
behaviors:
  act: {actions: {set: {x: x + y}, swap: {x: y, y: x}}}
reward: {now: sensed, then: before(sensed), count: step}
"""


@pytest.fixture(scope="module")
def phases() -> Meaning:
    from bbsd.language.loading import load
    from bbsd.text import Source

    return load(Source("phases", PHASES)).meaning


NOW = {("x", 0, ()): 2.0, ("y", 0, ()): 5.0, ("sensed", 0, ()): 1000.0}


def test_an_episode_starts_with_starting_values_then_sensors(phases: Meaning) -> None:
    start = {name: value(node) for (name, *_), node in phases.episode.start.items()}
    assert start == {"x": 1, "y": 10, "sensed": 100}


def test_actions_set_all_at_once_from_the_snapshot(phases: Meaning) -> None:
    acted = phases.episode.acted
    assert [value(acted[name, 0, ()], NOW, choice=1) for name in "xy"] == [7, 5]
    assert [value(acted[name, 0, ()], NOW, choice=2) for name in "xy"] == [5, 2]


def test_what_nobody_sets_stays(phases: Meaning) -> None:
    assert [value(phases.episode.acted[name, 0, ()], NOW, choice=0) for name in "xy"] == [2, 5]


def test_dynamics_use_values_after_the_actions_and_the_sensors_of_the_snapshot(phases: Meaning) -> None:
    assert value(phases.episode.after["y", 0, ()], NOW, choice=1) == 5 + 7 + 1000


def test_sensors_and_reward_see_the_values_after_the_step(phases: Meaning) -> None:
    assert value(phases.episode.after["sensed", 0, ()], NOW, choice=1) == 700
    rewards = phases.episode.reward
    assert [value(rewards[term][0], NOW, choice=1, step=4) for term in ("now", "then", "count")] == [
        700,
        1000,
        4,
    ]


def test_start_values_are_made_in_the_order_they_need_each_other() -> None:
    meaning = meaning_of("environment: {state: {height: speed + 1, speed: robot}}")
    start = meaning.episode.start
    assert [value(start["height", robot, ()]) for robot in range(3)] == [1, 2, 3]


def test_lists_are_stored_element_by_element() -> None:
    meaning = meaning_of('environment: {sensors: {sonar: "list(height * k for k in range(3))"}}')
    assert {slot for slot in meaning.episode.after if slot[0] == "sonar"} == {
        ("sonar", robot, (place,)) for robot in range(3) for place in range(3)
    }


def test_the_world_is_there_once() -> None:
    meaning = meaning_of(
        "environment: {world: {wind: 1}, dynamics: {wind: 'wind + max(speed[r] for r in team)'}}"
    )
    assert ("wind", None, ()) in meaning.episode.after


def test_the_end_is_the_teams() -> None:
    assert meaning_of("environment: {ends: 'all(height[r] > 3 for r in team)'}").episode.ends is not None
    assert meaning_of().episode.ends is None
    assert codes("environment: {ends: height > 3}") == ["BB059"]
    assert codes("environment: {robots: 1, ends: height > 3}") == []


@pytest.mark.parametrize(
    ("environment", "code"),
    [("{state: {height: tilt}}", "BB066"), ("{state: {height: generation}}", "BB066"),
     ("{dynamics: {tilt: 1}}", "BB033"),
     ("{dynamics: {height: tilted}}", "BB055"), ("{sensors: {wide: 'list(1, 2)', sum_of: wide + 1}}", "BB056"),
     ("{sensors: {zone: {a: tilted, b: otherwise}, used: zone}}", "BB067"), ("{world: {wind: height}}", "BB059"),
     ("{definitions: {lucky: chance(0.5)}}", "BB058"), ("{definitions: {f(a): a + hight}}", "BB052"),
     ("{state: {memory: 'list(1, 2)'}, dynamics: {memory: 3}}", "BB132"), ("{state: {x: 'list(1, 1 < 2)'}}", "BB133")],
)  # fmt: skip
def test_mistakes(environment: str, code: str) -> None:
    assert codes(f"environment: {environment}") == [code]


def test_a_mistake_for_every_robot_is_told_once() -> None:
    from bbsd.language.loading import check

    (diagnosis,) = check(source("environment: {robots: 64}\nreward: {near: hight}"))
    assert diagnosis.code == "BB052"


def test_draws_are_other_ones_in_every_place_and_for_every_robot() -> None:
    meaning = meaning_of("""
environment:
  dynamics: {height: "height + normal(0, 1)", speed: "speed + normal(0, 1)"}
  sensors: {noisy: "height + normal(0, 1)"}
behaviors: {stop: {actions: {halt: {speed: "normal(0, 1)"}, push: {speed: "normal(0, 1)"}}}}
""")
    words = {node.data for node in meaning.graph.nodes.values() if node.operation == "draw"}
    assert len(words) == 3 * (1 + 2 + 1 + 2)
