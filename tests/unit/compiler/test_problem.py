import math

import numpy as np
import pytest

from bbsd.compiler.details import Detail
from bbsd.compiler.kernels import kernel_source
from bbsd.evaluation import trace
from bbsd.solver.random_agents import random_agents
from tests.unit.architecture.designs import shipped
from tests.unit.problems import RICH, episode_of, lived, problem_of

N_AGENTS = 20
OUTCOMES = ("returns", "credit", "terms", "control", "steps_taken", "not_finite", "expectations_met")

FIXED = """
bbsd: 1
name: fixed
environment: {steps: 1, state: {x: 0}}
behaviors:
  given: {actions: {a: {x: 1}}, rules: [otherwise: a]}
  half: {inputs: {up: x > 0}, actions: {a: {x: 1}, b: {x: 2}}, rules: [{when: {up: true}, do: b}]}
  other: {actions: {a: {x: 1}}}
%s
reward: {x: x}
"""


@pytest.fixture(scope="module")
def one_by_one():
    return lived(problem_of(RICH), N_AGENTS)


def simply_lived(problem, generation=1):
    """The same episodes as `lived`, by the rollout that the solver calls."""
    agents = random_agents(problem, 0, N_AGENTS)
    keys = np.random.default_rng(0).integers(0, 2**64, N_AGENTS, dtype=np.uint64)
    return problem.assemble(agents.pools, agents.members, generation).episode(keys, agents.structures)


@pytest.mark.parametrize("lanes", [2, 16, 40])
def test_any_number_of_lanes_gives_the_same_bits(lanes, one_by_one):
    together = lived(problem_of(RICH, lanes=lanes), N_AGENTS)
    for name in OUTCOMES:
        np.testing.assert_array_equal(getattr(together, name), getattr(one_by_one, name))


@pytest.mark.slow
def test_compiled_and_plain_give_the_same_bits(rich_compiled, one_by_one):
    compiled = simply_lived(rich_compiled)
    np.testing.assert_array_equal(compiled.returns, one_by_one.returns)
    np.testing.assert_array_equal(compiled.credit, one_by_one.credit)


def test_an_agent_s_episode_is_its_own_whoever_lives_beside_it(one_by_one):
    problem = problem_of(RICH, lanes=3)
    agents = random_agents(problem, 0, N_AGENTS)
    keys = np.random.default_rng(0).integers(0, 2**64, N_AGENTS, dtype=np.uint64)
    some = np.array([11, 2, 7, 3])
    team = problem.assemble(agents.pools, agents.members[some], 1)
    np.testing.assert_array_equal(
        team.episode(keys[some], agents.structures[some]).returns, one_by_one.returns[some]
    )


def test_a_rollout_for_the_solver_and_one_for_evaluation_earn_the_same_bits(one_by_one):
    outcome = simply_lived(problem_of(RICH, lanes=8))
    np.testing.assert_array_equal(outcome.returns, one_by_one.returns)
    np.testing.assert_array_equal(outcome.credit, one_by_one.credit)


def test_a_team_lives_one_episode_after_another_without_a_memory():
    problem = problem_of(RICH, lanes=4)
    agents = random_agents(problem, 0, 3)
    team = problem.assemble(agents.pools, agents.members, 1)
    keys, others = np.arange(3, dtype=np.uint64), np.arange(3, 6, dtype=np.uint64)
    first = team.episode(keys, agents.structures)
    assert (team.episode(others, agents.structures[::-1]).returns != first.returns).any()
    np.testing.assert_array_equal(team.episode(keys, agents.structures).credit, first.credit)


def test_constants_of_the_generation_reach_the_kernel_as_arguments(rich_compiled, one_by_one):
    early, late = (simply_lived(rich_compiled, generation) for generation in (29, 30))
    np.testing.assert_array_equal(early.returns, one_by_one.returns)
    assert (late.returns != early.returns).any()
    assert len(rich_compiled.kernels.rollout.signatures) == 1


def test_constants_that_a_seed_draws_are_no_other_kernel():
    sources = []
    for seed in (1, 2):
        problem = problem_of(shipped("abstract"), seed=seed)
        sources.append(kernel_source(problem.meaning, problem.tables, 40, (Detail.CREDIT,)))
        assert problem.meaning.constants.vector(1) != problem_of(
            shipped("abstract")
        ).meaning.constants.vector(1)
    assert sources[0] == sources[1]


def test_values_that_swap_read_each_other_as_they_were():
    text = """
    bbsd: 1
    name: swap
    environment:
      steps: 3
      state: {a: 1, b: 10, c: "true", d: "false"}
      dynamics: {a: b, b: a, c: d, d: c}
    behaviors: {idle: {actions: {do: {a: a}}}}
    reward: {a: a, b: -b, c: "100 if c else 0", d: "1000 if d else 0"}
    """
    outcome = episode_of(problem_of(text), [[0]], [0])
    assert outcome.terms.tolist() == [[10 + 1 + 10, -(1 + 10 + 1), 100, 2000]]


def test_an_action_reads_the_snapshot_and_what_it_does_not_set_stays():
    text = """
    bbsd: 1
    name: act
    environment: {steps: 1, state: {a: 1, b: 2, flag: "true"}}
    behaviors:
      one: {actions: {swap: {a: b, b: a}, clear: {flag: not flag, a: 5}}}
    reward: {a: a, b: b, flag: "1 if flag else 0"}
    """
    problem = problem_of(text)
    terms = [episode_of(problem, [[action]], [0]).terms[0].tolist() for action in range(3)]
    assert terms == [[1, 2, 1], [2, 1, 1], [5, 2, 0]]


def test_several_behaviors_may_set_the_same_state():
    text = """
    bbsd: 1
    name: same
    environment: {steps: 4, state: {x: 0}}
    behaviors:
      up: {inputs: {low: x < 2}, actions: {by_1: {x: x + 1}, by_2: {x: x + 2}}}
      down: {inputs: {low: x < 2}, actions: {by_3: {x: x - 3}}}
    reward: {x: x}
    """
    outcome = episode_of(problem_of(text), [[0, 2], [1, 0]], [1, 0])  # cells: false, true
    assert outcome.returns.tolist() == [2 - 1 + 1 + 3]
    assert outcome.credit.tolist() == [[2 + 1 + 3, -1, 0]]


def test_a_behavior_without_inputs_has_one_cell_and_one_layer_is_enough():
    text = "\n".join(
        [
            "bbsd: 1",
            "name: least",
            "environment: {steps: 2, state: {x: 0}}",
            "behaviors: {b: {actions: {a: {x: x + 1}}}}",
            "reward: {x: x}",
        ]
    )
    problem = problem_of(text)
    assert (problem.n_behaviors, problem.tables[0].n_cells, problem.layers.tolist()) == (1, 1, [0])
    assert episode_of(problem, [[1]], [0]).returns == 1 + 2
    assert not problem.learns_structure


def test_a_behavior_that_the_structure_leaves_out_is_no_hole():
    problem = problem_of(FIXED % "structure: [given]")
    assert not problem.has_holes
    assert problem.decades == 0
    assert [problem.evolves(behavior) for behavior in range(3)] == [False, False, False]


def test_only_open_cells_and_open_layers_are_searched():
    problem = problem_of(FIXED % "structure: [half, given]")
    assert problem.has_holes
    assert problem.decades == pytest.approx(math.log10(3))
    learned = problem_of(FIXED % "design: {layers: 2}")
    assert learned.decades == pytest.approx(math.log10(3 * 2 * 3 * 2))  # orders of 2 of the 3 behaviors


def test_a_trace_is_the_episode_that_a_rollout_lives():
    problem = problem_of(RICH)
    agents = random_agents(problem, 0, 3)
    for agent in range(3):
        architecture = agents.architecture(agent)
        outcome = episode_of(problem, architecture.tables, architecture.structure, key=agent)
        traced = trace(problem, architecture, agent, 1)
        assert len(traced.steps) == outcome.steps_taken[0]
        earned = [np.sum(traced.rewards[term]) / 3 for term in ("near", "level")]
        np.testing.assert_allclose(outcome.terms[0], earned, rtol=1e-12)
