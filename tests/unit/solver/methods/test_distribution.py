import numpy as np
import pytest

from bbsd.solver.methods.distribution import Distribution, uniform_distribution
from bbsd.solver.space import Space
from tests.unit.solver.problems import guess

MANY = np.arange(4000)


@pytest.fixture(scope="module")
def space():
    return Space(guess()[0])


def test_uniform_draws_are_all_equally_frequent(space):
    designs = uniform_distribution(space).drawn(space, 3, MANY)
    for cell in space.open_cells:
        counts = np.bincount(designs.tables[:, cell])
        assert len(counts) == space.choices[cell]
        np.testing.assert_allclose(counts / len(MANY), 1 / space.choices[cell], atol=0.03)
    orders, counts = np.unique(designs.structures, axis=0, return_counts=True)
    assert len(orders) == 6
    np.testing.assert_allclose(counts / len(MANY), 1 / 6, atol=0.03)


def test_a_design_s_number_is_its_name(space):
    distribution = uniform_distribution(space)
    designs, some = distribution.drawn(space, 3, MANY), distribution.drawn(space, 3, np.array([17, 4]))
    np.testing.assert_array_equal(some.tables, designs.tables[[17, 4]])
    np.testing.assert_array_equal(some.structures, designs.structures[[17, 4]])


def test_layers_are_drawn_from_the_top_down_without_replacement(space):
    uniform = uniform_distribution(space)
    layers = np.array([[0.8, 0.1, 0.1], [0.8, 0.1, 0.1], [0.8, 0.2, 0.0]])
    structures = Distribution(uniform.choices, layers).drawn(space, 3, MANY).structures
    top = np.bincount(structures[:, 2], minlength=3) / len(MANY)
    np.testing.assert_allclose(top, [0.8, 0.2, 0.0], atol=0.03)
    middle = np.bincount(structures[structures[:, 2] == 0, 1], minlength=3)
    np.testing.assert_allclose(middle / middle.sum(), [0.0, 0.5, 0.5], atol=0.03)


def test_the_most_probable_design_takes_the_top_layer_s_candidate_first(space):
    uniform = uniform_distribution(space)
    choices = uniform.choices.copy()
    choices[:, 1] += 0.1
    layers = np.array([[0.2, 0.3, 0.5], [0.1, 0.5, 0.4], [0.1, 0.5, 0.4]])
    design = Distribution(choices, layers).most_probable(space)
    assert design.structures.tolist() == [[0, 2, 1]]
    assert (design.tables[0, space.open_cells] == 1).all()


def test_probabilities_move_toward_frequencies_and_keep_a_floor(space):
    uniform = uniform_distribution(space)
    elite = uniform.drawn(space, 3, np.array([5, 5, 5, 6]))
    moved = uniform.moved(space, elite, 0.3, 0.01)
    cell = 0
    frequency = np.bincount(elite.tables[:, space.open_cells[cell]], minlength=3) / 4
    np.testing.assert_allclose(moved.choices[cell], 0.7 / 3 + 0.3 * frequency)
    for _ in range(100):
        moved = moved.moved(space, elite[:1], 0.3, 0.01)
    np.testing.assert_allclose(np.sort(moved.choices[cell]), np.array([1, 1, 300 - 3]) / 299, atol=1e-4)
    np.testing.assert_allclose(moved.layers.sum(axis=1), 1.0)
    np.testing.assert_array_equal(moved.most_probable(space).structures, elite[:1].structures)


def test_a_choice_that_a_cell_has_not_stays_impossible(space):
    """Cells with fewer choices than others have probability 0 for the rest."""
    n_choices = space.choices[space.open_cells]
    mixed = np.where(np.arange(4) < np.minimum(n_choices, 2)[:, None], 0.5, 0.0)
    distribution = Distribution(mixed, uniform_distribution(space).layers)
    designs = distribution.drawn(space, 3, MANY[:500])
    assert designs.tables[:, space.open_cells].max() == 1
    assert (distribution.moved(space, designs, 0.3, 0.01).choices[:, 2:] == 0).all()
