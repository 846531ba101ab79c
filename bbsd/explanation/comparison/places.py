"""Where something happens, in few conditions: they tell situations apart only from others that were met.

However large the joint space is, robots meet a small part of it, and of the rest nothing has to be said.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.explanation.conditions import condition_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from bbsd.architecture.boxes import Box
    from bbsd.language.meaning.tables.table import Inputs

    Rows = NDArray[np.int64]
    """Situations (n, n_dimensions): the index of each dimension's cell."""

MOST = 6
"""Conditions at most."""
SEEDS = 2
"""Situations around which each condition is sought: those met most often."""


class Places(NamedTuple):
    """Conditions, none of which holds in any other situation that was met; `left` situations fulfill none of them."""

    where: tuple[str, ...]
    left: int


def places(cells: Rows, which: NDArray[np.bool_], visits: NDArray[np.int64], dimensions: Inputs) -> Places:
    """Return where some of the situations that were met are.

    Args:
        cells: all situations that were met, each once or several times.
        which: those that are meant, (n,).
        visits: how often each was met, (n,).
        dimensions: the names and cells of the columns.
    """
    if not dimensions:
        return Places(("",), 0) if which.any() else Places((), 0)
    boxes = boxes_of(cells, which, visits, [len(labels) for labels in dimensions.values()])
    left = which.copy()
    for box in boxes:
        left &= ~inside(box, cells)
    return Places(
        tuple(condition_text(box, dimensions) for box in boxes), len(np.unique(cells[left], axis=0))
    )


def boxes_of(
    cells: Rows, which: NDArray[np.bool_], visits: NDArray[np.int64], sizes: Sequence[int]
) -> list[Box]:
    """Return boxes that hold some of the meant situations, most visits first, and no other one that was met."""
    meant, others = cells[which], cells[~which]
    boxes: list[Box] = []
    left = np.where(visits[which] > 0, visits[which], 0)
    while left.any() and len(boxes) < MOST:
        box = _best(meant, left, others, sizes)
        left[inside(box, meant)] = 0
        boxes.append(box)
    return boxes


def inside(box: Box, rows: Rows) -> NDArray[np.bool_]:
    """Return which situations a box holds, (n,)."""
    is_in: NDArray[np.bool_] = np.all(
        [np.isin(rows[:, axis], cells) for axis, cells in enumerate(box)], axis=0
    )
    return is_in


def _best(meant: Rows, visits: NDArray[np.int64], others: Rows, sizes: Sequence[int]) -> Box:
    """Return the box that holds most visits, of equals the one that names the fewest inputs."""
    seeds = [seed for seed in np.argsort(-visits, kind="stable")[:SEEDS].tolist() if visits[seed]]
    boxes = [
        _grown(meant[seed], meant, others, sizes, order)
        for seed in seeds
        for order in (range(len(sizes)), range(len(sizes))[::-1])
    ]

    def worth(box: Box) -> tuple[int, int]:
        named = sum(len(chosen) < size for chosen, size in zip(box, sizes, strict=True))
        return int(visits[inside(box, meant)].sum()), -named

    return max(boxes, key=worth)


def _grown(seed: Rows, meant: Rows, others: Rows, sizes: Sequence[int], order: Iterable[int]) -> Box:
    """Return the box around a situation that takes in all it can along one input after another, and no other one."""
    chosen = [np.arange(size) == cell for size, cell in zip(sizes, seed.tolist(), strict=True)]
    apart = np.stack([~taken[others[:, axis]] for axis, taken in enumerate(chosen)], axis=1)
    distance = apart.sum(axis=1)
    for axis in order:
        # Another situation keeps a cell out if this input alone tells it from the box.
        kept_out = others[apart[:, axis] & (distance == 1), axis]
        chosen[axis][:] = True
        chosen[axis][kept_out] = False
        now = ~chosen[axis][others[:, axis]]
        distance += now.astype(np.int64) - apart[:, axis]
        apart[:, axis] = now
    return _needed(chosen, meant)


def _needed(chosen: Sequence[NDArray[np.bool_]], meant: Rows) -> Box:
    """Return a box without the cells of inputs that have to be named in which nothing that is meant lies."""
    held = meant[np.all([taken[meant[:, axis]] for axis, taken in enumerate(chosen)], axis=0)]
    return tuple(
        tuple(range(len(taken))) if taken.all() else tuple(sorted(set(held[:, axis].tolist())))
        for axis, taken in enumerate(chosen)
    )
