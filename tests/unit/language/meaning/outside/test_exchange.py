"""What is exchanged with an environment in Python, as slots and leaves of an episode."""

from typing import Any

import pytest

from bbsd.evaluation.exact.enumeration import NotEnumerable, enumerate_starts
from bbsd.expression.graph import Node, evaluate
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.language.loading import load
from bbsd.language.meaning import Meaning
from bbsd.language.meaning.proofs.whole_numbers import whole_values
from bbsd.text import Source

SPEC = """
bbsd: 1
name: exchange
environment:
  pettingzoo: mpe2.simple_spread_v3
  robots: 2
  steps: 10
  observation: [x, _, y]
  action: [turn, push]
  world: {total: 0}
  state: {push: 0, turn: 0, home: 10 * y, last: 0, bonus: 7}
  dynamics:
    last: x
    bonus: earned
    total: total + sum(x[r] for r in team)
  sensors: {far: x - home}
  ends: max(x[r] for r in team) > 5
behaviors:
  act:
    inputs: {high: x > 0, good: earned > 2}
    actions: {left: {push: x, turn: 1}}
reward: {earned: earned, gained: x - before(x), far: far}
"""


@pytest.fixture(scope="module")
def meaning() -> Meaning:
    return load(Source("spec.yaml", SPEC)).meaning


def value(
    node: Node, now: dict[str, float] | None = None, given: dict[str, float] | None = None, choice: int = 0
) -> Any:
    """What a node is, given values stored before the step and what the environment gave, alike for all robots."""

    def leaf(node: Node, _operands: list[Any]) -> Any:
        match node.operation:
            case "slot":
                return (now or {})[node.slot.name]
            case "outside":
                return (given or {})[node.slot.name]
        return {"choice": choice, "step": 1.0}[node.operation]

    return evaluate([node], leaf)[0]


def test_the_rows_of_both_arrays(meaning: Meaning) -> None:
    assert meaning.episode.outside == (
        Slot("x", 0), Slot("x", 1), Slot("y", 0), Slot("y", 1), Slot("earned", 0), Slot("earned", 1), Slot("ended"),
    )  # fmt: skip
    assert meaning.episode.sent == (Slot("turn", 0), Slot("turn", 1), Slot("push", 0), Slot("push", 1))


def test_an_own_world_exchanges_nothing() -> None:
    text = "bbsd: 1\nname: own\nenvironment: {steps: 3, state: {x: 0}}\n"
    text += "behaviors: {a: {actions: {b: {x: 1}}}}\nreward: {r: x}"
    episode = load(Source("spec.yaml", text)).meaning.episode
    assert (episode.outside, episode.sent, episode.fractions) == ((), (), frozenset())


def test_the_start_has_the_reset_and_nothing_earned(meaning: Meaning) -> None:
    start = meaning.episode.start
    assert value(start[Slot("x", 1)], given={"x": 3}) == 3
    assert value(start[Slot("home", 0)], given={"y": 3}) == 30
    assert value(start[Slot("earned", 0)]) == 0
    assert value(start[Slot("far", 0)], given={"x": 3, "y": 1}) == -7


def test_the_decision_and_the_actions_see_what_was_observed_before(meaning: Meaning) -> None:
    (module,) = meaning.episode.modules
    assert [value(cell, now={"x": 1, "earned": 0}) for cell in module.cells[1]] == [1, 0]
    acted = meaning.episode.acted
    assert value(acted[Slot("push", 0)], now={"push": 8, "x": 4}, choice=1) == 4
    assert value(acted[Slot("push", 0)], now={"push": 8, "x": 4}, choice=0) == 8


def test_dynamics_see_what_was_observed_before_too(meaning: Meaning) -> None:
    after = meaning.episode.after
    assert value(after[Slot("last", 0)], now={"x": 4}) == 4
    assert value(after[Slot("bonus", 1)], now={"earned": 2}) == 2
    assert value(after[Slot("total")], now={"x": 4, "total": 1}) == 9


def test_sensors_reward_and_end_see_what_the_step_gave(meaning: Meaning) -> None:
    episode = meaning.episode
    assert value(episode.after[Slot("x", 0)], given={"x": 6}) == 6
    assert value(episode.after[Slot("far", 0)], now={"home": 1}, given={"x": 6}) == 5
    assert value(episode.reward["earned"][1], given={"earned": -2}) == -2
    assert value(episode.reward["gained"][0], now={"x": 4}, given={"x": 6}) == 2
    assert episode.ends is not None
    assert value(episode.ends, given={"x": 6, "ended": False}) is True
    assert value(episode.ends, given={"x": 2, "ended": True}) is True
    assert value(episode.ends, given={"x": 2, "ended": False}) is False


def test_the_environment_ends_an_episode_without_a_condition() -> None:
    ends = load(Source("spec.yaml", SPEC.replace("  ends:", "  x-ends:"))).meaning.episode.ends
    assert ends is not None
    assert (ends.operation, ends.data, ends.kind) == ("outside", Slot("ended"), Kind.TRUTH)


def test_what_robots_observe_is_not_of_the_same_value(meaning: Meaning) -> None:
    start = meaning.episode.start
    assert start[Slot("x", 0)] is not start[Slot("x", 1)]


@pytest.mark.parametrize(
    ("observation", "whole"),
    [("{x: 5, y: 3}", {"x", "y", "home", "last"}), ("{x: image, y: a.b}", set()), ("[x, y]", set())],
)
def test_fields_with_a_size_are_whole_numbers(observation: str, whole: set[str]) -> None:
    meaning = load(
        Source("spec.yaml", SPEC.replace("observation: [x, _, y]", f"observation: {observation}"))
    ).meaning
    named = {slot.name for slot in whole_values(meaning.episode, meaning.constants)}
    assert named & {"x", "y", "home", "last", "earned", "bonus"} == whole


def test_starts_of_an_environment_in_python_cannot_be_enumerated(meaning: Meaning) -> None:
    from bbsd.compiler import compile_meaning

    with pytest.raises(NotEnumerable, match="stepped in Python"):
        enumerate_starts(compile_meaning(meaning, compiled=False))
