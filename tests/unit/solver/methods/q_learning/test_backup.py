import numpy as np
import pytest

from bbsd.solver.methods.q_learning.backup import learn_backwards

N_CHOICES = 2


def learned(codes, gains, *, discount=0.5, trace=1.0, start=1e18, values=None, possible=None, taken=None):
    """Values (3 joint cells, 2 choices) after one robot's episode; with such a start the last episode is all."""
    values = np.zeros((3, N_CHOICES)) if values is None else values
    counts = np.zeros((3, N_CHOICES), np.int64)
    asked = np.array([2 * (cell * N_CHOICES + choice) + strayed for cell, choice, strayed in codes])
    possible = np.ones((3, N_CHOICES), np.bool_) if possible is None else possible
    learn_backwards(
        asked.reshape(-1, 1, 1),
        np.array(gains, float).reshape(-1, 1, 1),
        np.array([len(codes) if taken is None else taken], float),
        possible,
        values,
        counts,
        discount,
        trace,
        start,
        0.0,
    )
    return values, counts


def test_what_followed_is_discounted():
    values, counts = learned([(0, 1, 0), (1, 0, 0), (2, 1, 0)], [1, 0, 4])
    assert values.tolist() == [[0, 1 + 0.25 * 4], [0.5 * 4, 0], [0, 4]]
    assert counts.tolist() == [[0, 1], [1, 0], [0, 1]]


def test_without_a_trace_the_best_value_of_the_next_cell_counts():
    before = np.array([[0.0, 0], [0, 10], [0, 0]])
    values, _ = learned([(0, 1, 0), (1, 0, 0), (2, 1, 0)], [1, 0, 4], trace=0.0, values=before)
    assert values.tolist() == [[0, 1 + 0.5 * 10], [0.5 * 4, 10], [0, 4]]


def test_a_choice_that_strayed_does_not_count_for_those_before():
    before = np.array([[0.0, 0], [0, 10], [0, 0]])
    values, _ = learned([(0, 1, 0), (1, 0, 1), (2, 1, 0)], [1, 0, 4], values=before)
    assert values[0, 1] == 1 + 0.5 * 10


def test_what_no_behavior_can_do_is_not_hoped_for():
    before = np.array([[0.0, 0], [0, 10], [0, 0]])
    possible = np.array([[True, True], [True, False], [True, True]])
    values, _ = learned([(0, 1, 0), (1, 0, 1), (2, 1, 0)], [1, 0, 4], values=before, possible=possible)
    assert values[0, 1] == 1 + 0.5 * (0.5 * 4)


def test_values_move_less_the_more_is_known():
    values, counts = learned([(0, 0, 0)], [8], start=1.0)
    assert values[0, 0] == 8
    values, counts = learned([(0, 0, 0)] * 3, [0, 0, 6], discount=0.0, start=1.0)
    # From the last step: 6, then half of the way to 0, then a third of it.
    assert values[0, 0] == pytest.approx(6 * 1 / 2 * 2 / 3)
    assert counts[0, 0] == 3


def test_steps_after_the_end_do_not_count():
    values, counts = learned([(0, 1, 0), (1, 0, 0), (2, 1, 0)], [1, 2, 4], taken=1)
    assert values.tolist() == [[0, 1], [0, 0], [0, 0]]
    assert counts.sum() == 1


def test_a_team_earns_its_mean():
    values, counts = np.zeros((3, 2)), np.zeros((3, 2), np.int64)
    asked = np.array([[2 * 0], [2 * 2]]).reshape(1, 2, 1)
    gains = np.array([3.0, 5]).reshape(1, 2, 1)
    learn_backwards(asked, gains, np.ones(1), np.ones((3, 2), np.bool_), values, counts, 0.5, 1.0, 1.0, 0.0)
    assert values.tolist() == [[4, 0], [4, 0], [0, 0]]


def test_compiled_and_plain_are_the_same():
    rng = np.random.default_rng(1)
    asked, gains = rng.integers(0, 12, (9, 2, 5)), rng.normal(size=(9, 2, 5))
    taken, possible = rng.integers(1, 10, 5).astype(float), rng.random((3, 2)) < 0.7
    outcomes = []
    for function in (learn_backwards, learn_backwards.py_func):
        values, counts = np.zeros((3, 2)), np.zeros((3, 2), np.int64)
        function(asked, gains, taken, possible, values, counts, 0.9, 0.8, 3.0, 0.1)
        outcomes.append((values.tobytes(), counts.tobytes()))
    assert outcomes[0] == outcomes[1]
