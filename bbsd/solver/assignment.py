"""The linear assignment problem by shortest augmenting paths (Jonker and Volgenant 1987)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.jit import jit

if TYPE_CHECKING:
    from numpy.typing import NDArray

NONE = -1


@jit
def assign(costs: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return a column for each row, no column twice, with the least sum of costs.

    Args:
        costs: (n_rows, n_columns), finite, n_rows <= n_columns.

    Returns:
        (n_rows,) column indices.
    """
    n_rows, n_columns = costs.shape
    prices = np.zeros(n_columns)
    distances = np.empty(n_columns)
    owners = np.empty(n_columns, np.int64)  # the row that has each column
    previous = np.empty(n_columns, np.int64)  # the column before each one on its path
    reached = np.empty(n_columns, np.bool_)
    for column in range(n_columns):
        owners[column] = NONE
    for row in range(n_rows):
        column = shortest_path(costs, row, prices, distances, owners, previous, reached)
        while previous[column] != NONE:
            owners[column] = owners[previous[column]]
            column = previous[column]
        owners[column] = row
    chosen = np.zeros(n_rows, np.int64)
    for column in range(n_columns):
        if owners[column] != NONE:
            chosen[owners[column]] = column
    return chosen


@jit
def shortest_path(
    costs: NDArray[np.float64],
    row: int,
    prices: NDArray[np.float64],
    distances: NDArray[np.float64],
    owners: NDArray[np.int64],
    previous: NDArray[np.int64],
    reached: NDArray[np.bool_],
) -> int:
    """Return the free column at the end of the cheapest path on which the row displaces one owner after another.

    Args:
        costs: (n_rows, n_columns).
        row: the row that gets a column.
        prices: (n_columns,), kept such that each owner has the column that is cheapest for it; changed.
        distances, previous, reached: (n_columns,), filled.
        owners: (n_columns,).
    """
    n_columns = len(prices)
    for column in range(n_columns):
        distances[column] = np.inf
        previous[column] = NONE
        reached[column] = False
    nearest = NONE
    start = 0.0
    length = 0.0
    for _ in range(n_columns):  # bounded, so that not even a NaN makes it endless
        before, nearest, length = nearest, 0, np.inf
        for column in range(n_columns):
            if not reached[column]:
                distance = start + costs[row, column] - prices[column]
                if distance < distances[column]:
                    distances[column] = distance
                    previous[column] = before
                if distances[column] < length:
                    length = distances[column]
                    nearest = column
        if owners[nearest] == NONE:
            break
        reached[nearest] = True
        row = owners[nearest]
        start = length - (costs[row, nearest] - prices[nearest])
    for column in range(n_columns):
        if reached[column]:
            prices[column] += distances[column] - length
    return nearest
