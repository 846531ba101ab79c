"""Agents side by side in lanes, and lanes shared between threads."""

from dataclasses import replace

import numpy as np
import pytest

from bbsd.compiler import team as teams
from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from tests.unit.problems import RICH, problem_of

N_AGENTS = 23


@pytest.fixture
def every_thread_is_worth_it(monkeypatch):
    monkeypatch.setattr(teams, "WORTH_A_THREAD", 1)


def lived(problem):
    agents = random_agents(problem, 5, N_AGENTS)
    team = problem.assemble(agents.pools, agents.members, 1)
    return team.detailed_episode(keys(9, 0, N_AGENTS), agents.structures)


@pytest.mark.parametrize("jobs", [2, 3, 16])
@pytest.mark.usefixtures("every_thread_is_worth_it")
def test_any_number_of_jobs_gives_the_same_bits(jobs):
    problem = problem_of(RICH, lanes=4)
    alone, together = lived(problem), lived(replace(problem, jobs=jobs))
    for name in ("returns", "credit", "terms", "control", "steps_taken", "not_finite", "expectations_met"):
        np.testing.assert_array_equal(getattr(together, name), getattr(alone, name))


@pytest.mark.usefixtures("every_thread_is_worth_it")
@pytest.mark.parametrize(
    ("jobs", "spans"), [(1, [(0, 24)]), (2, [(0, 12), (12, 24)]), (4, [(0, 4), (4, 12), (12, 16), (16, 24)])]
)
def test_threads_share_whole_batches_of_lanes(jobs, spans):
    problem = problem_of(RICH, lanes=4, jobs=jobs)
    agents = random_agents(problem, 5, N_AGENTS)
    assert problem.assemble(agents.pools, agents.members, 1)._spans() == spans


def test_little_work_is_not_shared():
    problem = problem_of(RICH, lanes=4, jobs=4)
    agents = random_agents(problem, 5, N_AGENTS)
    assert problem.assemble(agents.pools, agents.members, 1)._spans() == [(0, 24)]
