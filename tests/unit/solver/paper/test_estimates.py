from types import SimpleNamespace

import numpy as np
import pytest

from bbsd.language.design import Learning
from bbsd.solver.paper.estimates import no_experience, update_all_values, update_values


def test_values_of_the_present_structure_move_toward_the_credit():
    values = np.array([[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]])  # one agent, two layers, three behaviors
    update_values(values, np.array([[2, 0]]), np.array([[0.0, 9.0, 7.0, 8.0]]), 0.25)
    # (13): layer 0 holds behavior 2: 0.75 * 3 + 0.25 * 7 = 4; layer 1 holds behavior 0, which did not
    # control: 0.75 * 4 + 0.25 * 0 = 3. Behavior 1 is in no layer; the last column is nobody's.
    np.testing.assert_array_equal(values, [[[1.0, 2.0, 4.0], [3.0, 5.0, 6.0]]])


def test_taken_literally_values_outside_of_the_present_structure_decay_too():
    values = np.array([[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]])
    update_all_values(values, np.array([[2, 0]]), np.array([[0.0, 9.0, 7.0, 8.0]]), 0.25)
    # (13) of the pairs of the structure as above; all others are multiplied by 0.75.
    np.testing.assert_array_equal(values, [[[0.75, 1.5, 4.0], [3.0, 3.75, 4.5]]])


def test_pairs_of_the_structure_have_the_same_bits_whatever_happens_outside():
    rng = np.random.default_rng(1)
    structures = rng.permuted(np.tile([0, 1, 2, 3], (50, 1)), axis=1)[:, :3]
    kept, decayed = (rng.normal(size=(50, 3, 4)) for _ in range(2))
    decayed[:] = kept
    for rate in (0.3, 0.07):
        credit = rng.normal(size=(50, 5))
        update_values(kept, structures, credit, rate)
        update_all_values(decayed, structures, credit, rate)
        agents, layers = np.ogrid[:50, :3]
        np.testing.assert_array_equal(kept[agents, layers, structures], decayed[agents, layers, structures])


@pytest.mark.parametrize(("outside", "first"), [("keep", 4.5), ("decay", 2.25)])
def test_the_setting_says_what_happens_outside(outside, first):
    estimate = no_experience(Learning(outside=outside), (1, 1, 2))
    estimate.update(np.array([[0]]), outcome([9.0, 4.0, 0.0], []), 0.5)
    estimate.update(np.array([[1]]), outcome([0.0, 4.0, 0.0], []), 0.5)
    assert estimate.values.tolist() == [[[first, 2.0]]]


def test_with_rate_1_an_estimate_is_the_last_credit():
    values = np.full((1, 1, 1), 123.0)
    update_values(values, np.array([[0]]), np.array([[-2.0, 0.0]]), 1.0)
    assert values.item() == -2.0


def test_with_rate_1_over_n_an_estimate_is_the_mean_credit():
    values = np.zeros((1, 1, 1))
    for episode, credit in enumerate([3.0, 5.0, -2.0, 6.0], start=1):
        update_values(values, np.array([[0]]), np.array([[credit, 0.0]]), 1 / episode)
    assert values.item() == pytest.approx(3.0, abs=1e-12)  # (3 + 5 - 2 + 6) / 4


def outcome(credit, control):
    return SimpleNamespace(credit=np.array([credit]), control=np.array([control]))


def test_values_and_probabilities_are_counted():
    estimate = no_experience(Learning(estimate="counters"), (1, 2, 2))
    estimate.update(np.array([[0, 1]]), outcome([6.0, 3.0, 1.0], [4.0, 6.0, 10.0]), 0.5)
    # (11) from 0 with rate 1/2: 6 / 4 / 2 = 0.75 and 3 / 6 / 2 = 0.25; (9): 4 and 6 of 20 steps
    np.testing.assert_allclose(estimate.values, [[[4 / 20 * 0.75, 0], [0, 6 / 20 * 0.25]]])
    estimate.update(np.array([[1, 0]]), outcome([0.0, 8.0, 0.0], [0.0, 16.0, 4.0]), 0.5)
    # behavior 1, now in layer 0: 8 / 16 / 2 = 0.25; behavior 0 did not control; 40 steps by now
    np.testing.assert_allclose(estimate.values, [[[4 / 40 * 0.75, 16 / 40 * 0.25], [0, 6 / 40 * 0.25]]])


def test_a_joint_estimate_is_updated_by_13():
    estimate = no_experience(Learning(), (1, 1, 2))
    estimate.update(np.array([[1]]), outcome([9.0, 4.0, 0.0], []), 0.5)
    assert estimate.values.tolist() == [[[0.0, 2.0]]]
