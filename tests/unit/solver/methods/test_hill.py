from itertools import pairwise

import numpy as np
import pytest

from bbsd.solver.arena import Arena
from bbsd.solver.methods.hill import METHOD
from bbsd.solver.methods.method import arrays_of, restored
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess

KEY = 5


def states(arena, budget, key=KEY):
    """The states of a search, the first included."""
    states = [METHOD.begin(arena, key, budget)]
    while states[-1].spent < budget:
        states.append(METHOD.advance(states[-1], arena, key, budget))
    return states


def arena(lanes=None, structure=""):
    return Arena(guess(structure, lanes=lanes)[0], 1)


def test_every_cell_that_matters_is_found():
    # Right in both steps wherever it is: the most that there is.
    *_, end = states(arena(), 10_000)
    assert end.champions.fitness[0] == 2


def test_climbs_begin_anew_after_an_optimum():
    searched = states(arena(), 10_000)
    assert searched[-1].starts > 2
    for before, after in pairwise(searched):
        assert (after.starts > before.starts) == before.climb.at_optimum


def test_an_optimum_becomes_a_champion_with_its_mean():
    optima = [state for state in states(arena(), 10_000) if state.climb.at_optimum and state.starts]
    for state in optima:
        rows = (state.champions.tables == state.climb.design.tables).all(axis=1)
        rows &= (state.champions.structures == state.climb.design.structures).all(axis=1)
        assert state.champions.fitness[rows].max() >= state.climb.mean


@pytest.mark.parametrize("budget", [1, 2, 7, 60, 999, 5000])
def test_rounds_spend_something_and_together_the_budget(budget):
    spent = [state.spent for state in states(arena(), budget)]
    assert spent[-1] == budget
    assert (np.diff(spent) > 0).all()


def test_where_nothing_is_open_episodes_are_spent_all_the_same():
    text = """
bbsd: 1
name: settled
environment: {steps: 1, state: {bet: 0}}
behaviors: {one: {actions: {a: {bet: 1}}, rules: [otherwise: a]}}
reward: {gain: bet}
"""
    assert states(Arena(problem_of(text), 1), 50)[-1].spent == 50


def test_a_search_that_was_written_down_goes_on_equally():
    whole = states(arena(), 5000)
    half = whole[len(whole) // 2]
    again = restored(METHOD.begin(arena(), KEY, 5000), arrays_of(half))
    while again.spent < 5000:
        again = METHOD.advance(again, arena(), KEY, 5000)
    assert str(arrays_of(again)) == str(arrays_of(whole[-1]))


def test_lanes_change_nothing_and_keys_do():
    ends = [
        str(arrays_of(states(arena(lanes), 3000, key)[-1])) for lanes, key in ((1, KEY), (64, KEY), (64, 6))
    ]
    assert ends[0] == ends[1] != ends[2]
