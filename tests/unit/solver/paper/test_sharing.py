import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from bbsd.solver.paper.sharing import (
    agent_fitness,
    contributions,
    difference_based,
    lenient,
    lifetime_fitness,
    uniform,
    value_based,
)

RETURNS = np.array([[1.0, 2.0, 6.0], [0.0, -4.0, 1.0]])
MEMBERS = np.array([[0, 2], [1, 2], [0, 0]])  # three agents of two behaviors, from pools of three


def test_fitness_is_the_mean_of_the_last_episodes():
    # (2 + 6) / 2 = 4; (-4 + 1) / 2 = -1.5
    np.testing.assert_array_equal(agent_fitness(RETURNS, 2), [4.0, -1.5])


def test_lifetime_fitness_is_the_mean_of_all_episodes():
    # (1 + 2 + 6) / 3 = 3; (0 - 4 + 1) / 3 = -1
    np.testing.assert_array_equal(lifetime_fitness(RETURNS), [3.0, -1.0])


def test_fitness_leaves_the_returns_as_they_were():
    returns = RETURNS.copy()
    lifetime_fitness(returns)
    np.testing.assert_array_equal(returns, RETURNS)


@given(st.lists(st.floats(-1e9, 1e9), min_size=1, max_size=40))
def test_an_agent_s_fitness_has_the_same_bits_alone_and_among_others(returns):
    alone = lifetime_fitness(np.array([returns]))
    among = lifetime_fitness(np.asfortranarray([returns] * 9))
    total = 0.0
    for each in returns:
        total += each
    assert alone[0] == among[4] == total / len(returns)


def test_uniform_sharing_averages_over_the_agents_an_individual_took_part_in():
    shared = uniform(np.array([6.0, 1.0, 2.0]), MEMBERS, 3)
    expected = [
        [4.0, 1.0, -np.inf],  # 0 in the first and third agent, (6 + 2) / 2; 1 in the second; 2 in none
        [2.0, -np.inf, 3.5],  # 0 in the third; 1 in none; 2 in the first and second, (6 + 1) / 2
    ]
    np.testing.assert_array_equal(shared, expected)


def test_a_contribution_is_the_sum_of_a_behavior_s_values_in_all_layers():
    values = np.array([[[1.0, 2.0, 0.0], [4.0, 8.0, 0.0]]])  # one agent, two layers, three behaviors
    # (16): 1 + 4 = 5; 2 + 8 = 10; the third never controlled
    np.testing.assert_array_equal(contributions(values), [[5.0, 10.0, 0.0]])


def test_value_based_sharing_averages_contributions():
    values = np.array([[[1.0, 2.0], [4.0, 8.0]], [[3.0, 0.0], [0.0, 0.5]], [[0.0, -1.0], [1.0, 0.0]]])
    # (16): contributions [5, 10], [3, 0.5], [1, -1]
    expected = [
        [3.0, 3.0, -np.inf],  # 0: (5 + 1) / 2; 1: 3; 2: none
        [-1.0, -np.inf, 5.25],  # 0: -1; 1: none; 2: (10 + 0.5) / 2
    ]
    np.testing.assert_array_equal(value_based(values, MEMBERS, 3), expected)


def test_sharing_by_differences_averages_over_the_agents_an_individual_took_part_in():
    # What each of three agents earns less with its first and with its second behavior held to No Action.
    differences = np.array([[5.0, -1.0], [2.0, 0.0], [-3.0, 4.0]])
    expected = [
        [1.0, 2.0, -np.inf],  # 0: (5 - 3) / 2; 1: 2; 2: none
        [4.0, -np.inf, -0.5],  # 0: 4; 1: none; 2: (-1 + 0) / 2
    ]
    np.testing.assert_array_equal(difference_based(differences, MEMBERS, 3), expected)


@given(st.integers(0, 2**32), st.floats(-100, 100))
def test_when_all_agents_are_equally_fit_so_is_every_individual_that_was_drawn(seed, fitness):
    drawn = np.random.default_rng(seed).integers(0, 5, (4, 3))
    shared = uniform(np.full(4, fitness), drawn, 5)
    for behavior in range(3):
        for individual in range(5):
            took_part = individual in drawn[:, behavior]
            # one to four equal terms: only three of them can round
            assert (
                abs(shared[behavior, individual] - fitness) <= 1e-13
                if took_part
                else shared[behavior, individual] == -np.inf
            )


def test_lenient_fitness_is_the_mean_of_an_individual_s_best_agents():
    members = np.array([[0, 2], [1, 2], [0, 0], [0, 2], [0, 2]])
    shared = lenient(np.array([4.0, -1.0, 9.0, 1.0, 6.0]), members, 4, 2)
    # the first pool's 0 was in agents of 4, 9, 1 and 6, so (9 + 6) / 2; the second one's 2 in 4, -1, 1 and 6
    np.testing.assert_array_equal(shared, [[7.5, -1.0, -np.inf, -np.inf], [9.0, -np.inf, 5.0, -np.inf]])


def test_lenient_fitness_of_all_agents_is_the_uniform_one():
    fitness = np.array([4.0, -1.5, 9.0])
    np.testing.assert_array_equal(lenient(fitness, MEMBERS, 3, 3), uniform(fitness, MEMBERS, 3))
