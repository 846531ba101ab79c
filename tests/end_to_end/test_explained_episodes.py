"""What an explanation says of cells is held against episodes of specs that are made up."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bbsd.architecture import Architecture, joint_space
from bbsd.architecture.possible import possible_cells
from bbsd.compiler import compile_meaning
from bbsd.evaluation import trace
from bbsd.explanation import explain_architecture
from tests.interpreter.made_up import specs
from tests.interpreter.made_up_designs import random_agents
from tests.interpreter.made_up_meanings import meaning_made_up

MOST_JOINT = 20_000


def made_up(data, seed):
    """The meaning of a spec that is made up, a random design of it, and an episode of that."""
    meaning = meaning_made_up(data.draw(specs()), seed)
    problem = compile_meaning(meaning, compiled=False)
    agents = random_agents(problem, 1, seed)
    tables = tuple(pool[member] for pool, member in zip(agents.pools, agents.members[0], strict=True))
    design = Architecture(tables, agents.structures[0])
    return meaning, design, trace(problem, design, int(agents.keys[0]), 1)


def joint_cells(space, decisions):
    """The joint cell of each robot in each step, (n_dimensions, n_steps, n_robots)."""
    found = np.zeros((len(space.sizes), *decisions.controlling.shape), np.int64)
    for behavior, projection in enumerate(space.projections):
        inputs = (
            np.unravel_index(decisions.cells[..., behavior], projection.sizes) if projection.sizes else ()
        )
        for axis, cells in zip(projection.axes, inputs, strict=True):
            found[axis] = cells
        if projection.excitement is not None:
            is_excited = decisions.excited[..., behavior]
            found[projection.excitement] = is_excited if projection.excited_at else ~is_excited
    return found


def is_finite(traced):
    """Whether all numbers of an episode are: what is no number is in no cell that is said to be possible."""
    columns = [column for column in traced.values.values() if not isinstance(column[0], str)]
    return all(np.isfinite(column).all() for column in columns)


@pytest.mark.slow
@settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data(), seed=st.integers(0, 10**6))
def test_what_occurs_is_possible_and_explained(data, seed):
    meaning, design, traced = made_up(data, seed)
    space = joint_space(meaning)
    if space.joint_size > MOST_JOINT or not is_finite(traced):
        return
    visited = joint_cells(space, traced.decisions)
    assert possible_cells(meaning, space)[tuple(visited)].all()
    explanation = explain_architecture(meaning, design)
    by_name = {module.name: index for index, module in enumerate(meaning.episode.modules)}
    said = np.full(traced.decisions.controlling.shape, -1)
    for row in sorted(explanation.rows, key=lambda row: row.layer):
        behavior = by_name[row.behavior]
        inputs = dict(
            zip(meaning.episode.modules[behavior].inputs, space.projections[behavior].axes, strict=True)
        )
        holds = traced.decisions.excited[..., behavior].copy()
        for each in row.when:
            holds &= np.isin(visited[inputs[each.input]], each.cells)
        said[holds] = behavior
    if explanation.rows:
        assert np.array_equal(said, traced.decisions.controlling)
