import numpy as np

from bbsd.solver.arena import Arena
from bbsd.solver.methods import cross_entropy
from bbsd.solver.methods.cross_entropy import METHOD, fitness_of_drawn
from bbsd.solver.methods.distribution import uniform_distribution
from tests.unit.solver.problems import guess


def arena():
    return Arena(guess()[0], 1)


def test_designs_in_chunks_earn_the_same(monkeypatch):
    place = arena()
    whole = fitness_of_drawn(uniform_distribution(place.space), place, 4, 50)
    monkeypatch.setattr(cross_entropy, "CHUNK", 7 * len(place.space.given))
    np.testing.assert_array_equal(fitness_of_drawn(uniform_distribution(place.space), place, 4, 50), whole)


def test_memory_does_not_hold_all_designs_of_a_round(monkeypatch):
    sizes, returns = [], Arena.returns

    def spied(self, designs, key, count, first=0):
        sizes.append(len(designs))
        return returns(self, designs, key, count, first)

    place = arena()
    monkeypatch.setattr(Arena, "returns", spied)
    monkeypatch.setattr(cross_entropy, "CHUNK", 20 * len(place.space.given))
    METHOD.advance(METHOD.begin(place, 1, 25_000), place, 1, 25_000)
    assert max(sizes) == 20
    assert sum(sizes) >= 100


def test_the_distribution_settles_on_the_best_design_and_begins_anew_in_time(monkeypatch):
    monkeypatch.setattr(cross_entropy, "LONGEST", 15)
    place, budget = arena(), 20_000
    state = METHOD.begin(place, 3, budget)
    for _ in range(15):
        state = METHOD.advance(state, place, 3, budget)
    best = state.distribution.most_probable(place.space)
    assert place.means(best, 1, 100)[0] == 2.0
    settled = state.distribution.layers.max()
    assert settled > 0.9
    assert METHOD.advance(state, place, 3, budget).distribution.layers.max() < 0.6
