"""Episodes whose angles are kept as tangents, beside those that compute arctangents."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from bbsd.compiler.details import Detail
from bbsd.compiler.kernels import kernel_source
from bbsd.compiler.passes.tangents import compare_tangents
from bbsd.expression.graph import evaluate
from bbsd.kernel import functions
from bbsd.solver.random_agents import random_agents
from tests.unit.architecture.designs import meaning_of, shipped
from tests.unit.problems import problem_of

SWAYING = """
bbsd: 1
name: swaying
constants: {{steep: 0.6, none: 0}}
environment:
  robots: {robots}
  steps: 8
  state: {{x: "uniform(-2, 2)", y: "normal(0, 1)"}}
  dynamics: {{x: "x + normal(0, 0.5)", y: "{y}"}}
  sensors:
    slope: {slope}
    leaning: {leaning}
  {ends}
behaviors:
  lean: {{inputs: {{leaning: leaning}}, actions: {{more: {{x: x + 0.5}}, less: {{x: x - 0.5}}}}}}
  rest: {{actions: {{stay: {{y: y}}}}}}
reward: {{earned: "{reward}"}}
"""
SLOPE = "atan(hypot(x, y))"


def swaying(
    *,
    robots=2,
    slope=SLOPE,
    leaning="slope > steep",
    y="y / 2",
    ends="",
    reward="1",
    lanes=None,
    compiled=False,
):
    text = SWAYING.format(robots=robots, slope=slope, leaning=leaning, y=y, ends=ends, reward=reward)
    return problem_of(text, lanes=lanes, compiled=compiled)


def source_of(problem, detail=Detail.CREDIT):
    return kernel_source(problem.meaning, problem.tables, problem.lanes, (detail,))


def arctangents_of_a_step(problem):
    return source_of(problem).split("for step in")[1].replace("tan2(", "").count("atan(")


def team_of(problem, n_agents=24, seed=0):
    agents = random_agents(problem, seed, n_agents)
    keys = np.random.default_rng(seed).integers(0, 2**64, n_agents, dtype=np.uint64)
    return problem.assemble(agents.pools, agents.members, 1), keys, agents.structures


def both(problem, seed=0):
    """All bits of what the rollout and the detailed one give, and whether the first was uncertain."""
    team, keys, structures = team_of(problem, seed=seed)
    outcome, detailed = team.episode(keys, structures), team.detailed_episode(keys, structures)
    bits = [[each.returns.tobytes(), each.credit.tobytes()] for each in (outcome, detailed)]
    return bits[0], bits[1], team._uncertain


COMPARED = {
    "alone": {},
    "at least": {"leaning": "slope >= steep"},
    "mirrored": {"leaning": "steep <= slope", "reward": "1 if 0.2 > slope else 0"},
    "in degrees": {"slope": "degrees(atan(hypot(x, y)))", "leaning": "slope < 50 * steep"},
    "of either sign": {"slope": "atan(x)", "leaning": "slope < -steep"},
    "with nothing": {"slope": "atan(x)", "leaning": "slope > none"},
    "risen": {"reward": "1 if slope - before(slope) > 0.05 else -1"},
    "fallen by a constant": {"reward": "1 if slope - before(slope) <= -steep / 6 else -1"},
    "one within another": {"reward": "1 if atan(hypot(x, 1 if atan(y) > 0.3 else 2)) > 0.9 else 0"},
    "many": {"reward": "sum(1 if atan(x * k) > 0.1 else 0 for k in range(400))"},
    "two angles": {"reward": "1 if atan(abs(x)) - atan(sqrt(abs(y))) >= 0.1 else 0"},
    "an end": {"ends": 'ends: "any(slope[r] > 1.3 for r in team)"', "reward": "1 if slope < 1 else 0.5"},
}


@pytest.mark.slow
@pytest.mark.parametrize("robots", [1, 2, 5])
@pytest.mark.parametrize("how", COMPARED)
def test_comparisons_need_no_arctangent_and_change_no_bit(how, robots):
    problem = swaying(robots=robots, **COMPARED[how])
    assert arctangents_of_a_step(problem) == 0
    swift, detailed, uncertain = both(problem)
    assert swift == detailed
    assert not uncertain


@pytest.mark.slow
def test_lifting_computes_no_arctangent_in_its_steps_and_changes_no_bit():
    problem = problem_of(shipped("object_lifting"), lanes=16, compiled=True)
    assert arctangents_of_a_step(problem) == 0
    assert source_of(problem, Detail.TERMS).split("for step in")[1].count("atan(") == 1
    swift, detailed, uncertain = both(problem)
    assert swift == detailed
    assert not uncertain


@pytest.mark.parametrize(
    "needed",
    [
        {"reward": "slope"},
        {"reward": "1 if slope - before(slope) < 0 else 0"},
        {"reward": "1 if slope < x else 0"},
        {"reward": "1 if slope + before(slope) < 0.5 else 0"},
        {"slope": "atan(x)", "reward": "1 if slope - before(slope) < 0.5 else 0"},
        {"robots": 5, "reward": "sum(slope[r] for r in team)"},
    ],
    ids=["itself", "unchanged", "with a variable", "a sum", "of either sign", "a sum of the team"],
)
def test_an_angle_that_is_needed_is_computed_and_then_compared(needed):
    problem = swaying(**needed)
    assert arctangents_of_a_step(problem) > 0
    assert "uncertain" not in source_of(problem)
    swift, detailed, _ = both(problem)
    assert swift == detailed


def test_one_angle_is_needed_another_is_not():
    problem = swaying(robots=1, reward="(1 if atan(y) > 0.1 else 0) + atan(x)")
    assert arctangents_of_a_step(problem) == 1
    swift, detailed, _ = both(problem)
    assert swift == detailed


@pytest.mark.parametrize(
    "unsure",
    [
        {"y": "y", "reward": "1 if atan(abs(y)) - atan(abs(y + 0)) < none else 0"},
        {"leaning": "slope > steep * 3"},
        {"slope": "atan(sqrt(x))", "leaning": "slope > steep"},
        {"slope": "atan(abs(tan(steep) + 0 * x))", "leaning": "slope >= steep", "reward": "x"},
    ],
    ids=["no difference", "almost upright", "no number", "the very angle"],
)
@pytest.mark.parametrize("robots", [1, 5])
def test_where_a_comparison_is_not_certain_arctangents_decide(unsure, robots):
    problem = swaying(robots=robots, **unsure)
    assert arctangents_of_a_step(problem) == 0
    swift, detailed, uncertain = both(problem)
    assert uncertain
    assert swift == detailed


def test_an_uncertain_comparison_after_the_end_of_an_episode_does_not_count():
    settings = {"slope": "atan(sqrt(2.5 - step + 0 * x))", "leaning": "slope > steep", "robots": 1}
    assert both(swaying(**settings))[2]
    swift, detailed, uncertain = both(swaying(ends='ends: "step >= 2"', **settings))
    assert swift == detailed
    assert not uncertain


def test_an_uncertain_comparison_of_the_team_is_one_where_robots_are_looped_over():
    settings = {"reward": "1 if atan(sqrt(sum(x[r] for r in team))) > 0.5 else 0", "robots": 5}
    problem = swaying(**settings)
    assert arctangents_of_a_step(problem) == 0
    swift, detailed, uncertain = both(problem)
    assert uncertain
    assert swift == detailed


@pytest.mark.parametrize("uncertain_lane", [None, 3, 150])
def test_one_uncertain_comparison_among_many_lanes_in_one_of_several_threads(uncertain_lane):
    text = SWAYING.format(
        robots=1,
        slope="atan(sqrt(x))",
        leaning="slope > steep",
        y="y",
        ends="",
        reward="1 if slope > 1 else 0",
    )
    text = (
        text.replace("steps: 8", "steps: 1500")
        .replace("uniform(-2, 2)", "1000")
        .replace("normal(0, 0.5)", "0")
    )
    text = text.replace("x: x + 0.5", "x: -1").replace("x: x - 0.5", "x: 1001")
    problem = problem_of(text, lanes=8, compiled=True, jobs=2)
    choices = np.full(160, 2, np.uint8)
    if uncertain_lane is not None:
        choices[uncertain_lane] = 1
    pools = (np.repeat(choices[:, np.newaxis], 2, axis=1), np.zeros((160, 1), np.uint8))
    members = np.stack([np.arange(160), np.arange(160)], axis=1)
    team = problem.assemble(pools, members, 1)
    assert len(problem.kernels._spans(160)) == 2
    returns = team.episode(np.arange(160, dtype=np.uint64), np.tile([1, 0], (160, 1))).returns
    assert returns.tolist() == [0.0 if lane == uncertain_lane else 1500.0 for lane in range(160)]
    assert team._uncertain is (uncertain_lane is not None)


# --- Told apart from all else in the episode


def test_a_slot_of_the_designer_s_with_the_name_of_a_tangent():
    text = """
    bbsd: 1
    name: names
    environment:
      robots: {robots}
      steps: 3
      state: {{x: "uniform(-2, 2)"}}
      dynamics: {{x: "x + 0.5"}}
      sensors: {{slope: "atan(x)", tangent_of_slope: "10 * x", slope_: "atan(abs(x))"}}
    behaviors:
      lean: {{inputs: {{steep: "slope > 0.6", steeper: "slope_ > 0.7"}}, actions: {{a: {{x: x + 1}}}}}}
    reward: {{earned: {reward}}}
    """
    for robots in (1, 2, 5):
        for reward in ("tangent_of_slope", "1"):
            problem = problem_of(text.format(robots=robots, reward=reward))
            assert arctangents_of_a_step(problem) == 0
            swift, detailed, uncertain = both(problem)
            assert swift == detailed
            assert not uncertain


@pytest.mark.parametrize("robots", [1, 2, 3, 5])
@pytest.mark.parametrize(
    "sets", ["z", "z + 3", "z + 3.5 * z", "z + 3 + z", "z * z * z + 3 * z", "z * z * z + 3 * z + 1 + z + 4"]
)
def test_what_nothing_earned_depends_on_has_numbers_of_its_own(sets, robots):
    problem = problem_of(f"""
    bbsd: 1
    name: apart
    environment: {{robots: {robots}, steps: 8, state: {{x: "uniform(-2, 2)", z: 0}}}}
    behaviors:
      lean: {{inputs: {{leaning: "(1 if atan(x) > 0.6 else 0) == 1"}}, actions: {{more: {{z: 1}}}}}}
      rest: {{inputs: {{leaning: "(1 if atan(x) > 0.6 else 0) == 1"}}, actions: {{stay: {{z: "{sets}"}}}}}}
    reward: {{earned: "1 if atan(x) > 0.6 else 0"}}
    """)
    assert arctangents_of_a_step(problem) == 0
    swift, detailed, uncertain = both(problem)
    assert swift == detailed
    assert not uncertain


@pytest.mark.parametrize("robots", [1, 2, 5])
def test_comparisons_at_the_start_are_made_with_arctangents(robots):
    problem = problem_of(f"""
    bbsd: 1
    name: drawn
    constants: {{bound: 1.1071487177940904}}
    environment:
      robots: {robots}
      steps: 1
      state: {{z: 0}}
      sensors: {{slope: "atan(2 if atan(1 + integers(-1, 60)) > bound else 0.2)"}}
    behaviors:
      lean: {{inputs: {{leaning: "slope > 0.5"}}, actions: {{more: {{z: 1}}, less: {{z: 2}}}}}}
    reward: {{earned: z}}
    """)
    for seed in range(40):
        swift, detailed, _ = both(problem, seed)
        assert swift == detailed


@pytest.mark.slow
def test_thousands_of_comparisons_do_not_nest():
    problem = swaying(robots=1, y="y / 2", reward="sum(1 if atan(x * k) > 0.1 else 0 for k in range(4000))")
    assert (
        max(line.count("select") for line in source_of(problem).splitlines() if "uncertain[lane] =" in line)
        == 1
    )


# --- What is certain, is so


def compared(text):
    """The reward of a spec with two numbers and a bound; how to compute it and whether it is certain."""
    episode = meaning_of(f"""
    bbsd: 1
    name: compared
    constants: {{bound: 0.5}}
    environment: {{steps: 2, state: {{u: 1, v: 2}}, dynamics: {{u: u * 2, v: v * 2}}}}
    behaviors: {{b: {{inputs: {{far: u > v}}, actions: {{a: {{u: u}}}}}}}}
    reward: {{earned: "{text}"}}
    """).episode
    after, certain = compare_tangents(episode)
    assert certain
    return [*episode.reward["earned"], *after.reward["earned"], *certain]


def outcome_of(nodes, u, v, bound):
    """What arctangents say, what tangents say, and whether that is certain."""

    def leaf(node, _operands):
        return {"slot": u if node.data and node.data[0] == "u" else v, "constant": bound}[node.operation]

    with np.errstate(all="ignore"):
        meant, found, *certain = evaluate(nodes, leaf)
    return meant, found, all(certain)


ALONE = {op: compared(f"1 if atan(before(u)) {op} bound else 0") for op in ("<", "<=", ">", ">=")}
APART = {
    op: compared(f"1 if degrees(atan(abs(before(u)))) - degrees(atan(abs(before(v)))) {op} bound else 0")
    for op in ("<", "<=", ">", ">=")
}
ANGLES = st.floats(-1.6, 1.6)
NEAR = st.integers(-40, 40) | st.integers(-(10**6), 10**6)
"""Units in the last place."""
SIZES = st.floats(0.0, 1e3) | st.floats(0.0) | st.just(math.inf)


def moved(x, ulps):
    return x + ulps * math.ulp(x)


@given(bound=ANGLES, ulps=NEAR, operation=st.sampled_from(list(ALONE)))
@example(bound=0.0, ulps=0, operation="<")
@example(bound=1.55, ulps=3, operation=">")
def test_an_angle_compares_as_its_tangent_does(bound, ulps, operation):
    meant, found, certain = outcome_of(ALONE[operation], moved(math.tan(bound), ulps), 0.0, bound)
    assert found == meant or not certain


@given(u=st.floats(), bound=ANGLES, operation=st.sampled_from(list(ALONE)))
def test_any_number_s_arctangent_compares_so_too(u, bound, operation):
    meant, found, certain = outcome_of(ALONE[operation], u, 0.0, bound)
    assert found == meant or not certain


@given(v=SIZES, bound=st.floats(-89, 89), ulps=NEAR, operation=st.sampled_from(list(APART)))
def test_angles_that_differ_by_hardly_more_or_less_than_the_bound(v, bound, ulps, operation):
    angle = functions.atan(v) + math.radians(bound)
    assume(0 < angle < math.pi / 2)
    meant, found, certain = outcome_of(APART[operation], moved(math.tan(angle), ulps), v, bound)
    assert found == meant or not certain


@given(u=SIZES, v=SIZES, bound=st.floats(-100, 100), operation=st.sampled_from(list(APART)))
@example(u=1.7e308, v=1.06, bound=30.0, operation="<")
@example(u=1e200, v=1e200, bound=-0.5, operation="<")
@example(u=math.inf, v=1.0, bound=0.5, operation=">")
def test_any_two_angles(u, v, bound, operation):
    meant, found, certain = outcome_of(APART[operation], u, v, bound)
    assert found == meant or not certain


@given(u=st.floats(0.0, 1e3), v=st.floats(0.0, 1e3), bound=st.floats(1e-6, 80))
def test_almost_all_is_certain(u, v, bound):
    apart = abs(math.degrees(math.atan(u) - math.atan(v)) - bound)
    assume(apart > 1e-8)
    assert outcome_of(APART["<"], u, v, bound)[2]
