"""Rollouts in phases: the same bits as whole ones."""

from dataclasses import replace

import numpy as np
import pytest

from bbsd.api.specs import load
from bbsd.compiler import compile_meaning
from bbsd.compiler.details import Detail, traced_columns
from bbsd.compiler.kernels import kernel_source
from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from tests.unit.architecture.designs import SPECS
from tests.unit.problems import RICH, problem_of

N_AGENTS = 7
MANY = RICH.replace("robots: 3", "robots: 5").replace("name: rich", "name: many")
"""Robots in loops."""
SHIPPED = sorted(path for path in SPECS.glob("**/*.yaml") if not path.stem.endswith("_hand"))
SHIPPED = [path for path in SHIPPED if path.parent.name != "gymnasium"]
SHORT = ("environment.steps=12",)


class Still:
    """An environment that nothing is exchanged with: the world is the spec's own."""

    def reset(self, lanes, keys, outside):
        assert len(keys) >= len(lanes)
        assert outside.shape[0] == 0

    def step(self, lanes, sent, outside):
        assert len(lanes) > 0


def in_phases(problem, **changes):
    return replace(problem, stepper=Still, **changes)


def lived(problem, n_agents=N_AGENTS):
    agents = random_agents(problem, 5, n_agents)
    team = problem.assemble(agents.pools, agents.members, 1)
    return team, keys(9, 0, n_agents), agents.structures


def outcomes(problem):
    team, streams, structures = lived(problem)
    one, other = team.episode(streams, structures), team.detailed_episode(streams, structures)
    names = ("returns", "credit", "terms", "control", "steps_taken", "not_finite", "expectations_met")
    return [one.returns, one.credit, *(getattr(other, name) for name in names)]


def practiced(problem):
    """What practice returns, and what it records of the steps that were taken, lane by lane."""
    team, streams, structures = lived(problem)
    records = []

    def learn(steps, steps_taken):
        for lane, taken in enumerate(steps_taken.astype(int)):
            records.append([part[:taken, ..., lane].copy() for part in steps[1:]])

    n_cells = sum(table.n_cells for table in problem.tables)
    rates = np.linspace(0.0, 0.9, N_AGENTS)
    returns = team.practice(streams, structures, rates, np.ones(n_cells, np.uint8), learn)
    return [returns, *(part for record in records for part in record)]


def traced(problem):
    team, streams, structures = lived(problem)
    shape = problem.meaning.spec.environment.steps, len(traced_columns(problem.meaning))
    records = []
    for agent in range(3):
        record = np.zeros(shape)
        taken = team.traced_episode(streams[agent], structures[agent], record)
        records += [record, np.array(taken)]
    return records


def assert_same(ones, others):
    assert len(ones) == len(others)
    for one, other in zip(ones, others, strict=True):
        np.testing.assert_array_equal(one, other)
        assert one.tobytes() == other.tobytes()


@pytest.mark.parametrize("text", [RICH, MANY], ids=["written out", "in loops"])
@pytest.mark.parametrize("live", [outcomes, practiced, traced])
def test_phases_give_the_same_bits_as_a_whole_rollout(text, live):
    whole = problem_of(text, lanes=4)
    assert_same(live(whole), live(in_phases(whole)))


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_shipped_worlds_in_phases_give_the_same_bits(path):
    whole = compile_meaning(load(path, set=SHORT).meaning, lanes=4, compiled=False)
    for live in (outcomes, practiced):
        assert_same(live(whole), live(in_phases(whole)))


@pytest.mark.slow
def test_compiled_phases_give_the_same_bits(rich_compiled):
    assert_same(outcomes(rich_compiled), outcomes(in_phases(rich_compiled)))
    assert_same(practiced(rich_compiled), practiced(in_phases(rich_compiled)))


def test_lanes_may_be_any_number():
    problem = in_phases(problem_of(RICH))
    for lanes in (1, 3, 7, 8):
        assert_same(outcomes(problem), outcomes(replace(problem, lanes=lanes)))


def test_every_phase_names_only_what_it_uses():
    problem = problem_of(RICH)
    source = kernel_source(problem.meaning, problem.tables, 4, [*Detail][:-1], in_phases=True)
    for function in source.split("\n\n\n")[1:]:
        for line in function.splitlines():
            name, is_setup, _ = line.strip().partition(" = part(")
            if is_setup:
                assert function.count(name) > 1, line
