from dataclasses import replace

import numpy as np

from bbsd.architecture import Architecture
from bbsd.solver.answer import answer, candidates, distinct
from bbsd.solver.paper.culture import Culture
from bbsd.solver.paper.generation import initial_state
from tests.unit.solver.problems import guess

BEST = (np.array([1, 1, 2, 2], np.uint8), np.array([1, 2, 2, 2], np.uint8), np.array([1], np.uint8))
"""Right in all four cells, if the first behavior decides in the odd ones only."""

RIGHT = (np.array([0, 1, 0, 2], np.uint8), np.array([1, 0, 2, 0], np.uint8), np.array([1], np.uint8))
IDLE = (np.zeros(4, np.uint8), np.array([0, 0, 2, 0], np.uint8), np.array([1], np.uint8))


def state_with(memes, meme_fitness, champions=()):
    """A state whose second individuals are the best ones, with a culture, and champions by tables and structure."""
    problem, settings = guess()
    state = initial_state(problem, settings, 1)
    pools = (np.stack([IDLE[0], RIGHT[0]]), np.stack([IDLE[1], RIGHT[1]]), np.array([[1]], np.uint8))
    fitness = np.array([[0.0, 1, -np.inf], [0, 1, -np.inf], [0, 9, 9]])
    culture = Culture(np.array(memes, np.int64).reshape(-1, 3), np.array(meme_fitness, np.float64))
    kept = replace(
        state.champions,
        tables=np.array([np.concatenate(tables) for tables, _ in champions], np.uint8).reshape(-1, 9),
        structures=np.array([structure for _, structure in champions], np.int64).reshape(-1, 3),
        fitness=np.zeros(len(champions)),
    )
    return replace(state, pools=pools, fitness=fitness, culture=culture, champions=kept), problem, settings


def structures(architectures):
    return [architecture.structure.tolist() for architecture in architectures]


def test_the_best_individuals_enter_under_every_meme_the_fittest_first():
    found = candidates(*state_with([[0, 1, 2], [2, 1, 0]], [1, 5]))
    assert structures(found) == [[2, 1, 0], [0, 1, 2]]
    for table, expected in zip(found[0].tables, RIGHT, strict=True):
        np.testing.assert_array_equal(table, expected)


def test_champions_enter_after_them():
    found = candidates(*state_with([[2, 1, 0]], [1], [(IDLE, [2, 0, 1]), (BEST, [2, 0, 1])]))
    assert structures(found) == [[2, 1, 0], [2, 0, 1], [2, 0, 1]]


def test_those_that_behave_alike_enter_once():
    # Where the reckless one stands on top, what lies below makes no difference.
    found = candidates(*state_with([[0, 1, 2], [1, 0, 2]], [1, 5], [(BEST, [0, 1, 2])]))
    assert structures(found) == [[1, 0, 2]]


def test_there_are_no_more_than_the_spec_says():
    state, problem, settings = state_with([[0, 1, 2], [2, 1, 0]], [1, 5])
    few = replace(settings, answer=settings.answer.model_copy(update={"candidates": 1}))
    assert structures(candidates(state, problem, few)) == [[2, 1, 0]]


def test_without_a_culture_only_champions_enter():
    found = candidates(*state_with([], [], [(RIGHT, [2, 1, 0])]))
    assert structures(found) == [[2, 1, 0]]


def test_of_designs_that_behave_alike_the_first_is_kept():
    problem, _ = guess()
    reckless = [Architecture(tables, np.array([0, 1, 2])) for tables in (RIGHT, IDLE, BEST)]
    [only] = distinct(reckless, problem)
    assert only is reckless[0]


def test_the_answer_is_the_best_candidate():
    state, problem, settings = state_with([[0, 1, 2], [2, 1, 0]], [5, 1], [(IDLE, [2, 0, 1])])
    assert answer(state, problem, settings, 1).structure.tolist() == [2, 1, 0]
