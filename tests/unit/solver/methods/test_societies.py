from itertools import pairwise

import numpy as np

from bbsd.solver.arena import Arena
from bbsd.solver.methods import societies
from bbsd.solver.methods.nomination import nominated_means
from bbsd.solver.methods.societies import LARGE, METHOD, SMALL, ladder, successor
from tests.unit.solver.problems import guess

N_SMALL = societies.MOST_SMALL


def searched(budget, further=0):
    arena = Arena(guess()[0], 1)
    states = [METHOD.begin(arena, 1, budget)]
    while states[-1].spent < budget:
        states.append(METHOD.advance(states[-1], arena, 1, budget))
    while states[-1].spent < budget + further:
        states.append(METHOD.advance(states[-1], arena, 1, budget + further))
    return states


def moved(before, after):
    """Which societies had a generation, the small ones first, then the large one."""
    pairs = zip((*before.small, before.large), (*after.small, after.large), strict=True)
    return [one is not other for one, other in pairs]


def test_small_societies_live_side_by_side_on_half_of_the_episodes_then_a_larger_one(monkeypatch):
    monkeypatch.setattr(societies, "FEWEST_GENERATIONS", 2)
    budget = 20_000
    states = searched(budget)
    rounds = [moved(*pair) for pair in pairwise(states)]
    small, large = [True] * N_SMALL + [False], [False] * N_SMALL + [True]
    turn = rounds.index(large)
    assert rounds[:turn] == [small] * turn
    assert all(moves in (large, [False] * (N_SMALL + 1)) for moves in rounds[turn:])
    assert 0.5 <= states[turn].spent / budget < 0.6
    assert len(states[-1].large.pools) == LARGE.population


def test_the_larger_society_continues_with_what_the_small_ones_found(monkeypatch):
    monkeypatch.setattr(societies, "FEWEST_GENERATIONS", 2)
    states = searched(20_000)
    before = next(state for state, after in pairwise(states) if after.succeeded)
    large = successor(before, before.small, 20)
    for index, society in enumerate(before.small):
        np.testing.assert_array_equal(large.pools[5 * index : 5 * index + 5], society.pools[:5])
    leaders = [society.leader for society in before.small]
    means = np.concatenate([nominated_means(before, leader) for leader in leaders])
    np.testing.assert_array_equal(large.leader.tables, leaders[int(np.argmax(means))].tables)
    assert len(large.culture)


def test_few_episodes_go_to_one_small_society_and_its_successor_is_as_small():
    states = searched(3000)
    assert moved(states[0], states[-1])[:-1] == [True] + [False] * (N_SMALL - 1)
    assert len(states[-1].large.pools) == SMALL.population
    assert states[-1].champions.fitness[0] > 1.0


def test_a_ladder_that_is_spent_is_followed_by_one_of_other_societies():
    states = searched(3000, further=3000)
    end = next(index for index, state in enumerate(states) if state.spent >= 3000)
    after = states[end + 1]
    assert (after.begun, after.planned, after.succeeded) == (states[end].spent, 3000, False)
    assert (after.small[0].pools != states[end].small[0].pools).any()
    assert states[-1].spent == 6000


def test_many_episodes_are_several_ladders_of_equal_length():
    assert [ladder(episodes) for episodes in (0, 7, 300_000, 300_001, 1_040_000)] == [
        1,
        7,
        300_000,
        150_000,
        260_000,
    ]


def test_small_societies_of_a_ladder_are_all_different(monkeypatch):
    monkeypatch.setattr(societies, "FEWEST_GENERATIONS", 2)
    small = searched(20_000)[1].small
    assert len({society.pools.tobytes() for society in small}) == N_SMALL
