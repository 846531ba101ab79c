"""Sums that are rounded once: the same bits for any order, any batch and any machine (Shewchuk 1997, by `math.fsum`).

NumPy's own sums add in an order that depends on the layout of an array and may depend on the processor.
"""

from __future__ import annotations

from math import fsum, sqrt
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def mean(values: NDArray[np.float64]) -> float:
    """Return the mean of values (n,)."""
    return fsum(values.tolist()) / len(values)


def deviation(values: NDArray[np.float64]) -> float:
    """Return the standard deviation of a sample (n,), n at least 2."""
    return sqrt(fsum(((values - mean(values)) ** 2).tolist()) / (len(values) - 1))


def expectation(weights: NDArray[np.float64], values: NDArray[np.float64]) -> float:
    """Return the mean of values (n,) with weights (n,), which need not sum to 1."""
    return fsum((weights * values).tolist()) / fsum(weights.tolist())


def column_sums(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the sum of each column of (n, k); (k,)."""
    return np.array([fsum(column) for column in values.T.tolist()])


def row_means(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the mean of each row of (n, k); (n,)."""
    return np.array([mean(row) for row in values])
