"""Agents divided among processes: the same bits for any number of them."""

import os
import signal
from dataclasses import replace

import numpy as np
import pytest

from bbsd.compiler import divided
from bbsd.compiler.divided import DividedTeam, StepperKilled
from bbsd.compiler.team import Team
from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from tests.unit.compiler.twins import CORRIDOR_OUTSIDE, Corridor
from tests.unit.problems import RICH, problem_of

N_AGENTS = 11
NAMES = ("returns", "credit", "terms", "control", "steps_taken", "not_finite", "expectations_met")


@pytest.fixture(autouse=True)
def every_step_is_worth_it(monkeypatch):
    monkeypatch.setattr(divided, "WORTH_DIVIDING", 1)


@pytest.fixture(scope="module", autouse=True)
def no_process_is_left():
    yield
    if divided._ready.cache_info().currsize:
        divided._ready(1).stop()
        divided._ready.cache_clear()


class Fatal(Corridor):
    """A corridor that kills every process but the one of the tests."""

    parent = os.getpid()

    def step(self, lanes, sent, outside):
        if os.environ.get("FATAL_FOR") != str(os.getpid()):
            os.kill(os.getpid(), signal.SIGKILL)
        super().step(lanes, sent, outside)


def stepped(jobs, stepper=Corridor, lanes=4):
    return replace(problem_of(CORRIDOR_OUTSIDE, lanes=lanes), stepper=stepper, jobs=jobs)


def lived(problem):
    agents = random_agents(problem, 3, N_AGENTS)
    team = problem.assemble(agents.pools, agents.members, 1)
    streams = keys(4, 0, N_AGENTS)
    one, other = team.episode(streams, agents.structures), team.detailed_episode(streams, agents.structures)
    return [one.returns, one.credit, *(getattr(other, name) for name in NAMES)]


def practiced(problem):
    agents = random_agents(problem, 3, N_AGENTS)
    team = problem.assemble(agents.pools, agents.members, 1)
    records = []

    def learn(steps, steps_taken):
        for lane, taken in enumerate(steps_taken.astype(int)):
            records.append(np.array(steps.first + lane))
            records.extend(part[:taken, ..., lane].copy() for part in steps[1:])

    open_cells = np.ones(sum(table.n_cells for table in problem.tables), np.uint8)
    rates = np.linspace(0.0, 0.9, N_AGENTS)
    returns = team.practice(keys(4, 0, N_AGENTS), agents.structures, rates, open_cells, learn)
    return [returns, *records]


@pytest.mark.slow
@pytest.mark.parametrize("live", [lived, practiced])
def test_two_processes_give_the_bits_of_one(live):
    alone, together = live(stepped(1)), live(stepped(2))
    assert len(alone) == len(together)
    for one, other in zip(alone, together, strict=True):
        assert np.ascontiguousarray(one).tobytes() == np.ascontiguousarray(other).tobytes()


def test_one_job_and_worlds_of_the_spec_s_own_are_not_divided():
    agents = random_agents(stepped(1), 3, N_AGENTS)
    assert type(stepped(1).assemble(agents.pools, agents.members, 1)) is Team
    assert type(stepped(2).assemble(agents.pools, agents.members, 1)) is DividedTeam
    own = problem_of(RICH, jobs=2)
    agents = random_agents(own, 3, N_AGENTS)
    assert type(own.assemble(agents.pools, agents.members, 1)) is Team


def test_what_is_soon_done_is_done_here(monkeypatch):
    monkeypatch.setattr(divided, "WORTH_DIVIDING", 10_000)
    monkeypatch.setattr(divided, "_ready", None)
    assert len(lived(stepped(2))) == 2 + len(NAMES)


@pytest.mark.slow
def test_an_environment_that_kills_its_processes_is_told_and_others_go_on(monkeypatch):
    monkeypatch.setenv("FATAL_FOR", str(os.getpid()))
    with pytest.raises(StepperKilled, match="were killed"):
        lived(stepped(2, Fatal))
    assert lived(stepped(2))[0].tobytes() == lived(stepped(1))[0].tobytes()
