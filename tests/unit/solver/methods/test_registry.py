"""What every method keeps to, whatever it does."""

from itertools import pairwise

import numpy as np
import pytest

from bbsd.compiler import Team
from bbsd.kernel.streams import fold, word_of
from bbsd.language.meaning.tables.table import OPEN_CELL
from bbsd.solver.arena import Arena
from bbsd.solver.methods.method import arrays_of, restored
from bbsd.solver.methods.registry import METHODS
from bbsd.solver.structures import OPEN
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess

pytestmark = pytest.mark.slow

RULES_ONLY = """
bbsd: 1
name: rules only
environment: {steps: 2, state: {x: 0}}
behaviors:
  down: {actions: {sink: {x: -1}}, rules: [otherwise: sink]}
  up: {actions: {climb: {x: 1}}, rules: [otherwise: climb]}
reward: {height: x}
"""
GIVEN_ORDER = "structure: [odd, even, reckless]"
SOME_GIVEN = "structure: [open, even, open]"


@pytest.fixture(params=sorted(METHODS))
def method(request):
    return METHODS[request.param]


def arena(structure="", lanes=None):
    return Arena(guess(structure, lanes=lanes)[0], 1)


def searched(method, arena, budget, key=7):
    """The states from the first to the one that has spent the budget."""
    states = [method.begin(arena, key, budget)]
    while states[-1].spent < budget:
        states.append(method.advance(states[-1], arena, key, budget))
    return states


def champions_of(state):
    found = state.champions
    return found.tables.tobytes(), found.structures.tobytes(), found.fitness.tobytes()


def test_names_are_those_of_the_methods():
    assert all(name == method.name for name, method in METHODS.items())


@pytest.mark.parametrize("budget", [1, 7, 49, 611, 3000])
def test_a_search_spends_its_budget_to_the_last_episode_and_counts_them(method, budget, monkeypatch):
    run = []
    episode, practice = Team.episode, Team.practice

    def counted_episode(self, *arguments):
        run.append(self.size)
        return episode(self, *arguments)

    def counted_practice(self, *arguments):
        run.append(self.size)
        return practice(self, *arguments)

    monkeypatch.setattr(Team, "episode", counted_episode)
    monkeypatch.setattr(Team, "practice", counted_practice)
    states = searched(method, arena(), budget)
    assert states[0].spent == 0
    assert states[-1].spent == sum(run) == budget
    assert all(before.spent < after.spent for before, after in pairwise(states))
    assert len(states[-1].champions.tables) > 0


def test_a_round_is_a_small_part_of_the_budget(method):
    place, budget = arena(), 100_000
    state = method.begin(place, 7, budget)
    for number in range(4):
        before, state = state, method.advance(state, place, 7, budget)
        assert state.spent - before.spent <= budget * (
            0.06 if number else 0.11
        )  # the first may found a population


def test_a_state_written_down_continues_as_if_it_had_not_been(method):
    place, budget = arena(), 4000
    states = searched(method, place, budget)
    template = method.begin(place, 7, budget)
    for state in states:
        again = restored(template, {name: array.copy() for name, array in arrays_of(state).items()})
        assert champions_of(again) == champions_of(state)
        if again.spent < budget:
            continued = arrays_of(method.advance(again, place, 7, budget))
            direct = arrays_of(method.advance(state, place, 7, budget))
            assert {name: array.tobytes() for name, array in continued.items()} == {
                name: array.tobytes() for name, array in direct.items()
            }


def test_a_search_goes_on_when_its_budget_grows(method):
    place = arena()
    state = searched(method, place, 1500)[-1]
    while state.spent < 4000:
        after = method.advance(state, place, 7, 4000)
        assert state.spent < after.spent <= 4000
        state = after
    assert state.champions.fitness[0] == 2.0


def test_a_search_does_not_depend_on_lanes(method):
    alone, many = (searched(method, arena(lanes=lanes), 1200)[-1] for lanes in (1, 16))
    assert champions_of(alone) == champions_of(many)


def test_searches_with_other_keys_differ(method):
    one, other = (searched(method, arena(), 300, key=key)[-1] for key in (1, 2))
    assert champions_of(one) != champions_of(other)


@pytest.mark.parametrize("structure", ["", GIVEN_ORDER, SOME_GIVEN])
def test_given_cells_and_layers_stay_and_structures_are_possible(method, structure):
    place = arena(structure)
    state, problem = searched(method, place, 1200)[-1], place.problem
    given, layers = place.space.given, problem.layers
    fixed = given != OPEN_CELL
    assert (state.champions.tables[:, fixed] == given[fixed]).all()
    assert (state.champions.tables < place.space.choices).all()
    assert (state.champions.structures[:, layers != OPEN] == layers[layers != OPEN]).all()
    for order in state.champions.structures[:, layers == OPEN]:
        assert len(set(order)) == len(order)
        assert set(order) <= set(problem.candidates)


def test_only_the_order_is_searched_where_no_cell_is_open(method):
    place = Arena(problem_of(RULES_ONLY), 1)
    assert not len(place.space.open_cells)
    state = searched(method, place, 700)[-1]
    assert state.champions.structures[0].tolist() == [0, 1]
    assert state.champions.fitness[0] == 2.0


def test_the_best_design_is_found_and_named_first(method):
    """Right in both steps: 2; one design in 450 is that good."""
    state = searched(method, arena(), 6000)[-1]
    assert state.champions.fitness[0] == 2.0
    assert (np.diff(state.champions.fitness) <= 0).all()


def test_champions_are_designs_that_earn_what_is_said_of_them(method):
    """Fitness is a mean of few episodes, so it is near that of many."""
    place = arena()
    state = searched(method, place, 6000)[-1]
    best = place.space.designs(state.champions.architectures(place.problem)[:1])
    many = place.means(best, fold(99, word_of(1)), 400)
    assert abs(many[0] - state.champions.fitness[0]) < 0.5
