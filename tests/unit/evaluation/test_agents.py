"""Agents of individuals from pools."""

import numpy as np

from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from tests.unit.problems import RICH, problem_of


def test_a_behavior_held_to_no_action_is_as_good_as_none():
    problem = problem_of(RICH)
    agents = random_agents(problem, 3, 40)
    agents = agents.with_structures(np.tile([0, 1], (40, 1)))
    streams = keys(9, 0, 40)
    for held, other in ((0, 1), (1, 0)):
        without = problem.assemble(agents.pools, agents.members, 1).episode(streams, np.full((40, 1), other))
        silent = agents.held(held)
        outcome = problem.assemble(silent.pools, silent.members, 1).episode(streams, silent.structures)
        np.testing.assert_array_equal(outcome.returns, without.returns)
        np.testing.assert_array_equal(outcome.credit[:, held], np.zeros(40))


def test_holding_a_behavior_leaves_the_agents_and_the_other_behaviors_as_they_were():
    agents = random_agents(problem_of(RICH), 3, 4)
    before = [pool.copy() for pool in agents.pools]
    held = agents.held(1)
    for agent in range(4):
        here, there = agents.architecture(agent), held.architecture(agent)
        assert not there.tables[1].any()
        np.testing.assert_array_equal(there.tables[0], here.tables[0])
        np.testing.assert_array_equal(there.structure, here.structure)
    for pool, copy in zip(agents.pools, before, strict=True):
        np.testing.assert_array_equal(pool, copy)
