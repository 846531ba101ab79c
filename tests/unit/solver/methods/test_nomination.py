import numpy as np

from bbsd.solver.arena import Arena
from bbsd.solver.champions import no_champions
from bbsd.solver.methods.method import SearchState
from bbsd.solver.methods.nomination import (
    CAPACITY,
    EPISODES,
    NOMINATION,
    nominated,
    nominated_means,
    with_rest_spent,
)
from bbsd.solver.space import fold
from tests.unit.solver.problems import guess

KEY = 5


def nothing_yet():
    arena = Arena(guess()[0], 1)
    return SearchState(champions=no_champions(arena.problem, CAPACITY)), arena


def test_nominated_designs_are_ranked_by_common_episodes():
    state, arena = nothing_yet()
    designs = arena.space.random(1, 8)
    means = arena.means(designs, fold(KEY, NOMINATION), EPISODES)
    state = nominated(state, arena, KEY, designs, 1000)
    assert state.spent == 8 * EPISODES
    order = np.argsort(-means, kind="stable")
    np.testing.assert_array_equal(state.champions.fitness, means[order])
    np.testing.assert_array_equal(state.champions.tables, designs.tables[order])


def test_a_champion_is_not_measured_again_nor_a_design_twice():
    state, arena = nothing_yet()
    designs = arena.space.random(1, 4)
    state = nominated(state, arena, KEY, designs[:2].joined(designs[:1]), 1000)
    assert state.spent == 2 * EPISODES
    state = nominated(state, arena, KEY, designs, 1000)
    assert state.spent == 4 * EPISODES
    assert nominated(state, arena, KEY, designs, 1000) is state


def test_the_first_are_nominated_when_few_episodes_are_left():
    state, arena = nothing_yet()
    designs = arena.space.random(1, 4)
    state = nominated(state, arena, KEY, designs, 3 * EPISODES - 1)
    assert state.spent == 2 * EPISODES
    assert {row.tobytes() for row in state.champions.tables} == {row.tobytes() for row in designs.tables[:2]}


def test_means_of_champions_are_known_and_those_of_others_are_not():
    state, arena = nothing_yet()
    designs = arena.space.random(1, 4)
    assert (nominated_means(state, designs) == -np.inf).all()
    state = nominated(state, arena, KEY, designs[:3], 1000)
    means = arena.means(designs, fold(KEY, NOMINATION), EPISODES)
    np.testing.assert_array_equal(nominated_means(state, designs), [*means[:3], -np.inf])


def test_a_rest_that_is_too_short_to_compare_changes_no_champions():
    state, arena = nothing_yet()
    state = with_rest_spent(state, arena, KEY, EPISODES - 1)
    assert (state.spent, len(state.champions.tables)) == (EPISODES - 1, 1)
    after = with_rest_spent(state, arena, KEY, 3)
    assert after.spent == EPISODES + 2
    np.testing.assert_array_equal(after.champions.tables, state.champions.tables)


def test_a_rest_goes_to_designs_near_the_best_champion():
    state, arena = nothing_yet()
    state = nominated(state, arena, KEY, arena.space.random(1, 4), 1000)
    best = state.champions.tables[0]
    after = with_rest_spent(state, arena, KEY, 40 * EPISODES)
    new = [row for row in after.champions.tables if not (row == state.champions.tables).all(axis=1).any()]
    assert after.spent == state.spent + 40 * EPISODES
    assert new
    assert np.mean([(row != best).sum() for row in new]) < 3
