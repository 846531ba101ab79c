"""Agents: that they do what their robots do in episodes, and what they say to a program that uses them wrongly."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import bbsd
from bbsd.agent import BadInput
from bbsd.agent.making import design_of
from bbsd.agent.many import loop_source
from bbsd.api.acting import Agent, NothingDone
from bbsd.architecture import Architecture, HolesLeft, architecture_of
from bbsd.architecture.needs import NotMeasured
from bbsd.compiler import compile_meaning
from bbsd.evaluation.tracing.recording import record_episode
from bbsd.expression.node_data import variable_text
from bbsd.kernel.modules import load_kernel
from bbsd.language.loading import load
from bbsd.text import Source
from tests.interpreter.made_up import specs
from tests.interpreter.made_up_designs import random_agents
from tests.interpreter.made_up_meanings import meaning_made_up
from tests.unit.architecture.designs import SPECS, meaning_of, small
from tests.unit.architecture.needs.test_needs import ROBOT, acted_values, bits
from tests.unit.exports.designs import SHIPPED

LIFTING = SPECS / "object_lifting_hand.yaml"
SEEN = {"height": 2.9, "tilt": 6.2, "place": "lowest"}


def values_given(agent, stored):
    """What an agent is given of what an episode stores, in the lists that it wants."""
    given_values = {}
    for name, each in agent.inputs.items():
        values = np.empty(each.shape, object)
        for place, slot in zip(np.ndindex(each.shape), each.slots, strict=True):
            value = stored[slot]
            values[place] = each.cells[int(value)] if each.kind == "cell" else value
        given_values[name] = values.tolist()
    return given_values


def stored_bits(value, labels):
    """What is stored of a value that an agent sets: a number, one of several names, or a list of such."""
    if isinstance(value, list):
        return [each for element in value for each in stored_bits(element, labels)]
    return [bits(float(labels.index(value)) if isinstance(value, str) else value)]


def assert_same(meaning, design, key, generation=1):
    """Each robot's agent does in each step what the robot does in the recorded episode, to the last bit."""
    recording = record_episode(compile_meaning(meaning, compiled=False), design, key, generation)
    constants = meaning.constants.vector(generation)
    agents = Agent.of(design_of(meaning, design), not_finite="count")
    for agent in agents:
        agent.reset(key=key)
    numbers = set()
    for step, stored in enumerate(recording.stored):
        acted = acted_values(meaning, recording, step, constants)
        of_robots = {}
        for slot in sorted(acted, key=lambda slot: slot.place):
            value = bits(acted[slot])
            of_robots.setdefault((slot.name, slot.robot), []).append(value)
            if slot.place:
                of_robots[variable_text(slot.variable), slot.robot] = [value]
        for robot, agent in enumerate(agents):
            act = agent.act(values_given(agent, stored))
            assert act.number == recording.choices[step, robot]
            for name, value in act.sets.items():
                labels = meaning.episode.labels(name.partition("[")[0])
                assert stored_bits(value, labels) == of_robots[name, robot]
            numbers.add(act.number)
    return numbers


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_designs_do_what_they_do_in_episodes(name):
    steps = 15 if "aggregation" in name else 80
    loaded = load(Source.read(SPECS / f"{name}.yaml"), overrides=[f"environment.steps={steps}"])
    meaning, generation = loaded.meaning, loaded.spec.design.coevolution.generations
    numbers = set()
    for key in range(3):
        numbers |= assert_same(meaning, architecture_of(meaning), key, generation)
    assert len(numbers) > 1


@pytest.mark.parametrize("robots", [1, 3])
def test_memory_draws_and_what_was_before_are_as_in_episodes(robots):
    meaning = meaning_of(ROBOT.format(robots=robots))
    for key in range(4):
        assert len(assert_same(meaning, architecture_of(meaning), key)) > 1


@pytest.mark.slow
@settings(max_examples=30, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data(), seed=st.integers(0, 10**6))
def test_made_up_designs_do_what_they_do_in_episodes(data, seed):
    meaning = meaning_made_up(data.draw(specs(most_robots=3)), seed)
    agents = random_agents(compile_meaning(meaning, compiled=False), 1, seed)
    tables = tuple(pool[member] for pool, member in zip(agents.pools, agents.members[0], strict=True))
    generation = meaning.spec.design.coevolution.generations
    assert_same(meaning, Architecture(tables, agents.structures[0]), int(agents.keys[0]), generation)


FIRST_OF_THREE = """
bbsd: 1
name: marks
environment:
  steps: 5
  world: {lamp: false}
  sensors: {seen: lamp}
  state: {flag: false, bins: list(0 for b in range(3)), marks: list(list(false for a in range(2)) for b in range(2))}
behaviors:
  mark:
    actions:
      first: {"bins[0]": 1, "marks[0]": list(not seen for v in range(2))}
    rules: [otherwise: first]
structure: [mark]
reward: {s: sum(bins)}
"""


def test_first_elements_that_are_set_are_not_taken_for_the_whole_list():
    agent = Agent(FIRST_OF_THREE)
    assert agent.act({"seen": False}).sets == {"bins[0]": 1.0, "marks[0][0]": True, "marks[0][1]": True}
    many = agent.act_many({"seen": [True, False]}).sets
    assert {name: values.tolist() for name, values in many.items()} == {
        "bins[0]": [1.0, 1.0],
        "marks[0][0]": [0.0, 1.0],
        "marks[0][1]": [0.0, 1.0],
    }


@pytest.mark.parametrize("name", ["object_lifting_hand", "forager_hand"])
def test_many_do_what_one_does(name):
    many, rng = Agent(SPECS / f"{name}.yaml", seed=3), np.random.default_rng(1)
    ones = [Agent(SPECS / f"{name}.yaml", seed=3) for _ in range(5)]
    for step in range(30):
        rows = {
            each.name: rng.integers(0, max(2, len(each.cells)), 5).astype(
                bool if each.kind == "truth" else int
            )
            if each.kind in ("cell", "truth")
            else rng.uniform(-4, 6, 5)
            for each in many.inputs.values()
        }
        if step == 20:
            many.reset_many([1, 3])
            ones[1].reset()
            ones[3].reset()
        acts = many.act_many(rows)
        for lane, one in enumerate(ones):
            act = one.act({name: row[lane] for name, row in rows.items()})
            assert acts.numbers[lane] == act.number
            for state, values in acts.sets.items():
                assert bits(float(values[lane])) == bits(float(act.sets.get(state, float("nan"))))


def test_draws_and_what_was_before_are_of_each_of_many(tmp_path):
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT.format(robots=1))
    many, one = Agent(path), Agent(path)
    rng = np.random.default_rng(2)
    rows = [np.floor(rng.uniform(0, 9, (len(many.inputs), 4))) for _ in range(12)]
    acts = [many.act_many(dict(zip(many.inputs, each, strict=True))) for each in rows]
    for lane in range(4):
        one.reset(key=int(many._many._keys[lane]))
        for each, done in zip(rows, acts, strict=True):
            act = one.act(dict(zip(many.inputs, each[:, lane].tolist(), strict=True)))
            assert done.numbers[lane] == act.number
            for name, values in done.sets.items():
                assert bits(float(values[lane])) == bits(float(act.sets.get(name, float("nan"))))
    assert len({number for done in acts for number in done.numbers.tolist()}) > 2
    turns = np.array([done.sets["turns"] for done in acts])
    assert len(np.unique(turns[np.isfinite(turns)])) > 10


def test_the_loop_of_many_is_also_plain_python():
    agent = Agent(LIFTING)
    module = load_kernel(loop_source(agent._program), "agent", (), compiled=False)
    numbers, sets = np.zeros(1, np.int64), np.full((1, 1), np.nan)
    values = np.array([[2.9], [6.2], [0.0]])
    module.many(values, np.zeros((1, 1)), np.ones(1, np.int64), np.zeros(1, np.uint64), numbers, sets)
    assert (numbers[0], sets[0, 0]) == (4, 1.0)


def test_lists_of_many_have_the_robots_first():
    agent = Agent(SPECS / "mobile_robot_hand.yaml")
    sonar = np.full((3, 8), 2.0)
    sonar[1, :] = 0.5
    acts = agent.act_many({"whim": 0.25, "sonar": sonar, "light": [0.0, 0.0, 0.0, 0.0]})
    assert [agent.actions[number - 1] for number in acts.numbers] == [
        ("wander", "stroll"),
        ("avoid_obstacles", "back"),
        ("wander", "stroll"),
    ]
    assert acts.sets["turn"].tolist() == [0.25, 0.5, 0.25]
    with pytest.raises(BadInput, match="there were 3 robots, and 2 are given"):
        agent.act_many({"whim": 0.25, "sonar": sonar[:2], "light": [0.0] * 4})
    agent.reset_many()
    assert len(agent.act_many({"whim": [0.25, 1], "sonar": sonar[:2], "light": [0.0] * 4}).numbers) == 2


def holed(value):
    """Distances of three robots, one of which is another value."""
    sonar = np.zeros((3, 8), object)
    sonar[2, 3] = value
    return sonar if value is None or isinstance(value, str) else sonar.astype(float)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (
            {"sonar": np.zeros((3, 7))},
            "sonar: an array of n by 8 values is needed, not one of shape \\(3, 7\\)",
        ),
        ({"whim": [1.0, 2.0]}, "different numbers of robots: 2 by whim, 3 by sonar, 3 by light"),
        ({"whim": ["c", "a", "b"]}, "whim of robot 0: 'c' is no number"),
        ({"whim": [1.0, np.nan, 2.0]}, "whim of robot 1: nan is not finite"),
        ({"sonar": holed(np.nan)}, r"sonar\[3\] of robot 2: nan is not finite"),
        ({"sonar": holed("far").tolist()}, r"sonar\[3\] of robot 2: 'far' is no number"),
        ({"sonar": holed(None)}, r"sonar\[3\] of robot 2: None is no number"),
        ({"light": [0.0, 0.0, "dark", 0.0]}, r"light\[2\]: 'dark' is no number"),
        ({"sonar": [[1.0] * 8, [1.0] * 7]}, "n by 8 values is needed, not lists of different lengths"),
        ({"whim": 1.5, "wimm": 1.0}, "there is no 'wimm'; did you mean \"whim\""),
    ],
)
def test_what_is_wrong_with_many_is_told(wrong, message):
    agent = Agent(SPECS / "mobile_robot_hand.yaml")
    with pytest.raises(BadInput, match=message):
        agent.act_many({"whim": 0.1, "sonar": np.zeros((3, 8)), "light": np.zeros((3, 4)), **wrong})
    with pytest.raises(BadInput, match="missing: sonar") as raised:
        agent.act_many({"whim": 0.1, "light": np.zeros((3, 4))})
    assert raised.value.advice.startswith("the inputs are ")
    assert "sonar" in raised.value.advice


def test_a_value_of_a_list_is_told_by_what_it_is_called():
    agent = Agent(SPECS / "mobile_robot_hand.yaml")
    seen = {"whim": 0.1, "sonar": [0.0] * 8, "light": [0.0] * 4}
    for wrong, message in (
        (float("nan"), r"sonar\[5\]: nan is not finite"),
        ("x", r"sonar\[5\]: 'x' is no number"),
    ):
        sonar = [*seen["sonar"]]
        sonar[5] = wrong
        with pytest.raises(BadInput, match=message):
            agent.act({**seen, "sonar": sonar})


def test_it_says_what_it_must_be_given():
    agent = Agent(LIFTING)
    assert [*agent.inputs] == ["height", "tilt", "place"]
    assert agent.inputs["place"].kind == "cell"
    assert agent.inputs["place"].cells == ("lowest", "highest", "middle")
    assert agent.inputs["height"].text == "state: starts as uniform(2, 3), then height + speed * dt"
    assert agent.inputs["tilt"].text.startswith("degrees(atan(hypot(")
    sonar = Agent(SPECS / "mobile_robot_hand.yaml").inputs["sonar"]
    assert (sonar.kind, sonar.shape, len(sonar.slots)) == ("number", (8,), 8)
    assert repr(agent) == "<Agent of object-lifting-by-hand: height, tilt, place>"


def test_memory_is_kept_and_forgotten():
    agent = Agent(LIFTING)
    assert agent.memory == {"speed": 0.0}
    assert [agent.act(SEEN).sets["speed"] for _ in range(3)] == [1.0, 2.0, 3.0]
    assert (agent.memory, agent.step) == ({"speed": 3.0}, 3)
    agent.reset()
    assert (agent.memory, agent.step, agent.episode) == ({"speed": 0.0}, 0, 1)
    measured = Agent(LIFTING, measured=["speed"])
    assert measured.memory == {}
    assert measured.act({**SEEN, "speed": 4.0}).sets == {"speed": 5.0}
    with pytest.raises(NotMeasured):
        Agent(LIFTING, measured=["sped"])


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"plase": "lowest"}, "there is no 'plase'; did you mean \"place\""),
        ({"height": "2.9"}, "height: '2.9' is no number"),
        ({"height": True}, "height: True is no number"),
        ({"height": [2.9]}, "height: \\[2.9\\] is no number"),
        ({"height": np.array([2.9])}, "height: array\\(\\[2.9\\]\\) is no number"),
        ({"tilt": float("inf")}, "tilt: inf is not finite"),
        (
            {"place": "low"},
            "place: 'low' is none of its cells; did you mean \"lowest\".: lowest, highest, middle",
        ),
        ({"height": 10**400}, "height: a number is given that is beyond binary64"),
        ({"place": 3}, "place: 3 is none of its cells"),
        ({"place": True}, "place: True is none of its cells"),
        ({"place": ["lowest"]}, "place: \\['lowest'\\] is none of its cells"),
    ],
)
def test_a_wrong_value_is_told_and_changes_nothing(wrong, message):
    agent = Agent(LIFTING)
    agent.act(SEEN)
    with pytest.raises(BadInput, match=message):
        agent.act({**SEEN, **wrong})
    assert (agent.step, agent.memory) == (1, {"speed": 1.0})


@pytest.mark.parametrize(
    ("missing", "message"), [({}, "missing: height, tilt, place"), ([1], "a mapping of names")]
)
def test_what_is_missing_is_told(missing, message):
    with pytest.raises(BadInput, match=message) as raised:
        Agent(LIFTING).act(missing)
    assert raised.value.__cause__ is None


def test_lists_of_a_wrong_length_are_told():
    agent = Agent(SPECS / "mobile_robot_hand.yaml")
    for sonar in ([1.0] * 7, [1.0] * 9, 1.0, "12345678"):
        with pytest.raises(BadInput, match=r"sonar(\[0\])?: "):
            agent.act({"whim": 0.1, "sonar": sonar, "light": [0.0] * 4})


def test_names_of_the_spec_that_are_not_needed_are_not_looked_at():
    assert Agent(LIFTING).act({**SEEN, "speed": "whatever", "tilted": None}).action == "faster"


def test_numbers_of_numpy_and_cells_by_index_are_taken():
    given_values = {"height": np.float32(2.5), "tilt": np.int64(6), "place": np.int32(0)}
    assert Agent(LIFTING).act(given_values) == (4, "hurry_up", "faster", {"speed": 1.0})


KINDS = small("""
  a:
    inputs: {n: "values(count, -1, 2)", bright: lit}
    actions: {go: {x: count}}
    rules: [{when: {n: 1, bright: true}, do: go}, {otherwise: no action}]
structure: [a]
""").replace(
    "state: {x: 0}",
    "state: {x: 0}, world: {w: 0}, sensors: {count: floor(w), lit: w > 1, zone: 'cut(w, 1, 2)'}",
)


def test_truths_and_whole_numbers_have_to_be_such(tmp_path):
    path = tmp_path / "spec.yaml"
    path.write_text(KINDS)
    agent = Agent(path)
    assert {name: each.kind for name, each in agent.inputs.items()} == {
        "count": "whole number",
        "lit": "truth",
    }
    for lit in (True, 1, np.True_, 1.0):
        assert agent.act({"count": 1, "lit": lit}).sets == {"x": 1.0}
    assert agent.act({"count": 1, "lit": False}) == (0, None, None, {})
    with pytest.raises(BadInput, match=r"count: 1\.5 is no whole number"):
        agent.act({"count": 1.5, "lit": True})
    with pytest.raises(BadInput, match="lit: 2 is neither true nor false"):
        agent.act({"count": 1, "lit": 2})


def test_truths_and_whole_numbers_of_many_have_to_be_such(tmp_path):
    path = tmp_path / "spec.yaml"
    path.write_text(KINDS)
    agent = Agent(path)
    acts = agent.act_many({"count": [1, 1, 0], "lit": np.array([True, False, True])})
    assert acts.numbers.tolist() == [1, 0, 0]
    assert np.isnan(acts.sets["x"]).tolist() == [False, True, True]
    with pytest.raises(BadInput, match=r"count of robot 1: 1\.5 is no whole number"):
        agent.act_many({"count": [1, 1.5, 0], "lit": [True] * 3})
    with pytest.raises(BadInput, match="lit of robot 1: 2 is neither true nor false"):
        agent.act_many({"count": 1, "lit": [1, 2, 0]})


def test_numbers_that_are_not_finite_can_be_counted():
    agent = Agent(LIFTING, not_finite="count")
    assert agent.act({**SEEN, "tilt": float("nan")}).action == "push"
    assert agent.act({**SEEN, "height": float("inf")}).action == "stop"
    assert agent.not_finite == 2


def test_why_is_told_in_words_and_as_an_answer():
    agent = Agent(LIFTING)
    with pytest.raises(NothingDone):
        agent.answer()
    agent.act(SEEN)
    agent.act(SEEN)
    assert agent.why.startswith("object-lifting-by-hand: step 2, robot 0\nhurry_up controlled: faster.\n")
    assert "Before the step: height 2.9, tilt 6.2, place lowest, speed 1" in agent.why
    answer = agent.answer(unwanted=["faster"])
    assert (answer.behavior, answer.action) == ("hurry_up", "faster")
    assert answer.otherwise[0].inputs[0].input == "tilted"


def test_why_agrees_with_the_command():
    agent = Agent(LIFTING)
    agent.act(SEEN)
    situation = {"height": 2.9, "tilt": 6.2, "place": "lowest", "speed": 0}
    said = bbsd.why(LIFTING, at=situation)
    assert said.layers == agent.answer().layers


def test_a_design_with_holes_or_another_robot_is_refused():
    with pytest.raises(HolesLeft):
        Agent(SPECS / "object_lifting.yaml")
    with pytest.raises(BadInput, match="there is no robot 3: the design is for 3"):
        Agent(LIFTING, robot=3)


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda agent: pickle.loads(pickle.dumps(agent))])
def test_a_copy_goes_on_from_where_the_agent_is(copied):
    agent = Agent(SPECS / "mobile_robot_hand.yaml")
    given_values = {"whim": 0.5, "sonar": [2.0] * 8, "light": [0.0] * 4}
    agent.act(given_values)
    other = copied(agent)
    assert [other.act(given_values), other.memory, other.why] == [
        agent.act(given_values),
        agent.memory,
        agent.why,
    ]
    other.act({**given_values, "sonar": [0.1] * 8})
    assert (other.step, agent.step) == (3, 2)


def test_a_copy_of_many_goes_on_from_where_they_are():
    agent = Agent(LIFTING)
    agent.act_many(SEEN, n=3)
    other = pickle.loads(pickle.dumps(agent))
    for each in (agent, other):
        assert each.act_many(SEEN, n=3).sets["speed"].tolist() == [2.0, 2.0, 2.0]


def test_a_team_is_one_agent_for_each_robot():
    team = Agent.team(LIFTING)
    assert [agent.inputs["height"].slots[0].robot for agent in team] == [0, 1, 2]
    assert team[2].act(SEEN) == Agent(LIFTING, robot=2).act(SEEN)
    assert team[0].memory == {"speed": 0.0}


def test_the_digest_is_that_of_its_exports():
    assert Agent(LIFTING).digest in bbsd.export(LIFTING, "python").text


ALONE = """
import sys
import bbsd
agent = bbsd.Agent(sys.argv[1])
agent.act({"height": 2.9, "tilt": 6.2, "place": "lowest"})
assert agent.why
assert not {"numba", "llvmlite"} & {*sys.modules}, "numba"
"""


def test_one_agent_needs_no_compiler():
    subprocess.run([sys.executable, "-c", ALONE, str(LIFTING)], check=True)
