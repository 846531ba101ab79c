"""Lanes shared between threads."""

from dataclasses import replace

import numpy as np
import pytest

from bbsd.compiler import kernels
from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from tests.unit.problems import RICH, problem_of

N_AGENTS = 23


@pytest.fixture
def every_thread_is_worth_it(monkeypatch):
    monkeypatch.setattr(kernels, "WORTH_A_THREAD", 1)


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
    assert problem.kernels._spans(24) == spans


def test_little_work_is_not_shared():
    problem = problem_of(RICH, lanes=4, jobs=4)
    assert problem.kernels._spans(24) == [(0, 24)]


def test_a_rollout_that_is_uncertain_in_one_span_is_uncertain(monkeypatch):
    monkeypatch.setattr(kernels, "WORTH_A_THREAD", 1)
    problem = problem_of(RICH, lanes=4, jobs=3)
    spans = []

    def rollout(first, last, _memory):
        spans.append((first, last))
        return first <= 9 < last

    assert problem.kernels.run(rollout, 24)
    assert not problem.kernels.run(lambda *_: None, 24)
    assert sorted(spans) == problem.kernels._spans(24)


def test_compiling_takes_as_long_as_the_text_is_and_no_time_once_it_is_in_the_cache(monkeypatch, tmp_path):
    monkeypatch.setenv("BBSD_CACHE_DIR", str(tmp_path))
    problem = problem_of(RICH, lanes=3, compiled=True)
    whole = problem.kernels.seconds_to_compile()
    texts = kernels.kernel_source(problem.meaning, problem.tables, 3, kernels.BATCHES).split("\ndef ")[1:]
    assert whole == kernels.SECONDS_TO_BEGIN + sum(map(len, texts)) * kernels.SECONDS_A_CHARACTER
    assert problem.kernels.seconds_to_compile(practices=True) > whole
    lived(problem)
    assert problem.kernels.seconds_to_compile() == (
        kernels.SECONDS_TO_BEGIN + len(texts[0]) * kernels.SECONDS_A_CHARACTER
    )
    agents = random_agents(problem, 5, N_AGENTS)
    problem.assemble(agents.pools, agents.members, 1).episode(keys(9, 0, N_AGENTS), agents.structures)
    assert problem.kernels.seconds_to_compile() == 0.0


def test_what_runs_as_plain_python_is_not_compiled():
    assert problem_of(RICH).kernels.seconds_to_compile() == 0.0
