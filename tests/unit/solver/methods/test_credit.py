"""Credit to single choices, on numbers worked by hand and beside a plain reading of the rule."""

import numpy as np
import pytest

from bbsd.kernel.keys import keys
from bbsd.language.meaning.tables.table import OPEN_CELL
from bbsd.solver.draws import marks
from bbsd.solver.methods.credit import (
    FADING,
    MOST_AT_ONCE,
    SLOWEST,
    credit_backwards,
    learn_values,
    perturbed_tables,
    rates_between,
)

NOT_ASKED = -1


def credited(asked, joint_cells, gains, steps_taken, critic, discount=0.5, mixing=0.5, visits=None):
    """The sums and counts of credits, and the critic after an episode; arrays are those of one lane."""
    asked, joint_cells = np.array(asked, np.int32)[..., None], np.array(joint_cells, np.int32)[..., None]
    critic = np.array(critic, float)
    visits = np.full(len(critic), 3.0) if visits is None else np.array(visits, float)
    sums, counts = np.zeros(6), np.zeros(6)
    credit_backwards(
        asked, joint_cells, np.array(gains, float)[..., None], np.array([float(steps_taken)]),
        critic, visits, sums, counts, discount, mixing,
    )  # fmt: skip
    return sums, counts, critic, visits


def test_every_choice_asked_is_credited_with_the_return_beyond_what_was_expected():
    # Two steps of one robot and two behaviors; the first step asks both, the second one only the first.
    sums, counts, critic, visits = credited(
        asked=[[[2 * 0, 2 * 4]], [[2 * 1, NOT_ASKED]]],
        joint_cells=[[0], [1]],
        gains=[[1.0], [4.0]],
        steps_taken=2,
        critic=[2.0, 3.0],
    )
    # Backwards: the second step earned 4 where 3 was expected; with 4 visits the critic moves by 1 / sqrt(4).
    assert critic[1] == 3.5
    # The first: 1 + 0.5 * (0.5 * 3.5 + 0.5 * 4) = 2.875 where 2 was expected.
    assert sums.tolist() == [0.875, 1.0, 0, 0, 0.875, 0]
    assert counts.tolist() == [1, 1, 0, 0, 1, 0]
    assert critic[0] == 2.0 + 0.875 / 2
    assert visits.tolist() == [4, 4]


def test_a_return_is_cut_where_the_next_choice_strayed():
    asked = [[[2 * 0]], [[2 * 1 + 1]], [[2 * 2]]]
    sums, _, critic, visits = credited(asked, [[0], [1], [2]], [[0.0], [8.0], [0.0]], 3, [1.0, 2.0, 0.0])
    # What the stray earned is its own credit; the critic does not learn from it.
    assert sums[1] == 8.0 - 2.0
    assert critic[1] == 2.0
    assert visits[1] == 3
    # The step before is credited with what the critic expects of the tables there.
    assert sums[0] == 0.5 * 2.0 - 1.0


def test_a_joint_cell_that_was_never_met_is_learned_from_a_stray():
    _, _, critic, visits = credited([[[1]]], [[0]], [[5.0]], 1, [0.0], visits=[0.0])
    assert (critic[0], visits[0]) == (5.0, 1.0)


def test_steps_that_were_not_taken_count_for_nothing():
    sums, counts, critic, _ = credited([[[0]], [[2]]], [[0], [0]], [[1.0], [99.0]], 1, [1.0])
    assert counts.tolist() == [1, 0, 0, 0, 0, 0]
    assert not sums.any()
    assert critic[0] == 1.0


def test_robots_are_credited_with_what_the_team_earned():
    sums, _, _, _ = credited([[[0], [2]]], [[0, 1]], [[1.0, 3.0]], 1, [0.0, 1.0])
    assert sums[:2].tolist() == [2.0, 1.0]


def read_plainly(asked, joint, gains, steps_taken, critic, visits, n_pairs, discount, mixing):
    """The rule as it is said, lane by lane."""
    sums, counts = [0.0] * n_pairs, [0.0] * n_pairs
    for lane, n_steps in enumerate(steps_taken):
        n_robots = asked.shape[1]
        ahead = [(0.0, 0.0, True)] * n_robots
        for step in reversed(range(int(n_steps))):
            team = sum(gains[step, robot, lane] for robot in range(n_robots)) / n_robots
            for robot in range(n_robots):
                earned, expected, strayed = ahead[robot]
                later = expected if strayed else (1 - mixing) * expected + mixing * earned
                cell, earned = joint[step, robot, lane], team + discount * later
                credit = earned - critic[cell]
                codes = [code for code in asked[step, robot, :, lane] if code >= 0]
                for code in codes:
                    sums[code // 2] += credit
                    counts[code // 2] += 1
                strayed = any(code % 2 for code in codes)
                if not strayed or not visits[cell]:
                    visits[cell] += 1
                    critic[cell] += credit * max(1 / visits[cell] ** 0.5, SLOWEST)
                ahead[robot] = (earned, critic[cell], strayed)
    return sums, counts


@pytest.mark.parametrize("codes", [np.int32, np.int64])
def test_it_is_the_rule_as_it_is_said(codes):
    rng = np.random.default_rng(5)
    n_steps, n_robots, n_behaviors, n_lanes, n_pairs = 9, 2, 3, 6, 8
    asked = rng.integers(-4, 2 * n_pairs, (n_steps, n_robots, n_behaviors, n_lanes)).astype(codes)
    joint = rng.integers(0, 5, (n_steps, n_robots, n_lanes)).astype(np.int32)
    gains, steps_taken = rng.normal(size=(n_steps, n_robots, n_lanes)), rng.integers(1, 10, 5).astype(float)
    critic, visits, sums, counts = np.zeros(5), np.zeros(5), np.zeros(n_pairs), np.zeros(n_pairs)
    expected_critic, expected_visits = [0.0] * 5, [0.0] * 5
    expected = read_plainly(
        asked, joint, gains, steps_taken, expected_critic, expected_visits, n_pairs, 0.9, 0.7
    )
    credit_backwards(asked, joint, gains, steps_taken, critic, visits, sums, counts, 0.9, 0.7)
    np.testing.assert_allclose([sums, counts], expected, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose([critic, visits], [expected_critic, expected_visits], rtol=1e-12)


def test_what_is_known_fades_and_credits_of_one_round_count_as_few():
    credit, weight = np.array([8.0, 8.0, 0.0]), np.array([4.0, 4.0, 0.0])
    size = learn_values(credit, weight, np.array([0.0, 6.0, -500.0]), np.array([0.0, 3.0, 100.0]))
    assert credit.tolist() == [8 * FADING, 8 * FADING + 6, -5.0 * MOST_AT_ONCE]
    assert weight.tolist() == [4 * FADING, 4 * FADING + 3, MOST_AT_ONCE]
    assert size == (2.0 + 5.0) / 2


FIRST_PAIRS = np.array([0, 3, 5, 7])
GIVEN = np.array([OPEN_CELL, 1, OPEN_CELL], np.uint8)


def tables(noise, weights=0.0, n=200):
    values, known = np.array([0.0, 1.0, 3.0, 5.0, -5.0, 2.0, 2.0]), np.full(7, float(weights))
    return perturbed_tables(values * (known + 1), known, FIRST_PAIRS, GIVEN, noise, keys(3, 0, n), marks(7))


def test_without_noise_tables_hold_the_best_choices_the_first_of_equal_ones_and_what_is_given():
    assert (tables(0.0) == [2, 1, 0]).all()


def test_noise_tries_other_choices_the_more_the_less_is_known_of_them():
    little, much = tables(9.0)[:, 0], tables(9.0, weights=10_000)[:, 0]
    assert set(little.tolist()) == {0, 1, 2}
    assert (much == 2).mean() > (little == 2).mean()
    assert (tables(9.0)[:, 1] == 1).all()
    assert 70 < tables(9.0)[:, 2].sum() < 130


def test_rates_are_spread_over_magnitudes():
    rates = rates_between(0.01, 1.0, keys(4, 0, 1000))
    assert 0.01 <= rates.min() <= rates.max() < 1.0
    assert abs((rates < 0.1).mean() - 0.5) < 0.05
