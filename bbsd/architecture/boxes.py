"""Tables as few boxes: a box is some cells of each input, and the first box that holds a cell decides it."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

Box = tuple[tuple[int, ...], ...]
"""For each input, the cells that belong to the box, in ascending order."""

KEEP = -1
"""A cell that no box may hold."""
FREE = -2
"""A cell that boxes may hold or not, since a box before them decides it."""

MAX_GREEDY_CELLS = 256
"""Cells of a table up to which it is covered greedily; the time of that grows faster than the table."""
MAX_SEEDS = 24
"""Undecided cells around which a box is grown to find the best one."""


def cover(values: NDArray[np.int64], sizes: Sequence[int]) -> list[tuple[Box, int]]:
    """Return boxes with their values, such that the first box that holds a cell has the cell's value.

    Small tables are covered greedily, the largest box first; larger ones are divided along one input after
    another, which takes a time proportional to their size.

    Args:
        values: (n_cells,) in row-major order of the inputs; 0 or more, KEEP or FREE.
        sizes: (n_inputs,), how many cells each input has.
    """
    if len(values) <= MAX_GREEDY_CELLS:
        return list(_greedy(values.tolist(), sizes))
    return list(_divide(values.reshape(tuple(sizes)), ()))


def first_match(boxes: Sequence[Box], sizes: Sequence[int]) -> NDArray[np.int64]:
    """Return for each cell (n_cells,) the index of the first box that holds it, -1 where none does."""
    indices = np.full(tuple(sizes), -1, np.int64)
    for index in reversed(range(len(boxes))):
        indices[np.ix_(*boxes[index])] = index
    return indices.ravel()


# Sets of cells are the bits of an integer: moving a box along an input is a shift.


def _greedy(values: list[int], sizes: Sequence[int]) -> Iterator[tuple[Box, int]]:
    free = _cells_with(FREE, values)
    wanted = {value: _cells_with(value, values) for value in sorted(set(values)) if value >= 0}
    while any(wanted.values()):
        value, box, cells = _best(values, wanted, free, sizes)
        yield box, value
        wanted[value] &= ~cells
        free |= cells


def _cells_with(value: int, values: list[int]) -> int:
    return sum(1 << cell for cell, cell_value in enumerate(values) if cell_value == value)


def _best(values: list[int], wanted: dict[int, int], free: int, sizes: Sequence[int]) -> tuple[int, Box, int]:
    """Return the box that decides most cells, of equals the shortest, of those grown from the first undecided cells."""
    undecided = sum(wanted.values())
    seeds = [cell for cell in range(len(values)) if undecided >> cell & 1][:MAX_SEEDS]
    boxes = [
        (values[seed], _grow(seed, wanted[values[seed]], free, sizes, order))
        for seed in seeds
        for order in _orders(len(sizes))
    ]
    candidates = [(value, box, _cells_in(box, sizes)) for value, box in dict.fromkeys(boxes)]

    def worth(candidate: tuple[int, Box, int]) -> tuple[int, int]:
        value, box, cells = candidate
        return (cells & wanted[value]).bit_count(), -n_words(box, sizes)

    return max(candidates, key=worth)


def _orders(n_inputs: int) -> list[tuple[int, ...]]:
    """Return orders in which a box may grow, each input first in two of them; up to three inputs these are all."""
    forward = [tuple((first + step) % n_inputs for step in range(n_inputs)) for first in range(n_inputs)]
    return list(dict.fromkeys([*forward, *(order[::-1] for order in forward)])) or [()]


def _grow(seed: int, wanted: int, free: int, sizes: Sequence[int], order: Sequence[int]) -> Box:
    """Return the box around a cell that takes in all it can along one input after another."""
    cells, strides, allowed = 1 << seed, _strides(sizes), wanted | free
    chosen: list[tuple[int, ...]] = [()] * len(sizes)
    for axis in order:
        origin = cells >> (seed // strides[axis] % sizes[axis] * strides[axis])
        slabs = [origin << (index * strides[axis]) for index in range(sizes[axis])]
        chosen[axis] = tuple(index for index, slab in enumerate(slabs) if slab & allowed == slab)
        cells = sum(slabs[index] for index in chosen[axis])
    return _trim(tuple(chosen), cells & wanted, sizes)


def _trim(box: Box, fresh: int, sizes: Sequence[int]) -> Box:
    """Return the box without cells for which it decides nothing, of inputs that have to be named anyway."""
    strides = _strides(sizes)
    held = [cell for cell in range(fresh.bit_length()) if fresh >> cell & 1]
    needed = [{cell // strides[axis] % size for cell in held} for axis, size in enumerate(sizes)]
    return tuple(
        chosen if len(chosen) == size else tuple(sorted(needed[axis]))
        for axis, (chosen, size) in enumerate(zip(box, sizes, strict=True))
    )


def _strides(sizes: Sequence[int]) -> list[int]:
    return [prod(sizes[axis + 1 :]) for axis in range(len(sizes))]


def _cells_in(box: Box, sizes: Sequence[int]) -> int:
    cells = 1
    for chosen, stride in zip(box, _strides(sizes), strict=True):
        cells = sum(cells << (index * stride) for index in chosen)
    return cells


def n_words(box: Box, sizes: Sequence[int]) -> int:
    """Return the length of a box in words: one for its decision, and one for each cell that has to be named."""
    return 1 + sum(len(chosen) for chosen, size in zip(box, sizes, strict=True) if len(chosen) < size)


def _divide(values: NDArray[np.int64], chosen: Box) -> Iterator[tuple[Box, int]]:
    """Yield boxes that do not overlap: cells of the first input with equal parts of the table go together."""
    if values.ndim == 0:
        if values >= 0:
            yield chosen, int(values)
        return
    groups: dict[bytes, list[int]] = {}
    for index, part in enumerate(values):
        groups.setdefault(part.tobytes(), []).append(index)
    for group in groups.values():
        yield from _divide(values[group[0], ...], (*chosen, tuple(group)))
