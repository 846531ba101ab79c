"""Figures of experiments over twenty seeds."""

from math import comb

import numpy as np
import pytest

from experiments.quantiles import RANKS, SEEDS, above_line, is_above, median_interval, quartiles_text


def test_the_ranks_enclose_the_median_with_95_percent_whatever_the_distribution():
    n = len(SEEDS)
    low, high = RANKS
    inside = sum(comb(n, below) for below in range(low, high)) / 2**n
    wider = sum(comb(n, below) for below in range(low + 1, high - 1)) / 2**n
    assert inside == pytest.approx(0.959, abs=0.0005)
    assert wider < 0.95


def test_an_outlier_moves_no_end_of_the_interval():
    values = np.arange(20.0)
    assert median_interval(values) == (9.5, 5, 14)
    values[0] = -1000
    assert median_interval(values) == (9.5, 5, 14)
    with pytest.raises(ValueError, match="twenty"):
        median_interval(values[:10])


@pytest.mark.parametrize(("above", "verdict"), [(20, True), (15, True), (14, None), (6, None), (5, False)])
def test_an_arm_is_above_another_where_it_is_in_enough_seeds(above, verdict):
    differences = np.array([1.0] * above + [-1.0] * (20 - above))
    assert is_above(differences) is verdict


def test_lines_say_the_median_its_interval_and_the_seeds():
    line = above_line("a claim", np.arange(20.0), np.full(20, 3.0))
    assert line.split() == ["holds", "a", "claim", "+6.5", "(+2.0", "to", "+11.0),", "16", "of", "20"]
    assert quartiles_text(np.arange(21.0)) == "10.0 (5.0 to 15.0)"
