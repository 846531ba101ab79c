"""What chains bring and what processes allow: worked by hand, by all episodes there are, and by another algorithm."""

from itertools import product
from math import sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.evaluation.exact.decision_process import Chain, DecisionProcess

# State 0 goes to 1 or, with a quarter of the chance, to the end; 1 goes to 2; 2 stays or goes back to 0.
ORIGINS, TARGETS = np.array([0, 0, 1, 2, 2]), np.array([1, -1, 2, 2, 0])
CHANCES, GAINS = np.array([0.75, 0.25, 1.0, 0.5, 0.5]), np.array([1.0, 10.0, 2.0, 0.0, 4.0])


def chain(starts=(1.0, 0.0, 0.0)):
    return Chain(np.array(starts), ORIGINS, TARGETS, CHANCES)


def test_visits_by_hand():
    # Steps begin in: 0; then 1 (3/4); then 2 (3/4); then 2 (3/8) or 0 (3/8).
    assert chain().visits(3).tolist() == [1.0, 0.75, 0.75]
    assert chain().visits(4).tolist() == [1.375, 0.75, 1.125]
    assert chain().visits(0).tolist() == [0.0, 0.0, 0.0]


def test_mean_and_deviation_by_hand():
    # In two steps: 10 (1/4), or 1 + 2 (3/4).
    mean, sd = chain().moments(GAINS, 2)
    assert mean == pytest.approx(10 / 4 + 3 * 3 / 4)
    assert sd == pytest.approx(sqrt(100 / 4 + 9 * 3 / 4 - mean**2))
    assert chain().expected(GAINS, chain().visits(2)) == pytest.approx(mean)
    # From the states 0 and 1, each half of the time, in one step: 1 (3/8), 10 (1/8), 2 (1/2).
    mean, sd = chain((0.5, 0.5, 0.0)).moments(GAINS, 1)
    assert mean == pytest.approx(3 / 8 + 10 / 8 + 1)
    assert sd == pytest.approx(sqrt(3 / 8 + 100 / 8 + 4 / 2 - mean**2))


def test_a_small_deviation_beside_a_large_mean_is_kept():
    walk = Chain(np.array([1.0]), np.array([0, 0]), np.array([-1, -1]), np.array([0.5, 0.5]))
    assert walk.moments(np.array([1e9, 1e9 + 1e-3]), 1).sd == pytest.approx(5e-4, rel=1e-3)


def test_the_end_is_the_end():
    ends = Chain(np.array([1.0]), np.array([0]), np.array([-1]), np.array([1.0]))
    assert ends.moments(np.array([7.0]), 50) == (7.0, 0.0)
    assert ends.visits(50).tolist() == [1.0]


def process():
    """State 0: wait for 1 and stay, or go on to 1 for nothing. State 1: take 5 and end, or gamble: 30 or back to 0."""
    return DecisionProcess(
        starts=np.array([1.0, 0.0]),
        first_options=np.array([0, 2]),
        options=np.array([0, 1, 2, 3, 3]),
        targets=np.array([0, 1, -1, -1, 0]),
        probabilities=np.array([1.0, 1.0, 1.0, 0.125, 0.875]),
        rewards=np.array([1.0, 0.0, 5.0, 30.0, 0.0]),
    )


@pytest.mark.parametrize(
    ("steps", "best", "fixed"),
    [
        (0, 0, 0),
        (1, 1, 1),
        # Go on and take 5; waiting first would leave no time.
        (2, 5, 5),
        # Wait once, then the same: which no policy does that always does the same in a state.
        (3, 6, 5),
        # Go on, gamble (30/8), and where it was lost go on again and take 5; always the same: gamble twice.
        (4, 30 / 8 + 7 / 8 * 5, 30 / 8 + 7 / 8 * 30 / 8),
        # Wait before.
        (5, 1 + 30 / 8 + 7 / 8 * 5, 30 / 8 + 7 / 8 * 30 / 8),
    ],
)
def test_optimum_by_hand(steps, best, fixed):
    found = process().optimum(steps)

    assert found.best == pytest.approx(best)
    assert found.fixed == pytest.approx(fixed)


def test_a_policy_that_always_does_the_same():
    assert process().value(np.array([1, 3]), 2) == pytest.approx(30 / 8)
    assert process().value(np.array([1, 3]), 4) == pytest.approx(30 / 8 + 7 / 8 * 30 / 8)


@st.composite
def processes(draw):
    """Random processes of up to four states, three options, and three outcomes."""
    n_states, n_options, n_outcomes = (
        draw(st.integers(1, 4)),
        draw(st.integers(1, 3)),
        draw(st.integers(1, 3)),
    )
    numbers = st.integers(-8, 8)
    shape = (n_states, n_options, n_outcomes)
    size = n_states * n_options * n_outcomes

    def array(values):
        return np.array(draw(st.lists(values, min_size=size, max_size=size)), np.float64).reshape(shape)

    weights = array(st.integers(1, 5))
    targets = array(st.integers(-1, n_states - 1)).astype(np.int64)
    starts = np.array(draw(st.lists(st.integers(1, 5), min_size=n_states, max_size=n_states)), np.float64)
    chances = weights / weights.sum(axis=2, keepdims=True)
    return starts / starts.sum(), targets, chances, array(numbers), draw(st.integers(1, 6))


def as_process(starts, targets, chances, rewards):
    n_states, n_options, n_outcomes = targets.shape
    options = np.repeat(np.arange(n_states * n_options), n_outcomes)
    firsts = np.arange(n_states) * n_options
    return DecisionProcess(starts, firsts, options, targets.ravel(), chances.ravel(), rewards.ravel())


@given(processes())
def test_the_optimum_is_that_of_value_iteration_written_state_by_state(made):
    starts, targets, chances, rewards, steps = made

    def worth(state, left):
        if state < 0 or left == 0:
            return 0.0
        return max(
            sum(
                chance * (reward + (memory[left - 1][target] if target >= 0 else 0.0))
                for target, chance, reward in zip(*option, strict=True)
            )
            for option in zip(targets[state], chances[state], rewards[state], strict=True)
        )

    memory: list[list[float]] = []
    for left in range(steps + 1):
        memory.extend([[worth(state, left) for state in range(len(starts))]])
    found = as_process(starts, targets, chances, rewards).optimum(steps)

    assert found.best == pytest.approx(float(starts @ memory[steps]), abs=1e-9)
    assert found.fixed <= found.best + 1e-9


@given(processes(), st.data())
def test_what_a_policy_earns_is_what_all_its_episodes_earn(made, data):
    starts, targets, chances, rewards, steps = made
    steps = min(steps, 4)
    policy = [data.draw(st.integers(0, targets.shape[1] - 1)) for _ in starts]
    mean = square = 0.0
    for first, outcomes in product(range(len(starts)), product(range(targets.shape[2]), repeat=steps)):
        state, chance, earned = first, starts[first], 0.0
        for outcome in outcomes:
            if state < 0:
                chance *= outcome == 0  # an episode that is over is counted once
                continue
            at = state, policy[state], outcome
            chance, earned, state = chance * chances[at], earned + rewards[at], targets[at]
        mean, square = mean + chance * earned, square + chance * earned**2

    made_process = as_process(starts, targets, chances, rewards)
    options = np.array(policy) + made_process.first_options
    assert made_process.value(options, steps) == pytest.approx(mean, abs=1e-9)

    states = np.arange(len(starts))
    taken = targets[states, policy], chances[states, policy], rewards[states, policy]
    origins = np.repeat(states, targets.shape[2])
    walk = Chain(starts, origins, taken[0].ravel(), taken[1].ravel())
    moments = walk.moments(taken[2].ravel(), steps)
    assert moments.mean == pytest.approx(mean, abs=1e-9)
    assert walk.expected(taken[2].ravel(), walk.visits(steps)) == pytest.approx(mean, abs=1e-9)
    assert moments.sd**2 == pytest.approx(square - mean**2, abs=1e-7)
