"""A search spends its part of a budget in rounds, and its race never more than what is left."""

from dataclasses import replace

import numpy as np
import pytest

from bbsd.solver.arena import Arena
from bbsd.solver.champions import no_champions
from bbsd.solver.methods import random_search
from bbsd.solver.methods.method import SearchState, with_champions
from bbsd.solver.search import final_race, rounds, search_budget
from tests.unit.solver.problems import guess


@pytest.fixture(scope="module")
def arena():
    return Arena(guess()[0], 1)


def test_four_fifths_of_a_budget_are_the_search_s():
    assert [search_budget(budget) for budget in (10, 1000, 300_000)] == [8, 800, 240_000]


def test_rounds_end_when_the_search_s_part_is_spent(arena):
    method = random_search.METHOD
    states = list(rounds(method, method.begin(arena, 1, 4000), arena, 1, 5000))
    assert states[-1].spent == 4000
    assert all(state.spent < 4000 for state in states[:-1])


def with_designs(arena, numbers, fitness):
    """A state whose champions are random designs, with the fitness that a search believes."""
    state = SearchState(champions=no_champions(arena.problem, 50))
    for number, value in zip(numbers, fitness, strict=True):
        champions = with_champions(state.champions, arena.space.random(number, 1), np.array([value]))
        state = replace(state, champions=champions)
    return state


@pytest.mark.parametrize("episodes", [3000, 10_000])
def test_a_race_finds_the_best_whatever_was_believed_of_it_and_keeps_to_its_episodes(arena, episodes):
    means = [arena.means(arena.space.random(number, 1), 5, 2000)[0] for number in range(3)]
    best = int(np.argmax(means))
    state = with_designs(arena, range(3), [-mean for mean in means])
    answer = final_race(state, arena, 1, episodes)
    assert 0 < answer.spent <= episodes
    assert answer.mean == pytest.approx(means[best], abs=0.15)
    assert arena.means(answer.design, 5, 2000)[0] == means[best]
