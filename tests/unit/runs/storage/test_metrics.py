import json

import numpy as np
import pytest

from bbsd.runs.storage.metrics import diversity, line
from bbsd.solver.paper.generation import Census, initial_state
from tests.unit.solver.problems import guess


def test_a_line_tells_of_the_generation():
    problem, settings = guess()
    state = initial_state(problem, settings, 1)
    census = Census(
        fitness=np.array([1.0, 4.0, 4.0]),
        lifetime_fitness=np.array([0.0, 1.0, 5.0]),
        structures=np.array([[0, 1, 2], [2, 0, 1], [1, 0, 2]]),
    )
    told = line(1, state, census, problem)
    assert (told["run"], told["generation"]) == (2, 0)
    assert (told["mean"], told["best"], told["lifetime"]) == (3, 4, 2)
    assert told["sd"] == pytest.approx(np.sqrt(3))
    assert told["structure"] == ["even", "odd", "reckless"]  # the first of the best's, highest layer first
    assert list(told["diversity"]) == ["odd", "even", "reckless"]
    assert told["diversity"]["reckless"] == 0
    assert json.loads(json.dumps(told)) == told


def test_one_agent_has_no_spread():
    problem, settings = guess()
    census = Census(np.array([1.0]), np.array([1.0]), np.array([[0, 1, 2]]))
    assert line(0, initial_state(problem, settings, 1), census, problem)["sd"] == 0


@pytest.mark.parametrize(
    ("pool", "expected"),
    [
        ([[1, 2], [1, 2]], 0),
        ([[0], [1]], 0.5),
        ([[0], [1], [2], [3]], 0.75),
        ([[0, 5], [1, 5]], 0.25),
        ([[255], [0]], 0.5),
    ],
)
def test_diversity_is_the_chance_that_a_cell_differs(pool, expected):
    assert diversity(np.array(pool, np.uint8)) == pytest.approx(expected)
