import numpy as np

from bbsd.solver.arena import Arena
from bbsd.solver.methods import founding
from bbsd.solver.methods.founding import best_random
from tests.unit.solver.problems import guess


def test_the_best_are_kept_the_best_first_with_what_they_earned():
    arena = Arena(guess()[0], 1)
    best, fitness = best_random(arena, 3, 100, 8, 5)
    everyone, values = best_random(arena, 3, 100, 8, 100)
    np.testing.assert_array_equal(values, np.sort(values)[::-1])
    np.testing.assert_array_equal(fitness, values[:5])
    np.testing.assert_array_equal(best.tables, everyone.tables[:5])
    many = arena.means(best, 1, 400)
    np.testing.assert_allclose(many, fitness, atol=0.8)


def test_few_designs_are_in_memory_at_a_time(monkeypatch):
    sizes, returns = [], Arena.returns

    def spied(self, designs, key, count, first=0):
        sizes.append(len(designs))
        return returns(self, designs, key, count, first)

    arena = Arena(guess()[0], 1)
    monkeypatch.setattr(Arena, "returns", spied)
    monkeypatch.setattr(founding, "CHUNK", 30 * len(arena.space.given))
    best, fitness = best_random(arena, 3, 100, 4, 50)
    assert sizes == [30, 30, 30, 10]
    assert len(best.distinct()) > 45  # other ones in each chunk
    assert (np.diff(fitness) <= 0).all()
