import numpy as np
import pytest

from bbsd.evaluation import interval, returns_of
from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from tests.unit.architecture.designs import shipped
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess

BY_28 = -0.716518
"""The expected reward of (28) for seven modules that choose No Action or their action with equal probability."""


def test_random_agents_of_the_abstract_problem_earn_what_28_says():
    problem = problem_of(shipped("abstract"), lanes=40)
    agents = random_agents(problem, 5, 400)
    by_agent = interval(returns_of(problem, agents, keys(1, 0, 25), 1).mean(axis=1))
    assert by_agent.low < BY_28 < by_agent.high
    assert by_agent.high - by_agent.low < 0.06


def test_28_of_seven_modules():
    # Of 7 modules k have an action with probability C(7, k) / 2**7. Somebody acts unless k = 0, and it is right
    # with probability 1/7 whatever k is.
    assert pytest.approx(2 * (1 - 2**-7) / 7 - 1, abs=1e-6) == BY_28


def test_what_is_given_is_kept_and_what_is_open_is_uniform():
    problem, _ = guess("structure: [open, reckless, open]")
    agents = random_agents(problem, 1, 2000)
    odd, even, reckless = agents.pools
    assert (reckless == 1).all()
    assert (even[:, 2] == 2).all()
    for cell in odd.T:
        np.testing.assert_allclose(np.bincount(cell, minlength=3) / 2000, 1 / 3, atol=0.05)
    assert (agents.structures[:, 1] == 2).all()
    np.testing.assert_allclose(np.mean(agents.structures[:, 0] == 0), 0.5, atol=0.05)
    assert {tuple(structure) for structure in agents.structures.tolist()} == {(0, 2, 1), (1, 2, 0)}


def test_every_agent_has_tables_of_its_own():
    problem, _ = guess()
    agents = random_agents(problem, 1, 5)
    np.testing.assert_array_equal(agents.members, np.repeat(np.arange(5)[:, None], 3, axis=1))


def test_fewer_agents_are_the_first_of_more():
    problem, _ = guess()
    few, many = random_agents(problem, 1, 3), random_agents(problem, 1, 6)
    np.testing.assert_array_equal(many.structures[:3], few.structures)
    np.testing.assert_array_equal(many.pools[0][:3], few.pools[0])
