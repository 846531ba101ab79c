import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.kernel.streams import fold
from bbsd.solver.paper.genetics import (
    OPEN_CELL,
    cross,
    crossover,
    expected_fitness,
    next_pool,
    random_pool,
    redraw,
    tournament,
)
from tests.unit.solver.problems import BREEDING

WORDS = st.integers(0, 2**64 - 1)
OPEN_TABLE = np.full(6, OPEN_CELL, np.uint8)

# V.B.2, tables of two by three cells and two actions
B1 = np.array([[1, 0, 2], [0, 0, 1]], np.uint8)
B2 = np.array([[1, 0, 2], [0, 0, 0]], np.uint8)
B3 = np.array([[0, 2, 0], [2, 0, 1]], np.uint8)
X = np.array([[0, 0, 1], [0, 1, 1]], np.uint8)
B_NEW = np.array([[0, 2, 2], [2, 0, 1]], np.uint8)


def redrawn(key, table, given_cells, n_actions, probability):
    changed = table.copy()
    redraw(np.uint64(key), changed, given_cells, n_actions, probability)
    return changed


def test_crossover_of_the_paper_s_example():
    for cell in np.ndindex(X.shape):
        assert cross(int(X[cell]), B1[cell], B3[cell]) == B_NEW[cell]


def test_crossover_s_other_child_has_the_complement_of_the_mask():
    # (19) with 1 - X: where X is 0 from B1, where it is 1 from B3
    other = [
        [cross(1 - int(X[row, column]), B1[row, column], B3[row, column]) for column in range(3)]
        for row in range(2)
    ]
    np.testing.assert_array_equal(other, [[1, 0, 0], [0, 0, 1]])


def test_crossover_applies_a_mask_of_independent_cells():
    n = 10_000
    child = np.empty(n, np.uint8)
    crossover(np.uint64(4), np.full(n, 7, np.uint8), np.full(n, 3, np.uint8), 0.3, child)
    # Standard deviation sqrt(0.3 * 0.7 / 10 000) = 0.0046
    assert np.mean(child == 7) == pytest.approx(0.3, abs=5 * 0.0046)
    assert set(child.tolist()) == {3, 7}


@pytest.mark.parametrize(("p_first", "expected"), [(1.0, B1), (0.0, B3)])
def test_crossover_with_a_certain_mask_copies_one_parent(p_first, expected):
    child = np.empty(6, np.uint8)
    crossover(np.uint64(4), B1.ravel(), B3.ravel(), p_first, child)
    np.testing.assert_array_equal(child, expected.ravel())


def test_soft_mutation_makes_the_paper_s_example():
    # Only (2, 3) is drawn anew, and to 0, with probability 1/6 * (5/6)**5 * 1/3 = 0.022 a stream.
    mutants = [redrawn(fold(1, key), B1.ravel(), OPEN_TABLE, 2, 1 / 6) for key in range(2000)]
    assert any(np.array_equal(mutant, B2.ravel()) for mutant in mutants)


def test_soft_mutation_draws_from_no_action_and_all_actions_alike():
    n = 30_000
    mutant = redrawn(5, np.full(n, 9, np.uint8), np.full(n, OPEN_CELL, np.uint8), 2, 0.2)
    # 0, 1, 2 with probability 0.2 / 3 each: standard deviation sqrt(0.067 * 0.933 / 30 000) = 0.00144
    assert np.mean(mutant == 9) == pytest.approx(0.8, abs=5 * 0.0024)
    for action in range(3):
        assert np.mean(mutant == action) == pytest.approx(0.2 / 3, abs=5 * 0.00144)


def test_hard_mutation_keeps_nothing_of_the_old_table():
    assert not np.any(redrawn(6, np.full(500, 9, np.uint8), np.full(500, OPEN_CELL, np.uint8), 4, 1.0) == 9)


def test_without_probability_nothing_mutates():
    np.testing.assert_array_equal(redrawn(6, B1.ravel(), OPEN_TABLE, 2, 0.0), B1.ravel())


def test_a_tournament_prefers_the_fittest_of_three():
    wins = np.bincount([tournament(np.uint64(fold(2, key)), np.arange(4.0), 3) for key in range(20_000)])
    # The winner is at most i with probability ((i + 1) / 4)**3; standard deviation at most 0.0035.
    np.testing.assert_allclose(wins / 20_000, np.array([1, 7, 19, 37]) / 64, atol=5 * 0.0035)


def test_of_equally_fit_entrants_the_lowest_index_wins():
    equal = np.zeros(4)
    wins = np.bincount([tournament(np.uint64(fold(2, key)), equal, 3) for key in range(20_000)])
    # The winner is the least of three draws: the mirror image of the test before.
    np.testing.assert_allclose(wins / 20_000, np.array([37, 19, 7, 1]) / 64, atol=5 * 0.0035)


def test_an_individual_without_fitness_loses_to_any_other():
    fitness = np.array([-np.inf, -1e300])
    wins = np.bincount([tournament(np.uint64(fold(2, key)), fitness, 3) for key in range(8000)])
    assert wins[0] / 8000 == pytest.approx(1 / 8, abs=5 * 0.0037)  # only where it is drawn three times


def test_random_pools_are_uniform_and_keep_given_cells():
    given_cells = np.array([OPEN_CELL, 2, 0, OPEN_CELL], np.uint8)
    pool = random_pool(3, 9000, given_cells, 2)
    assert pool.dtype == np.uint8
    assert np.all(pool[:, 1] == 2)
    assert np.all(pool[:, 2] == 0)
    tables = np.bincount(3 * pool[:, 0].astype(int) + pool[:, 3])
    # 9 tables, 1000 expected of each, standard deviation 29.8
    assert np.all(np.abs(tables - 1000) < 5 * 29.8)


def test_elites_are_copied_unchanged_to_the_first_slots():
    pool = random_pool(3, 5, OPEN_TABLE, 2)
    fitness = np.array([1.0, 7.0, -np.inf, 7.0, 2.0])
    children = next_pool(8, pool, fitness, 2, OPEN_TABLE, BREEDING._replace(elites=3, soft_mutation=1.0))
    np.testing.assert_array_equal(children[:3], pool[[1, 3, 4]])  # equally fit: the lowest index first


def test_without_mutation_children_have_their_cells_from_the_pool():
    pool = np.arange(60, dtype=np.uint8).reshape(10, 6)
    children = next_pool(8, pool, np.arange(10.0), 250, OPEN_TABLE, BREEDING)
    assert np.all(children % 6 == np.arange(6))


def test_hard_mutation_strikes_children_with_its_probability():
    n = 4000
    pool = np.full((n, 6), 200, np.uint8)
    children = next_pool(8, pool, np.zeros(n), 100, OPEN_TABLE, BREEDING._replace(hard_mutation=0.1))
    struck = np.any(children != 200, axis=1)
    assert np.all(children[struck] <= 100)
    assert np.mean(struck) == pytest.approx(0.1, abs=5 * 0.0047)  # sqrt(0.1 * 0.9 / 4000)


def test_soft_mutation_strikes_cells_with_its_probability():
    n = 4000
    pool = np.full((n, 6), 200, np.uint8)
    children = next_pool(8, pool, np.zeros(n), 100, OPEN_TABLE, BREEDING._replace(soft_mutation=0.1))
    assert np.mean(children != 200) == pytest.approx(0.1, abs=5 * 0.0019)  # sqrt(0.1 * 0.9 / 24 000)


@given(WORDS, st.lists(st.sampled_from([0, 1, 2, OPEN_CELL]), max_size=8), st.floats(0, 1), st.floats(0, 1))
def test_given_cells_never_change(key, given_cells, p_hard, p_soft):
    fixed = np.array(given_cells, np.uint8)
    pool = random_pool(key, 6, fixed, 2)
    children = next_pool(
        key, pool, np.arange(6.0), 2, fixed, BREEDING._replace(hard_mutation=p_hard, soft_mutation=p_soft)
    )
    assert children.shape == pool.shape
    assert np.all((children == fixed) | (fixed == OPEN_CELL))
    assert np.all(children <= 2)


def test_a_new_generation_leaves_the_old_one_as_it_was():
    pool = random_pool(3, 5, OPEN_TABLE, 2)
    before = pool.copy()
    next_pool(8, pool, np.arange(5.0), 2, OPEN_TABLE, BREEDING._replace(hard_mutation=0.5, soft_mutation=0.5))
    np.testing.assert_array_equal(pool, before)


def test_two_children_of_a_pair_have_complementary_masks():
    pool = np.arange(1, 13, dtype=np.uint8)[:, None] + np.zeros(40, np.uint8)  # individual k holds k + 1
    twins = next_pool(
        8, pool, np.zeros(12), 250, np.full(40, OPEN_CELL, np.uint8), BREEDING._replace(children=2)
    )
    for first, second in zip(twins[1:11:2], twins[2:12:2], strict=True):
        parents = {*first.tolist(), *second.tolist()}
        assert len(parents) <= 2
        assert all({a, b} == parents for a, b in zip(first.tolist(), second.tolist(), strict=True))


@pytest.mark.parametrize("children", [1, 2])
def test_the_fitness_expected_of_a_child_is_its_parents_mean(children):
    """Of tables that hold what their individual's fitness is, crossed cell by cell."""
    breeding = BREEDING._replace(elites=2, children=children)
    pool = np.arange(9, dtype=np.uint8)[:, None] + np.zeros(60, np.uint8)
    fitness = np.arange(9.0)
    born = next_pool(5, pool, fitness, 250, np.full(60, OPEN_CELL, np.uint8), breeding)
    expected = expected_fitness(5, fitness, breeding)
    assert expected[:2].tolist() == [8, 7]
    parents = [(int(table.min()) + int(table.max())) / 2 for table in born]
    assert expected.tolist() == parents


def test_who_took_part_in_no_agent_is_expected_to_be_as_bad_as_the_worst():
    fitness = np.array([-np.inf, 3.0, 1.0, -np.inf])
    assert np.isfinite(expected_fitness(5, fitness, BREEDING._replace(tournament=1))).all()
    assert expected_fitness(5, fitness, BREEDING._replace(elites=4)).tolist() == [3, 1, 1, 1]
