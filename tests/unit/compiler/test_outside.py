"""Worlds that are stepped in Python earn, credit and show what the same worlds in the language do, to the last bit."""

from dataclasses import replace

import numpy as np
import pytest

import bbsd
from bbsd.compiler.details import PHASES, Detail, traced_columns
from bbsd.compiler.kernels import kernel_source
from bbsd.compiler.passes.pipeline import run_passes
from bbsd.compiler.tables import shape_of
from bbsd.environments.stepping import EnvironmentNotImported
from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from tests.unit.architecture.designs import shipped
from tests.unit.compiler.twins import (
    CARTPOLE_OUTSIDE,
    CORRIDOR_INSIDE,
    CORRIDOR_OUTSIDE,
    Corridor,
    Drawn,
    Pole,
)
from tests.unit.problems import problem_of

CARTPOLE = shipped("tasks/cartpole").replace("steps: 500", "steps: 60")
N_AGENTS = 9


def new_pole(drawn=Drawn(CARTPOLE, ["x", "speed", "angle", "turning"])):  # noqa: B008 - drawn once
    return Pole(drawn)


def outside(text, stepper, **changes):
    return replace(problem_of(text, lanes=4), stepper=stepper, **changes)


WORLDS = {
    "corridor": (CORRIDOR_INSIDE, CORRIDOR_OUTSIDE, Corridor),
    "cartpole": (CARTPOLE, CARTPOLE_OUTSIDE, new_pole),
}


@pytest.fixture(params=WORLDS)
def twins(request):
    inside, stepped, stepper = WORLDS[request.param]
    return problem_of(inside, lanes=4), outside(stepped, stepper)


def agents_of(problem, order=slice(None)):
    agents = random_agents(problem, 3, N_AGENTS)
    team = problem.assemble(agents.pools, agents.members[order], 1)
    return team, keys(4, 0, N_AGENTS)[order], agents.structures[order]


def outcomes(problem, order=slice(None)):
    team, streams, structures = agents_of(problem, order)
    one, other = team.episode(streams, structures), team.detailed_episode(streams, structures)
    names = ("returns", "credit", "terms", "control", "steps_taken", "expectations_met")
    return [one.returns, one.credit, *(getattr(other, name) for name in names)]


def practiced(problem):
    team, streams, structures = agents_of(problem)
    records = []

    def learn(steps, steps_taken):
        for lane, taken in enumerate(steps_taken.astype(int)):
            records.append([part[:taken, ..., lane].copy() for part in steps[1:]])

    rates = np.linspace(0.0, 0.9, N_AGENTS)
    open_cells = np.ones(sum(table.n_cells for table in problem.tables), np.uint8)
    returns = team.practice(streams, structures, rates, open_cells, learn)
    return [returns, *(part for record in records for part in record)]


def assert_same(ones, others):
    assert len(ones) == len(others)
    for one, other in zip(ones, others, strict=True):
        assert one.tobytes() == other.tobytes()


@pytest.mark.parametrize("live", [outcomes, practiced])
def test_a_world_stepped_in_python_earns_what_the_same_world_in_the_language_does(twins, live):
    inside, stepped = twins
    ones = live(inside)
    assert_same(ones, live(stepped))
    assert len(set(ones[0])) > 1


def test_lanes_end_at_different_steps_and_are_then_left_alone(twins):
    *_, steps_taken, _ = outcomes(twins[1])
    assert len(set(steps_taken)) > 2


def test_only_living_lanes_are_stepped():
    steppers = []

    def new_stepper():
        steppers.append(Corridor())
        return steppers[-1]

    problem = outside(CORRIDOR_OUTSIDE, new_stepper)
    team, streams, structures = agents_of(problem)
    steps_taken = team.detailed_episode(streams, structures).steps_taken
    (stepper,) = steppers
    assert stepper.steps == steps_taken.sum()


def test_the_order_of_the_agents_and_the_lanes_change_nothing(twins):
    _, stepped = twins
    alone = outcomes(stepped)
    order = np.random.default_rng(0).permutation(N_AGENTS)
    for lanes in (1, 3, 16):
        others = outcomes(replace(stepped, lanes=lanes), order)
        assert_same([each[order] for each in alone], [np.ascontiguousarray(each) for each in others])


def traced(problem):
    """The columns of the traces of three agents by what they show."""
    team, streams, structures = agents_of(problem)
    columns, n_steps = traced_columns(problem.meaning), problem.meaning.spec.environment.steps
    records = []
    for agent in range(3):
        record = np.zeros((n_steps, len(columns)))
        taken = team.traced_episode(streams[agent], structures[agent], record)
        records.append(dict(zip(columns, record[:taken].T, strict=True)))
    return records


def test_traces_show_the_same(twins):
    inside, stepped = map(traced, twins)
    for one, other in zip(inside, stepped, strict=True):
        shared = one.keys() & other.keys()
        assert {column.content for column in shared} >= {"slot", "choice", "reward", "excited", "cell"}
        for column in shared:
            assert one[column].tobytes() == other[column].tobytes()


def test_what_was_earned_and_observed_is_traced():
    for record in traced(outside(CORRIDOR_OUTSIDE, Corridor)):
        shown = {column.slot.text(2): values for column, values in record.items() if column.content == "slot"}
        np.testing.assert_array_equal(shown["earned_0"], shown["place_0"] == 7)


def test_no_episode_is_run_twice_for_an_angle():
    turning = CORRIDOR_OUTSIDE.replace("charger: {left: place > 7", "charger: {left: atan(place) > atan(7)")
    problem = outside(turning, Corridor)
    (program,) = run_passes(problem.meaning, [Detail.CREDIT]).values()
    assert "atan(place)" in turning
    assert program.to_prove == ()


@pytest.mark.slow
def test_compiled_worlds_earn_the_same(twins):
    inside, stepped = twins
    assert_same(outcomes(inside), outcomes(replace(stepped, compiled=True)))


def test_without_a_stepper_episodes_are_refused_but_nothing_else():
    problem = problem_of(CORRIDOR_OUTSIDE)
    team, streams, structures = agents_of(problem)
    with pytest.raises(EnvironmentNotImported, match="environment corridors:Corridor, which"):
        team.episode(streams, structures)
    with pytest.raises(EnvironmentNotImported):
        team.traced_episode(streams[0], structures[0], np.zeros((9, len(traced_columns(problem.meaning)))))


def test_the_source_of_a_spec_whose_world_is_stepped_in_python(golden):
    problem = problem_of(CORRIDOR_OUTSIDE)
    tables = [shape_of(module) for module in problem.meaning.episode.modules]
    source = kernel_source(problem.meaning, tables, 8, [Detail.CREDIT], in_phases=True)
    golden("compiler/corridor.py", source.partition("\n\n")[2])


def test_compile_prints_phases_only_where_python_steps_the_environment(tmp_path):
    path = tmp_path / "corridor.yaml"
    path.write_text(CORRIDOR_OUTSIDE, encoding="utf-8")
    phases = [f"def {name}_{phase}(" for name in ("rollout", "rollout_detailed") for phase in PHASES]
    assert [each for each in phases if each not in bbsd.compile(path)] == []
    path.write_text(CORRIDOR_INSIDE, encoding="utf-8")
    assert [each for each in phases if each in bbsd.compile(path)] == []
