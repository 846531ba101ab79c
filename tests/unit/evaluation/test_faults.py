import numpy as np
import pytest

from bbsd.architecture import given_architecture
from bbsd.compiler import compile_meaning
from bbsd.evaluation import agents_of, episode_key, evaluation_keys, paired_episodes, trace
from bbsd.evaluation.faults import Fault, NoSuchFault, faulty_meaning, read_fault, read_faults
from tests.unit.architecture.designs import meaning_of

COUNTING = """
bbsd: 1
name: counting
environment:
  robots: {robots}
  steps: 6
  state: {{x: 0, y: 0}}
  dynamics: {{x: x + 1}}
  sensors:
    count: x
    pair: list(x, 2 * x)
    far: count > 2
    place:
      low: count < 1
      middle: count < 3
      high: otherwise
behaviors:
  watch:
    inputs: {{seen: "values(count, 0, 9)", double: "values(pair[1], 0, 12)", far: far, place: place}}
    actions: {{note: {{y: count}}}}
    rules: [otherwise: note]
  rest:
    excited: not far
    actions: {{stop: {{y: 0 - 1}}}}
    rules: [otherwise: stop]
structure: [rest, watch]
reward:
  high: count
  noted: y
"""
SIZES = (10, 13, 2, 3)


@pytest.fixture(scope="module")
def meaning():
    return meaning_of(COUNTING.format(robots=2))


def traced(meaning, text=None):
    changed = meaning if text is None else faulty_meaning(meaning, read_fault(text, meaning))
    problem = compile_meaning(changed, compiled=False)
    return trace(problem, given_architecture(problem), episode_key(0, 0), 1)


def inputs(found, robot=0):
    """The cells of `watch` by its inputs, one list each."""
    return [axis.tolist() for axis in np.unravel_index(found.decisions.cells[:, robot, 0], SIZES)]


def excited(found, behavior, robot=0):
    return found.decisions.excited[:, robot, behavior].astype(int).tolist()


RIGHT = [[0, 1, 2, 3, 4, 5], [0, 2, 4, 6, 8, 10], [0, 0, 0, 1, 1, 1], [0, 1, 1, 2, 2, 2]]


def test_without_a_fault_all_is_seen_as_it_is(meaning):
    assert inputs(traced(meaning)) == RIGHT


@pytest.mark.parametrize(
    ("fault", "count", "far", "place"),
    [
        ("sensor=count:lost", [0] * 6, [0] * 6, [0] * 6),
        ("sensor=count:lost@4", [0, 1, 2, 0, 0, 0], [0] * 6, [0, 1, 1, 0, 0, 0]),
        ("sensor=count:frozen@1", [0] * 6, [0] * 6, [0] * 6),
        ("sensor=count:frozen@5", [0, 1, 2, 3, 4, 4], RIGHT[2], RIGHT[3]),
        ("sensor=count:noise(0)", *(RIGHT[index] for index in (0, 2, 3))),
    ],
)
def test_a_faulty_number_is_seen_by_the_sensors_that_read_it(meaning, fault, count, far, place):
    assert inputs(traced(meaning, fault)) == [count, RIGHT[1], far, place]


@pytest.mark.parametrize(
    ("fault", "seen"),
    [
        ("sensor=far:lost", (2, [0] * 6)),
        ("sensor=far:frozen@4", (2, [0, 0, 0, 1, 1, 1])),
        ("sensor=far:frozen@3", (2, [0] * 6)),
        ("sensor=place:lost@6", (3, [0, 1, 1, 2, 2, 0])),
        ("sensor=place:frozen@2", (3, [0, 1, 1, 1, 1, 1])),
        ("sensor=pair:lost@3", (1, [0, 2, 0, 0, 0, 0])),
        ("sensor=pair:frozen@3", (1, [0, 2, 4, 4, 4, 4])),
    ],
)
def test_a_faulty_sensor_leaves_the_others_alone(meaning, fault, seen):
    place, cells = seen
    expected = list(RIGHT)
    expected[place] = cells
    assert inputs(traced(meaning, fault)) == expected
    assert inputs(traced(meaning, fault), robot=1) == expected


def test_a_sensor_that_looks_back_sees_what_was_perceived_before():
    text = COUNTING.format(robots=1).replace(
        "    far: count > 2\n", "    far: count > 2\n    slope: count - before(count)\n"
    )
    meaning = meaning_of(text.replace("values(count, 0, 9)", "values(slope + 3, 0, 9)"))
    assert inputs(traced(meaning))[0] == [3, 4, 4, 4, 4, 4]
    assert inputs(traced(meaning, "sensor=count:lost@4"))[0] == [3, 4, 4, 1, 3, 3]


def test_reward_goes_by_what_is_true_and_actions_by_what_is_perceived(meaning):
    right, wrong = traced(meaning), traced(meaning, "sensor=count:lost")
    np.testing.assert_array_equal(wrong.rewards["high"], right.rewards["high"])
    assert right.rewards["noted"][0].tolist() == [-1, -1, -1, 3, 4, 5]
    assert wrong.rewards["noted"][0].tolist() == [-1] * 6
    noted = traced(meaning, "sensor=count:lost@5").rewards["noted"][0]
    assert noted.tolist() == [-1, -1, -1, 3, -1, -1]


def test_excitement_goes_by_what_is_perceived(meaning):
    assert excited(traced(meaning), 1) == [1, 1, 1, 0, 0, 0]
    assert excited(traced(meaning, "sensor=far:lost"), 1) == [1] * 6


def test_noise_is_each_robots_own_and_that_of_the_episode(meaning):
    noisy = traced(meaning, "sensor=count:noise(3)")
    assert inputs(noisy)[0] != RIGHT[0]
    assert inputs(noisy)[0] != inputs(noisy, robot=1)[0]
    assert inputs(noisy)[1] == RIGHT[1]
    assert inputs(traced(meaning, "sensor=count:noise(3)")) == inputs(noisy)
    late = inputs(traced(meaning, "sensor=count:noise(3)@4"))[0]
    assert late == [*RIGHT[0][:3], *inputs(noisy)[0][3:]]


def test_a_stuck_behavior_goes_on_wanting_the_same(meaning):
    stuck = traced(meaning, "behavior=watch:stuck@3")
    assert inputs(stuck) == [[*axis[:3], *[axis[2]] * 3] for axis in RIGHT]
    assert excited(stuck, 1) == [1, 1, 1, 0, 0, 0]
    assert excited(traced(meaning, "behavior=rest:stuck@3"), 1) == [1] * 6
    assert excited(traced(meaning, "behavior=rest:stuck@4"), 1) == [1, 1, 1, 0, 0, 0]


def test_a_silent_behavior_does_nothing_from_a_step_on(meaning):
    assert excited(traced(meaning, "behavior=rest:silent@2"), 1) == [1, 0, 0, 0, 0, 0]
    assert excited(traced(meaning, "behavior=rest:silent"), 1) == [0] * 6
    problem = compile_meaning(meaning, compiled=False)
    agents, keys = agents_of([given_architecture(problem)]), evaluation_keys(0, 2)
    silent = compile_meaning(faulty_meaning(meaning, Fault("behavior", "watch", "silent")), compiled=False)
    held = paired_episodes(problem, agents.held(0), keys, 1)
    np.testing.assert_array_equal(paired_episodes(silent, agents, keys, 1).returns, held.returns)


def test_nobody_controls_a_dead_robot(meaning):
    dead = traced(meaning, "robot=1:dead@3")
    assert dead.decisions.controlling[:, 0].tolist() == [1, 1, 1, 0, 0, 0]
    assert dead.decisions.controlling[:, 1].tolist() == [1, 1, -1, -1, -1, -1]
    assert dead.rewards["noted"][1].tolist() == [-1] * 6
    assert traced(meaning, "robot=0:dead").controlling[0] == ["nobody"] * 6


def test_robots_in_loops_have_faults_too():
    meaning = meaning_of(COUNTING.format(robots=14))
    texts = [None, "robot=3:dead", "sensor=count:frozen@2", "behavior=watch:stuck@2", "sensor=count:noise(2)"]
    for text in texts:
        changed = meaning if text is None else faulty_meaning(meaning, read_fault(text, meaning))
        problem = compile_meaning(changed, compiled=False)
        found = trace(problem, given_architecture(problem), episode_key(0, 0), 1)
        returns = paired_episodes(
            problem, agents_of([given_architecture(problem)]), evaluation_keys(0, 1), 1
        ).returns
        by_robot = [
            sum(values)
            for values in zip(*(map(np.sum, term) for term in found.rewards.values()), strict=True)
        ]
        assert returns[0, 0] == pytest.approx(np.mean(by_robot), abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("text", ["sensor=count:noise(2)", "behavior=watch:stuck@2", "robot=1:dead@2"])
def test_compiled_episodes_under_a_fault_are_the_same(meaning, text):
    changed = faulty_meaning(meaning, read_fault(text, meaning))
    results = []
    for compiled in (True, False):
        problem = compile_meaning(changed, compiled=compiled)
        agents = agents_of([given_architecture(problem)])
        results.append(paired_episodes(problem, agents, evaluation_keys(0, 5), 1).returns)
    np.testing.assert_array_equal(*results)


def test_names_of_the_spec_are_not_taken():
    text = COUNTING.format(robots=1).replace("y: 0}", "y: 0, perceived_count: 7, watch_far_before: 1}")
    meaning = meaning_of(text)
    assert inputs(traced(meaning, "sensor=count:lost@4"))[0] == [0, 1, 2, 0, 0, 0]
    assert inputs(traced(meaning, "behavior=watch:stuck@4"))[2] == [0, 0, 0, 1, 1, 1]


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("behavior=watch:silent", Fault("behavior", "watch", "silent")),
        ("behavior=watch:stuck", Fault("behavior", "watch", "stuck", 3)),
        ("behavior=watch:stuck@1", Fault("behavior", "watch", "stuck", 1)),
        ("behavior=rest:random", Fault("behavior", "rest", "random")),
        (" sensor = count : noise( 0.5 ) @ 2 ", Fault("sensor", "count", "noise", 2, 0.5)),
        ("sensor=place:frozen", Fault("sensor", "place", "frozen", 3)),
        ("robot=1:dead", Fault("robot", "1", "dead")),
    ],
)
def test_faults_are_read(meaning, text, fault):
    assert read_fault(text, meaning) == fault
    assert read_fault(fault.text, meaning) == fault


def test_all_stands_for_every_behavior_silent_the_highest_first(meaning):
    silent = [Fault("behavior", name, "silent") for name in ("rest", "watch")]
    assert read_faults(["all"], meaning) == silent
    assert read_faults(["behavior=rest:silent", "robot=0:dead", "all"], meaning) == [
        silent[0], Fault("robot", "0", "dead"), silent[1],
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("watch", "this is not PART=NAME:KIND"),
        ("behaviour=watch:silent", '"behaviour" is not a part; did you mean "behavior"?'),
        ("behavior=wach:silent", '"wach" is not a behavior; did you mean "watch"?'),
        ("behavior=zzz:silent", '"zzz" is not a behavior; known: watch, rest'),
        ("behavior=watch:silnt", 'is not a fault of a behavior; did you mean "silent"?'),
        ("sensor=count:dead", "is not a fault of a sensor; known: noise, frozen, lost"),
        ("sensor=cuont:lost", 'did you mean "count"?'),
        ("robot=2:dead", '"2" is not a robot; known: 0, 1'),
        ("sensor=count:noise", "noise needs its standard deviation"),
        ("sensor=count:noise(x)", "(x) is no standard deviation"),
        ("sensor=count:noise(-1)", "(-1) is no standard deviation"),
        ("sensor=count:noise(nan)", "(nan) is no standard deviation"),
        ("sensor=count:noise(inf)", "(inf) is no standard deviation"),
        ("sensor=place:noise(1)", "place is no number"),
        ("sensor=far:noise(1)", "far is no number"),
        ("sensor=count:lost(2)", "lost has no (...)"),
        ("behavior=watch:stuck@7", "@7 is not one of the steps 1 to 6"),
        ("behavior=watch:stuck@0", "@0 is not one of the steps"),
        ("behavior=watch:stuck@", "@ is not one of the steps"),
        ("behavior=watch:random@2", "a random table is there from the start"),
        ("behavior=\x1b[31m:silent", "\\x1b"),
    ],
)
def test_what_is_not_understood_is_said(meaning, text, said):
    with pytest.raises(NoSuchFault) as caught:
        read_fault(text, meaning)
    assert str(caught.value).startswith("--fault ")
    assert said in str(caught.value)
    assert "\x1b" not in str(caught.value)


def test_a_random_table_is_no_change_of_meaning(meaning):
    with pytest.raises(ValueError, match="no change of a spec's meaning"):
        faulty_meaning(meaning, Fault("behavior", "rest", "random"))
