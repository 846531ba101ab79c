"""A portfolio: openings, further runs of the one that leads, and climbs of the best designs."""

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


def test_all_searches_have_their_opening_then_the_leader_goes_on_and_then_designs_climb(arena, monkeypatch):
    worse, better = in_order_of_quality(arena)
    openings = ((finding("worse", worse, arena), 0.1), (finding("better", better, arena), 0.1))
    monkeypatch.setattr(auto, "FEW_OPENINGS", openings)
    states = searched(arena)
    assert turns(states)[:3] == [0, 1, 2]
    runs = states[-1].runs
    assert runs[0] == 1
    assert runs[1] > 1


def test_the_leader_need_not_have_come_last(arena, monkeypatch):
    worse, better = in_order_of_quality(arena)
    openings = ((finding("better", better, arena), 0.1), (finding("worse", worse, arena), 0.1))
    monkeypatch.setattr(auto, "FEW_OPENINGS", openings)
    states = searched(arena)
    assert turns(states)[:3] == [0, 1, 0]
    assert states[-1].runs[0] > 1 == states[-1].runs[1]


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
    monkeypatch.setattr(auto, "FEW_OPENINGS", ((other, 0.1), (practicing, 0.1), (learning, 0.1)))
    assert searched(arena)[-1].runs[2] == q_runs
