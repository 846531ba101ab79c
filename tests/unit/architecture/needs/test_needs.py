import struct

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bbsd.architecture import Architecture, architecture_of
from bbsd.architecture.controller import controller_of
from bbsd.architecture.needs import NotMeasured, NotRemembered, needs_of
from bbsd.compiler import compile_meaning
from bbsd.evaluation.tracing.recording import record_episode
from bbsd.expression.graph import evaluate
from bbsd.expression.kinds import Kind
from bbsd.kernel.streams import DISTRIBUTIONS, fold, word_of
from bbsd.language.loading import load
from bbsd.text import Source
from tests.interpreter.made_up import specs
from tests.interpreter.made_up_designs import random_agents
from tests.interpreter.made_up_meanings import meaning_made_up
from tests.unit.architecture.designs import SPECS, meaning_of
from tests.unit.architecture.needs.player import Robot

ROBOT = """
bbsd: 1
name: robot
constants: {{full: 10}}
environment:
  robots: {robots}
  steps: 20
  world:
    lamp: uniform(0, 9)
  state:
    place: uniform(0, 9)
    speed: 0
    charge: full
    turns: 0
    side: 3 - robot
    signal: false
    clock: 0
  dynamics:
    place: place + speed
    charge: max(charge - abs(speed), 0)
    signal: false
    clock: clock + 1 if place > 3 else 0
    lamp: lamp + 0.1
  sensors:
    light: lamp - place
    noisy: light + normal(0, 1)
    rising: light > before(light)
    far: light > side
    tired: clock > 4
behaviors:
  go:
    inputs: [rising, far, tired]
    actions:
      ahead:
        speed: speed + 1
        turns: turns + uniform(0, 1)
      back: {{speed: -1, signal: true}}
    rules:
      - when: {{far: true, tired: false}}
        do: ahead
      - when: {{rising: true}}
        do: back
      - otherwise: no action
  rest:
    excited: charge < 5 and noisy > 0
    actions:
      plug: {{charge: full}}
    rules: [{{otherwise: plug}}]
structure: [rest, go]
reward: {{up: 1}}
"""


def needed(text, **options):
    meaning = meaning_of(text)
    return needs_of(meaning, controller_of(meaning, architecture_of(meaning)), **options)


def names(needs):
    return [each.name for each in needs.given], needs.memory


def test_what_actions_set_is_memory_and_all_else_is_given_unless_it_never_changes():
    needs = needed(ROBOT.format(robots=1))
    assert names(needs) == (["lamp", "place", "clock", "noisy"], ("speed", "charge", "turns"))
    assert [slot.name for slot in needs.robots[0].next] == ["speed", "charge", "turns", "before light"]
    assert [name for name, _ in needs.robots[0].held] == ["speed", "charge", "turns", "signal"]
    assert [node.operation for node in needs.robots[0].start.values()] == ["literal", "constant", "literal"]


def test_sensors_of_the_world_are_given_where_not_raw():
    needs = needed(ROBOT.format(robots=1), raw=False)
    assert names(needs) == (["clock", "light", "noisy"], ("speed", "charge", "turns"))
    assert "before light" in [slot.name for slot in needs.robots[0].next]


def test_what_is_measured_is_given_and_what_is_remembered_is_kept():
    needs = needed(ROBOT.format(robots=1), measured=["charge", "far", "rising"], remembered=["clock"])
    assert names(needs) == (["place", "charge", "noisy", "rising", "far"], ("speed", "turns", "clock"))


@pytest.mark.parametrize("name", ["place", "lamp", "nothing", "light"])
def test_only_what_a_robot_knows_can_be_remembered(name):
    with pytest.raises(NotRemembered, match=name):
        needed(ROBOT.format(robots=1), remembered=[name])


def test_only_sensors_and_state_can_be_measured():
    with pytest.raises(NotMeasured, match="charge"):
        needed(ROBOT.format(robots=1), measured=["charg"])


def test_what_robots_look_at_is_given_of_the_team_even_if_they_could_keep_their_own():
    text = ROBOT.format(robots=3).replace("far: light > side", "far: light > max(speed[r] for r in others)")
    needs = needed(text)
    assert names(needs)[1] == ("charge", "turns")
    (speed,) = [each for each in needs.given if each.name == "speed"]
    assert (speed.block, speed.of_team, [slot.robot for slot in speed.slots]) == ("state", True, [0, 1, 2])
    assert not any(each.of_team for each in needs.given if each.name != "speed")
    assert names(needed(text, raw=False)) == (
        ["clock", "light", "noisy", "far"],
        ("speed", "charge", "turns"),
    )


def test_constants_of_each_robot_stand_in_its_nodes():
    needs = needed(ROBOT.format(robots=2))
    assert needs.robots[0].cells != needs.robots[1].cells
    assert "side" not in names(needs)[0]


def bits(value):
    return struct.pack("<d", value) if value == value else "nan"  # noqa: PLR0124 - NaN


def acted_values(meaning, recording, step, constants):
    """What state is after the actions of a step, as the episode's graph says."""

    def leaf(node, operands):
        match node.operation:
            case "slot":
                value = recording.stored[step][node.slot]
                return bool(value) if node.kind is Kind.TRUTH else value
            case "step":
                return float(step + 1)
            case "choice":
                return int(recording.choices[step, node.index])
            case "draw":
                word = fold(node.draw.kernel_word, word_of(step + 1))
                return DISTRIBUTIONS[node.draw.distribution](recording.key, word, *operands)
        return node.read(constants, operands)

    acted = meaning.episode.acted
    return dict(zip(acted, evaluate(acted.values(), leaf), strict=True))


def assert_same_decisions(meaning, design, key, **options):
    """Every robot, told only what it needs, decides and acts in each step as in the recorded episode."""
    recording = record_episode(compile_meaning(meaning, compiled=False), design, key, 1)
    controller, constants = controller_of(meaning, design), meaning.constants.vector(1)
    needs = needs_of(meaning, controller, **options)
    robots = [Robot(controller, needs, k, constants, key) for k in range(len(needs.robots))]
    for step, stored in enumerate(recording.stored):
        acted = acted_values(meaning, recording, step, constants)
        for k, robot in enumerate(robots):
            choice, after = robot.act(stored)
            assert choice == recording.choices[step, k]
            for variable, value in after.items():
                assert bits(value) == bits(
                    acted[next(s for s in acted if s.variable == variable and s.robot == k)]
                )


@pytest.mark.parametrize("raw", [True, False])
@pytest.mark.parametrize("robots", [1, 3])
def test_it_decides_as_in_an_episode(robots, raw):
    meaning = meaning_of(ROBOT.format(robots=robots))
    for key in range(3):
        assert_same_decisions(meaning, architecture_of(meaning), key, raw=raw)


@pytest.mark.parametrize("raw", [True, False])
@pytest.mark.parametrize("name", ["object_lifting", "pursuit", "forager", "mobile_robot", "grid_world"])
def test_shipped_designs_decide_as_in_an_episode(name, raw):
    meaning = load(Source.read(SPECS / f"{name}_hand.yaml"), overrides=["environment.steps=40"]).meaning
    assert_same_decisions(meaning, architecture_of(meaning), 5, raw=raw)


@pytest.mark.slow
@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data(), seed=st.integers(0, 10**6), raw=st.booleans())
def test_made_up_designs_decide_as_in_an_episode(data, seed, raw):
    meaning = meaning_made_up(data.draw(specs(most_robots=3)), seed)
    agents = random_agents(compile_meaning(meaning, compiled=False), 1, seed)
    tables = tuple(pool[member] for pool, member in zip(agents.pools, agents.members[0], strict=True))
    assert_same_decisions(meaning, Architecture(tables, agents.structures[0]), int(agents.keys[0]), raw=raw)
