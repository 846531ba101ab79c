"""A portfolio: openings, further runs of the one that leads, breeding of what all found, and climbs of the best."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from bbsd.solver.arena import Arena
from bbsd.solver.champions import no_champions
from bbsd.solver.methods import auto
from bbsd.solver.methods.auto import METHOD
from bbsd.solver.methods.method import Method, SearchState, arrays_of, restored, with_champions
from tests.unit.solver.problems import guess

BUDGET = 20_000


@pytest.fixture(scope="module")
def arena():
    return Arena(guess()[0], 1)


def searched(arena, budget=BUDGET, key=1):
    states = [METHOD.begin(arena, key, budget)]
    while states[-1].spent < budget:
        states.append(METHOD.advance(states[-1], arena, key, budget))
    return states


def turns(states):
    """Whose turn it was, one after another, each once in a row."""
    order = [state.turn for state in states]
    return [turn for index, turn in enumerate(order) if index == 0 or turn != order[index - 1]]


def finding(name, quality, arena):
    """A search that spends 100 episodes a round and always has the same design, one of those that differ in quality."""
    designs = arena.space.random(quality, 1)

    def begin(_arena, _key, _budget):
        return SearchState(champions=no_champions(arena.problem, 5))

    def advance(state, _arena, _key, budget):
        spent = min(100, budget - state.spent)
        champions = with_champions(state.champions, designs, np.zeros(1))
        return replace(state, spent=state.spent + spent, champions=champions)

    return Method(name, begin, advance)


def in_order_of_quality(arena):
    """Two numbers of random designs, of which the second one's earns more."""
    means = [arena.means(arena.space.random(number, 1), 5, 200)[0] for number in range(12)]
    return int(np.argmin(means)), int(np.argmax(means))


def with_openings(monkeypatch, *searches):
    monkeypatch.setattr(auto, "FEW_OPENINGS", tuple((search, 0.1) for search in searches))


def test_all_searches_have_their_opening_then_their_designs_are_bred_and_then_climb(arena, monkeypatch):
    worse, better = in_order_of_quality(arena)
    with_openings(monkeypatch, finding("worse", worse, arena), finding("better", better, arena))
    states = searched(arena)
    assert turns(states)[:4] == [0, 1, 2, 3]
    assert states[-1].runs[:2].tolist() == [1, 1] or states[-1].runs[1] > 1
    assert states[-1].runs[2] == 1


@pytest.mark.parametrize("leads", [0, 1])
def test_a_large_budget_has_further_runs_of_the_search_that_leads_before_breeding(arena, monkeypatch, leads):
    worse, better = in_order_of_quality(arena)
    searches = [finding("worse", worse, arena), finding("better", better, arena)]
    with_openings(monkeypatch, *(searches[::-1] if leads == 0 else searches))
    monkeypatch.setattr(auto, "MOST_BRED", 3000)
    states = searched(arena)
    bred = next(state for state in states if state.turn == 2)
    assert bred.runs[leads] > 1 == bred.runs[1 - leads]
    assert bred.spent >= auto.FEW_BRED_UNTIL * BUDGET - 3000


def test_breeding_begins_with_the_best_designs_of_each_search(arena, monkeypatch):
    worse, better = in_order_of_quality(arena)
    with_openings(monkeypatch, finding("worse", worse, arena), finding("better", better, arena))
    bred = next(state for state in searched(arena) if state.turn == 2)
    population = bred.searches[2].population
    for place, number in enumerate((worse, better)):
        assert (population.tables[place] == arena.space.random(number, 1).tables[0]).all()
    assert len(population) >= 40


def test_q_learning_goes_on_with_what_it_learned_where_it_leads(arena, monkeypatch):
    worse, better = in_order_of_quality(arena)
    learning = finding("q", better, arena)
    monkeypatch.setattr(auto.q_learning, "METHOD", learning)
    with_openings(monkeypatch, finding("other", worse, arena), learning)
    bred = next(state for state in searched(arena) if state.turn == 2)
    assert bred.runs.tolist() == [1, 2, 0]
    assert bred.searches[1].spent == 0.1 * BUDGET + auto.FEW_LEARNED_SHARE * BUDGET


def test_a_climb_ends_where_no_single_change_helps_and_is_a_champion(arena):
    last = searched(arena)[-1]
    assert last.climbs or last.runs.sum() > len(last.searches)
    champions = {table.tobytes() for table in last.champions.tables}
    assert any(table.tobytes() in champions for table in last.tried_tables)


@pytest.mark.parametrize("budget", [1, 60, 999, 3000, BUDGET])
def test_a_budget_is_spent_and_never_more(arena, budget):
    spent = [state.spent for state in searched(arena, budget)]
    assert spent[-1] == budget
    assert all(before < after for before, after in pairwise(spent))


def test_a_restored_search_goes_on_as_it_would_have(arena):
    states = searched(arena)
    template = METHOD.begin(arena, 1, BUDGET)
    for state in states[:: max(1, len(states) // 7)]:
        if state.spent < BUDGET:
            again = METHOD.advance(restored(template, arrays_of(state)), arena, 1, BUDGET)
            after = METHOD.advance(state, arena, 1, BUDGET)
            assert all(
                (arrays_of(again)[name] == array).all()
                for name, array in arrays_of(after).items()
                if array.dtype != float
            )
            assert again.spent == after.spent


def test_more_episodes_after_the_end_go_on(arena):
    state = searched(arena)[-1]
    while state.spent < BUDGET + 5000:
        state = METHOD.advance(state, arena, 1, BUDGET + 5000)
    assert state.spent == BUDGET + 5000


@pytest.mark.parametrize(("practice_leads", "q_runs"), [(True, 1), (False, 0)])
def test_q_learning_begins_only_where_practice_does_not_trail(arena, monkeypatch, practice_leads, q_runs):
    worse, better = in_order_of_quality(arena)
    other = finding("other", worse if practice_leads else better, arena)
    practicing = finding("practice", better if practice_leads else worse, arena)
    learning = finding("q", worse, arena)
    monkeypatch.setattr(auto.practice, "METHOD", practicing)
    monkeypatch.setattr(auto.q_learning, "METHOD", learning)
    with_openings(monkeypatch, other, practicing, learning)
    assert searched(arena)[-1].runs[2] == q_runs
