import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from bbsd.kernel.streams import fold
from bbsd.solver.paper.pairing import balanced, members

WORDS = st.integers(0, 2**64 - 1)


def pools(*populations):
    """The fitness expected in pools of which nothing is known."""
    return [np.zeros(population) for population in populations]


@given(WORDS, st.integers(1, 30), st.integers(0, 100))
def test_counts_of_individuals_differ_by_at_most_one(key, population, n_agents):
    counts = np.bincount(balanced(key, population, n_agents), minlength=population)
    assert len(counts) == population
    assert counts.sum() == n_agents
    assert counts.max() - counts.min() <= 1


def test_when_numbers_allow_it_counts_are_equal():
    assert set(np.bincount(balanced(7, 20, 200))) == {10}  # Table 1, lifting: 200 agents / 20 individuals


def test_who_is_used_once_more_is_random():
    often = sum(np.bincount(balanced(fold(3, key), 4, 5), minlength=4) == 2 for key in range(2000))
    # Each of 4 in a quarter of 2000 draws: 500, standard deviation 19.4.
    assert np.all(np.abs(often - 500) < 5 * 19.4)


def test_members_are_one_column_a_pool_each_with_an_order_of_its_own():
    paired = members(11, pools(20, 20, 1), 200)
    assert paired.shape == (200, 3)
    assert np.all(paired[:, 2] == 0)
    assert not np.array_equal(paired[:, 0], paired[:, 1])


def test_a_pool_s_column_does_not_depend_on_the_other_pools():
    np.testing.assert_array_equal(members(5, pools(6, 8), 30)[:, 0], members(5, pools(6), 30)[:, 0])


def test_all_pairs_meet_equally_often():
    meetings = np.zeros((3, 3))
    for key in range(1000):
        paired = members(fold(9, key), pools(3, 3), 6)
        np.add.at(meetings, (paired[:, 0], paired[:, 1]), 1)
    # 6000 agents over 9 pairs: 667 each, standard deviation at most sqrt(6000 * 1/9 * 8/9) = 24
    assert np.all(np.abs(meetings - 6000 / 9) < 5 * 24)


def test_keys_of_all_64_bits_are_told_apart():
    orders = {tuple(balanced(key, 20, 20)) for key in (0, 1, 2**63, 2**63 + 1, 2**64 - 1)}
    assert len(orders) == 5


def test_at_random_every_individual_is_as_likely():
    paired = members(3, pools(4, 5), 20_000, "random")
    for column, population in zip(paired.T, (4, 5), strict=True):
        counts = np.bincount(column, minlength=population)
        assert len(counts) == population
        np.testing.assert_allclose(counts / 20_000, 1 / population, atol=0.02)


def test_in_proportion_the_fitter_are_used_more_often():
    # Sectors of f - min + 0.1 (max - min): 1, 11, 6 of 18.
    paired = members(3, [np.array([-5.0, 5.0, 0.0]), np.zeros(2)], 20_000, "proportional")
    np.testing.assert_allclose(np.bincount(paired[:, 0]) / 20_000, np.array([1, 11, 6]) / 18, atol=0.02)
    np.testing.assert_allclose(np.bincount(paired[:, 1]) / 20_000, 0.5, atol=0.02)  # all alike
