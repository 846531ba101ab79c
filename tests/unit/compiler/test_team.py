"""Agents side by side in the lanes of a kernel."""

import numpy as np
import pytest

from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from tests.unit.problems import RICH, problem_of

N_AGENTS = 7


@pytest.mark.parametrize("lanes", [1, 3, 8])
def test_lanes_beyond_the_last_agent_change_nothing_and_are_not_returned(lanes):
    problem = problem_of(RICH, lanes=lanes)
    agents = random_agents(problem, 5, N_AGENTS)
    streams = keys(9, 0, N_AGENTS)
    together = problem.assemble(agents.pools, agents.members, 1).episode(streams, agents.structures)
    assert together.returns.shape == (N_AGENTS,)
    assert together.credit.shape == (N_AGENTS, problem.n_behaviors + 1)
    for agent in range(N_AGENTS):
        one = slice(agent, agent + 1)
        alone = problem.assemble(agents.pools, agents.members[one], 1)
        outcome = alone.episode(streams[one], agents.structures[one])
        np.testing.assert_array_equal(outcome.credit[0], together.credit[agent])
