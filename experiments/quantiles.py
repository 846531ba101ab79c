"""Figures over seeds as quantiles: one seed in twenty may collapse, which means with symmetric intervals would hide."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from experiments.designs import verdict

if TYPE_CHECKING:
    from experiments.designs import Floats

SEEDS = range(20)
RANKS = (6, 15)
"""Of twenty sorted values these enclose the median with a probability of 95.9 %, however they are distributed."""


def quartiles_text(values: Floats, digits: int = 1) -> str:
    """Return the median over seeds, and between which values the middle half of them lies, as text."""
    low, median, high = (f"{value:.{digits}f}" for value in np.quantile(values, [0.25, 0.5, 0.75]))
    return f"{median} ({low} to {high})"


def median_interval(values: Floats) -> tuple[float, float, float]:
    """Return the median of twenty values and the ends of its interval."""
    if len(values) != len(SEEDS):
        raise ValueError("the ranks of the interval are those of twenty values")
    ordered = np.sort(values)
    return float(np.median(values)), float(ordered[RANKS[0] - 1]), float(ordered[RANKS[1] - 1])


def difference_text(differences: Floats, digits: int = 1) -> str:
    """Return the median of the differences over seeds, its interval, and how many are above 0, as text."""
    median, low, high = (f"{value:+.{digits}f}" for value in median_interval(differences))
    return f"{median} ({low} to {high}), {np.count_nonzero(differences > 0)} of {len(differences)}"


def is_above(differences: Floats) -> bool | None:
    """Return whether the median of the differences over seeds is above 0, or None where its interval includes 0."""
    _, low, high = median_interval(differences)
    return True if low > 0 else False if high < 0 else None


def above_line(claim: str, above: Floats, below: Floats, digits: int = 1) -> str:
    """Return a claim that one arm is above another, judged by the median of the paired differences."""
    differences = above - below
    return f"{verdict(is_above(differences)):<6} {claim:<66} {difference_text(differences, digits)}"
