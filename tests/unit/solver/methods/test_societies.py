from itertools import pairwise

import numpy as np

from bbsd.solver.arena import Arena
from bbsd.solver.methods import societies
from bbsd.solver.methods.societies import METHOD, N_SMALL
from tests.unit.solver.problems import guess


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


def test_small_societies_live_side_by_side_on_half_of_the_episodes_then_a_large_one(
    monkeypatch,
):
    monkeypatch.setattr(societies, "FEWEST_GENERATIONS", 2)
    budget = 20_000
    states = searched(budget)
    rounds = [moved(*pair) for pair in pairwise(states)]
    small, large = [True] * N_SMALL + [False], [False] * N_SMALL + [True]
    turn = rounds.index(large)
    assert rounds[:turn] == [small] * turn
    assert all(moves in (large, [False] * (N_SMALL + 1)) for moves in rounds[turn:])
    assert 0.5 <= states[turn].spent / budget < 0.6


def test_few_episodes_go_to_a_single_society():
    states = searched(3000)
    assert moved(states[0], states[-1]) == [True] + [False] * N_SMALL
    assert states[-1].champions.fitness[0] > 1.0


def test_a_ladder_that_is_spent_is_followed_by_one_of_other_societies():
    states = searched(3000, further=3000)
    end = next(index for index, state in enumerate(states) if state.spent >= 3000)
    after = states[end + 1]
    assert (after.begun, after.planned) == (states[end].spent, 3000)
    assert (after.large.pools != states[end].large.pools).any()
    assert states[-1].spent == 6000


def test_societies_of_a_ladder_are_all_different():
    small = searched(0)[0].small
    assert len({society.pools.tobytes() for society in small}) == N_SMALL
    assert len({np.concatenate(list(society.pools)).tobytes() for society in small}) == N_SMALL
