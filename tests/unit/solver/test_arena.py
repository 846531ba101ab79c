import numpy as np
import pytest

from bbsd.evaluation import RewardNotFinite
from bbsd.solver.arena import Arena, mark_asked
from bbsd.solver.changes import changes_of
from tests.unit.problems import RICH, problem_of
from tests.unit.solver.problems import guess

KEY = 3


@pytest.mark.parametrize(
    "problem",
    [problem_of(RICH), guess("structure: [odd, even, reckless]", lanes=7)[0]],
    ids=["rich", "guess"],
)
def test_an_episode_that_does_not_ask_a_cell_is_the_same_whatever_the_cell_says(problem):
    arena = Arena(problem, 1)
    design = arena.space.random(2, 1)
    changes = changes_of(arena.space, design)
    own, asked = arena.asked(design, KEY, 10, first=5)
    assert (own == arena.returns(design, KEY, 10, first=5)[0]).all()
    cell_changes = np.arange(len(changes.cells))
    returns = arena.returns(changes.applied(cell_changes), KEY, 10, first=5)
    matters = asked.T[changes.cells]
    assert (returns[~matters] == np.broadcast_to(own, returns.shape)[~matters]).all()
    assert (returns[matters] != np.broadcast_to(own, returns.shape)[matters]).any()
    assert 0 < matters.sum() < matters.size


def test_what_stands_below_the_behavior_that_acts_is_not_asked():
    arena = Arena(guess()[0], 1)
    odd, even = 0, 1
    # Odd acts in every cell, and stands on top; then below, where even acts in all but one.
    design = arena.space.random(1, 1)
    design.tables[0] = [1, 1, 1, 1, 0, 1, 1, 1, 0]
    for order, behaviors in (([2, even, odd], {odd}), ([2, odd, even], {odd, even})):
        design.structures[0] = order
        _, asked = arena.asked(design, KEY, 60)
        assert set(arena.space.behavior_of[asked.any(axis=0)]) == behaviors
    assert np.flatnonzero(asked.any(axis=0)).tolist() == [0, 4, 5, 6, 7]


def test_pairs_of_a_design_and_an_episode_run_as_they_would_together():
    arena = Arena(guess(lanes=7)[0], 1)
    designs = arena.space.random(2, 5)
    returns = arena.returns(designs, KEY, 12)
    rows, episodes = np.array([4, 0, 0, 3]), np.array([11, 2, 3, 9])
    assert (arena.paired_returns(designs, rows, KEY, episodes) == returns[rows, episodes]).all()
    assert arena.paired_returns(designs, rows[:0], KEY, episodes[:0]).shape == (0,)


def test_returns_that_are_not_finite_are_a_mistake_of_the_spec():
    text = """
bbsd: 1
name: hole
environment: {steps: 1, state: {x: 0}}
behaviors: {go: {actions: {leave: {x: 1}}}}
reward: {gain: 1 / x}
"""
    arena = Arena(problem_of(text), 1)
    design = arena.space.random(1, 1)
    design.tables[0] = 0
    with pytest.raises(RewardNotFinite):
        arena.asked(design, KEY, 3)


def test_steps_after_the_end_and_behaviors_not_asked_mark_nothing():
    codes = np.array([[2 * 1 + 1, -1], [2 * 3, 2 * 0], [2 * 2, 2 * 2]]).reshape(3, 1, 1, 2)
    marks = np.zeros((2, 2), np.bool_)
    mark_asked(codes, np.array([1.0, 2.0]), np.array([0, 0, 1, 1]), marks)
    assert marks.tolist() == [[True, False], [True, False]]
