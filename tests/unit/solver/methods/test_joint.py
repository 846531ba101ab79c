import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.solver.arena import Arena
from bbsd.solver.methods import joint
from bbsd.solver.methods.joint import METHOD, crossed_orders, next_population
from bbsd.solver.space import Space
from tests.unit.solver.problems import guess

FEWER_LAYERS = Space(guess("structure: [open, open]")[0])


@pytest.fixture(scope="module")
def space():
    return Space(guess()[0])


@given(st.integers(0, 2**64 - 1), st.integers(0, 2**32))
def test_children_of_orders_are_orders(key, seed):
    first, second = FEWER_LAYERS.random_orders(seed, 20), FEWER_LAYERS.random_orders(seed + 1, 20)
    for child in crossed_orders(key, FEWER_LAYERS, first, second):
        assert len(set(child)) == len(child)


def test_an_order_crossed_with_itself_stays(space):
    orders = space.random_orders(1, 50)
    np.testing.assert_array_equal(crossed_orders(3, space, orders, orders), orders)


def test_children_have_layers_of_the_first_and_the_sequence_of_the_second(space):
    """[0, 1, 2] and [2, 1, 0]: keeping nothing of the first, or one layer, reads the second backwards around it."""
    first, second = np.tile([0, 1, 2], (900, 1)), np.tile([2, 1, 0], (900, 1))
    children, counts = np.unique(crossed_orders(3, space, first, second), axis=0, return_counts=True)
    # none kept: 210; 0: 021; 1: 210; 2: 102; two or all: 012
    expected = {(2, 1, 0): 2, (0, 2, 1): 1, (1, 0, 2): 1, (0, 1, 2): 4}
    assert {tuple(child) for child in children.tolist()} == set(expected)
    for child, count in zip(children.tolist(), counts, strict=True):
        assert abs(count / 900 - expected[tuple(child)] / 8) < 0.06


def test_the_elite_is_copied_and_the_population_keeps_its_size(space):
    ranked = space.random(2, 60)
    after = next_population(ranked, space, 9)
    assert len(after) == 60
    np.testing.assert_array_equal(after.tables[:3], ranked.tables[:3])
    np.testing.assert_array_equal(after.structures[:3], ranked.structures[:3])


def test_parents_win_tournaments_of_three(space, monkeypatch):
    """Without mutation a child of equals is one of them: the better half has seven parents of eight."""
    monkeypatch.setattr(Space, "mutated", lambda _self, _key, designs, _rate: designs)
    ranked = space.random(2, 2000)
    ranked.tables[:1000, space.open_cells] = 0
    ranked.tables[1000:, space.open_cells] = 1
    children = next_population(ranked, space, 9).tables[100:, space.open_cells]
    assert abs(children.mean() - 1 / 8) < 0.02


def test_one_cell_in_n_mutates(space):
    ranked = space.random(2, 1)
    same = joint.Designs(np.repeat(ranked.tables, 2000, axis=0), np.repeat(ranked.structures, 2000, axis=0))
    after = next_population(same, space, 9)
    changed = (after.tables[100:] != ranked.tables).sum(axis=1).mean()
    assert abs(changed - 2 / 3) < 0.1  # one of three draws is the choice that was there


def test_the_first_population_is_the_best_of_many_random_designs():
    arena = Arena(guess()[0], 1)
    state = METHOD.begin(arena, 3, 10_000)
    founded = METHOD.advance(state, arena, 3, 10_000)
    assert founded.spent >= 1000
    assert len(founded.population) == len(state.population)
    before, after = (
        arena.means(population, 1, 50).mean() for population in (state.population, founded.population)
    )
    assert after > before + 0.2
