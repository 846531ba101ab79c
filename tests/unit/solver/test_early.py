"""Measurements of the best so far, on numbers worked by hand."""

from math import inf, sqrt

import numpy as np
import pytest

from bbsd.solver.early import FEWEST, Measured, measured


def test_measurements_of_the_same_design_are_one():
    one, other = np.array([1.0, 2.0, 6.0]), np.array([4.0, 7.0])
    joined = measured(one).joined(measured(other))
    whole = measured(np.concatenate([one, other]))
    assert joined.episodes == 5
    assert joined.mean == pytest.approx(4.0)
    assert joined.squares == pytest.approx(9 + 4 + 4 + 0 + 9)
    assert joined == pytest.approx(whole)
    assert Measured().joined(measured(one)) == measured(one)


def test_the_interval_begins_below_the_mean():
    found = Measured(mean=10.0, squares=4.0 * 99, episodes=100)
    assert found.low == pytest.approx(10 - 1.96 * sqrt(4 / 100))


def test_of_few_episodes_nothing_is_known():
    assert measured(np.ones(FEWEST - 1)).low == -inf
    assert measured(np.ones(FEWEST)).low == 1.0
    assert measured(np.ones(1)) == Measured(1.0, 0.0, 1)
