import numpy as np
import pytest

from bbsd.architecture import given_architecture
from bbsd.evaluation import trace
from bbsd.solver.random_agents import random_agents
from tests.unit.evaluation.tracing.test_tracing import WALK
from tests.unit.problems import RICH, problem_of


def test_decisions_of_an_example_worked_by_hand():
    problem = problem_of(WALK)
    found = trace(problem, given_architecture(problem), 1, 1).decisions
    go, never = 0, 1
    assert found.excited[:, :, go].all()
    assert not found.excited[:, :, never].any()
    assert found.cells[:, :, go].tolist() == [[0, 1]] * 3
    assert found.wishes[:, :, go].tolist() == [[1, 2]] * 3
    assert found.wishes[:, :, never].tolist() == [[1, 1]] * 3
    assert found.controlling.tolist() == [[go, go]] * 3


@pytest.mark.parametrize("agent", range(6))
def test_the_highest_excited_layer_with_a_wish_controls(agent):
    problem = problem_of(RICH)
    architecture = random_agents(problem, 3, 6).architecture(agent)
    traced = trace(problem, architecture, 7 + agent, 1)
    found, structure = traced.decisions, architecture.structure.tolist()
    names = [*problem.names, "nobody"]
    for step, robot in np.ndindex(found.controlling.shape):
        activated = [
            behavior for behavior in reversed(structure)
            if found.excited[step, robot, behavior] and found.wishes[step, robot, behavior]
        ]  # fmt: skip
        assert found.controlling[step, robot] == (activated[0] if activated else -1)
        assert traced.controlling[robot][step] == names[found.controlling[step, robot]]
    for behavior, table in enumerate(architecture.tables):
        assert (found.wishes[..., behavior] == table[found.cells[..., behavior]]).all()
    assert found.excited.shape == found.cells.shape == (len(traced.steps), 3, 3)


def test_cells_are_those_of_what_was_stored_before_the_step():
    """The table of `fall` is too large for a word; its cells are computed here from what the step before stored."""
    problem = problem_of(RICH)
    traced = trace(problem, random_agents(problem, 3, 1).architecture(0), 7, 1)
    values = {(slot.name, slot.robot): column for slot, column in traced.values.items() if not slot.place}
    for robot in range(3):
        x, n = np.array(values["x", robot]), np.array(values["n", robot])
        place = np.array([["front", "back"].index(label) for label in values["place", robot]])
        where = np.searchsorted([-2, -1, 0, 1, 2], x, side="right")
        cells = (np.clip(n, 0, 5).astype(int) * 6 + where) * 2 + place
        assert traced.decisions.cells[1:, robot, 1].tolist() == cells[:-1].tolist()
        assert traced.decisions.excited[1:, robot, 1].tolist() == [
            bool(v) for v in values["armed", robot][:-1]
        ]
