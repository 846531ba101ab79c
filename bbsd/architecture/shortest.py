"""The shortest rules of a table, by words: a shortest path over the sets of cells that are still undecided.

The cost of a list of rules is the words of its boxes (`n_words`): one for each decision, and one for each cell that has
to be named. A list without cells that no box may hold ends with a box that holds everything, the rule `otherwise`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.architecture.boxes import FREE, KEEP, MAX_GREEDY_CELLS, cover, n_words
from bbsd.language.meaning.tables.table import NO_ACTION

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.architecture.boxes import Box

    Masks = NDArray[np.uint32]
    """Sets of cells that have to be decided, a bit for each."""

MOST_DECIDED = 16
"""Cells to decide, of which those that rules need not tell apart count once, up to which the shortest list is found."""
MOST_CELLS = 10_000
"""Cells of a table up to which it is looked at more closely."""
MOST_BOXES = 4096
MOST_KEPT = 256
"""Boxes, and cells that no box may hold, up to which the shortest list is found."""
MOST_WORK = 8_000_000
"""Boxes tried, counted for each set of undecided cells, before the search gives up: some tenths of a second."""
WORD, SAYS_NOTHING, UNUSUAL = 256, 4, 1
"""What a word costs, and, to choose among lists with equally many words, what is better avoided: No Action before the
last rule, and a last rule that does not say the most common decision."""


class RuleList(NamedTuple):
    """Boxes with their values, the first that holds a cell decides it; and whether no list has fewer words."""

    boxes: list[tuple[Box, int]]
    is_shortest: bool


class Axis(NamedTuple):
    """What rules tell apart along an input: groups of cells with the same column of values."""

    groups: tuple[tuple[int, ...], ...]
    size: int


class Boxes(NamedTuple):
    """Boxes that decide different cells, the cheapest of each set."""

    masks: Masks
    costs: NDArray[np.int64]
    """Words."""
    chosen: NDArray[np.int64]
    """The number of the subset of groups of each input, (n_boxes, n_inputs)."""


def rule_list(values: NDArray[np.int64], sizes: Sequence[int]) -> RuleList:
    """Return rules for the cells whose values are 0 or more; the last one holds everything.

    Args:
        values: (n_cells,) in row-major order of the inputs; 0 or more, or FREE where any decision will do.
        sizes: (n_inputs,), how many cells each input has.
    """
    everything = tuple(tuple(range(size)) for size in sizes)
    wanted = values[values >= 0]
    if not wanted.size or (wanted == wanted[0]).all():  # one rule for all: nothing is shorter
        return RuleList([(everything, int(wanted[0]) if wanted.size else NO_ACTION)], is_shortest=True)
    default = int(np.bincount(wanted).argmax())
    others = np.where(values == default, KEEP, values)
    greedy = [*cover(others, sizes), (everything, default)]
    return _shorter(values, sizes, greedy)


def shortest_cover(values: NDArray[np.int64], sizes: Sequence[int]) -> RuleList:
    """Return boxes for the cells whose values are 0 or more, none of which holds a cell with the value KEEP.

    Arguments are those of `cover`, which gives the boxes where the table is too large for the shortest list.
    """
    return _shorter(values, sizes, cover(values, sizes))


def unordered_cover(values: NDArray[np.int64], sizes: Sequence[int]) -> list[tuple[Box, int]]:
    """Return boxes as `shortest_cover` does that can be read in any order: those that overlap have the same value."""
    if len(values) > MAX_GREEDY_CELLS:
        return cover(values, sizes)  # these boxes do not overlap
    return [
        box
        for value in np.unique(values[values >= 0]).tolist()
        for box in shortest_cover(np.where((values >= 0) & (values != value), KEEP, values), sizes).boxes
    ]


def _shorter(values: NDArray[np.int64], sizes: Sequence[int], greedy: list[tuple[Box, int]]) -> RuleList:
    """Return the shortest boxes, or those given where the search is too long."""
    most = sum(n_words(box, sizes) for box, _ in greedy)
    shortest = _shortest(values.reshape(tuple(sizes)), most)
    return RuleList(greedy, is_shortest=False) if shortest is None else RuleList(shortest, is_shortest=True)


def _shortest(values: NDArray[np.int64], most: int) -> list[tuple[Box, int]] | None:
    """Return the boxes of fewest words, at most `most`; None where the table is too large."""
    if not (values >= 0).any():
        return []
    if values.size > MOST_CELLS:
        return None
    axes = tuple(_axis(values, axis) for axis in range(values.ndim))
    reduced = values[np.ix_(*([group[0] for group in axis.groups] for axis in axes))]
    cells = np.argwhere(reduced >= 0)
    if len(cells) > MOST_DECIDED or np.count_nonzero(reduced == KEEP) > MOST_KEPT:
        return None
    if np.prod([2.0 ** len(axis.groups) - 1 for axis in axes]) > MOST_BOXES:
        return None
    usual = int(np.bincount(values[values >= 0]).argmax())
    boxes = _boxes(axes, cells, np.argwhere(reduced == KEEP))
    path = _cheapest_path(boxes, reduced[reduced >= 0], usual, most)
    if path is None:
        return None
    return [(_box(axes, boxes.chosen[box]), value) for box, value in path]


def _axis(values: NDArray[np.int64], axis: int) -> Axis:
    """Return the cells of an input in groups of equal columns, without those whose columns are free as a whole.

    A shortest list need not tell the cells of a group apart: of the two lists that treat both cells as one of them, one
    is not longer. Cells that are free throughout belong to a box if all others do.
    """
    groups: dict[bytes, list[int]] = {}
    for index, column in enumerate(np.moveaxis(values, axis, 0)):
        if (column != FREE).any():
            groups.setdefault(np.ascontiguousarray(column).tobytes(), []).append(index)
    return Axis(tuple(tuple(group) for group in groups.values()), values.shape[axis])


def _boxes(axes: Sequence[Axis], cells: NDArray[np.int64], kept: NDArray[np.int64]) -> Boxes:
    """Return the boxes that hold some of `cells` and none of `kept`, both (n, n_inputs)."""
    masks, costs = np.array([(1 << len(cells)) - 1], np.uint32), np.ones(1, np.int64)
    holds_kept, chosen = np.ones((1, len(kept)), np.bool_), np.zeros((1, 0), np.int64)
    for index, axis in enumerate(axes):
        subsets = np.arange(1, 1 << len(axis.groups))
        bits = subsets[:, None] >> np.arange(len(axis.groups)) & 1
        words = (bits * [len(group) for group in axis.groups]).sum(1) * (subsets != subsets[-1])
        masks = _crossed(masks, _masks_of(bits[:, cells[:, index]]), np.bitwise_and)
        costs = _crossed(costs, words, np.add)
        holds_kept = (holds_kept[:, None] & (bits[:, kept[:, index]] > 0)[None]).reshape(
            len(masks), len(kept)
        )
        pairs = [np.repeat(chosen, len(subsets), axis=0), np.tile(subsets, len(chosen))[:, None]]
        chosen = np.concatenate(pairs, axis=1)
    useful = np.flatnonzero((masks > 0) & ~holds_kept.any(1))
    cheapest = useful[np.lexsort((useful, costs[useful], masks[useful]))]
    _, first = np.unique(masks[cheapest], return_index=True)
    kinds = cheapest[first]
    return Boxes(masks[kinds], costs[kinds], chosen[kinds])


def _crossed(left: NDArray, right: NDArray, combine: np.ufunc) -> NDArray:  # type: ignore[type-arg]
    return combine.outer(left, right).ravel()


def _masks_of(bits: NDArray[np.int64]) -> Masks:
    """Return rows of bits, (n, n_cells), as sets of cells."""
    sets: Masks = (bits << np.arange(bits.shape[1])).sum(1).astype(np.uint32)
    return sets


def _cheapest_path(
    boxes: Boxes, wanted: NDArray[np.int64], usual: int, most: int
) -> list[tuple[int, int]] | None:
    """Return the numbers of the boxes with their values; None where the search is too long.

    The A* algorithm, a whole level of equal estimates at once: from all cells undecided to none. Of lists with equally
    many words it prefers one that says No Action only in its last rule, and there what is `usual`.
    """
    values = np.unique(wanted)
    holding = _masks_of((wanted == values[:, None]).astype(np.int64))
    n_sets, bound = 1 << len(wanted), (most + 1) * WORD
    at_least = _least_words(np.arange(n_sets, dtype=np.uint32), holding) * WORD
    best = np.full(n_sets, bound, np.int64)
    estimates = np.full(n_sets, bound, np.int64)
    came_from, by_box = np.zeros(n_sets, np.uint32), np.zeros(n_sets, np.int64)
    best[-1], estimates[-1], work = 0, at_least[-1], 0
    while (level := estimates.min()) < bound:
        present = np.flatnonzero(estimates == level).astype(np.uint32)
        if present[0] == 0:
            return _path(boxes, came_from, by_box, [*zip(holding.tolist(), values.tolist(), strict=True)])
        work += len(present) * len(boxes.masks)
        if work > MOST_WORK:
            break
        decided = present[:, None] & boxes.masks
        of_value = [(decided & ~mask) == 0 for mask in holding]
        rows, columns = np.nonzero((decided > 0) & np.any(of_value, axis=0))
        left = present[rows] & ~decided[rows, columns]
        says_nothing = (values[0] == NO_ACTION) & of_value[0][rows, columns] & (left > 0)
        is_unusual = (left == 0) & ~of_value[int(np.searchsorted(values, usual))][rows, columns]
        costs = (
            best[present[rows]]
            + boxes.costs[columns] * WORD
            + says_nothing * SAYS_NOTHING
            + is_unusual * UNUSUAL
        )
        is_better = (costs < best[left]) & (costs + at_least[left] < bound)
        rows, columns, left, costs = (each[is_better] for each in (rows, columns, left, costs))
        np.minimum.at(best, left, costs)
        chosen = np.flatnonzero(costs == best[left])[::-1]  # of several the first is kept, written last
        came_from[left[chosen]], by_box[left[chosen]] = present[rows[chosen]], columns[chosen]
        estimates[present] = bound
        estimates[left] = best[left] + at_least[left]
    return None


def _least_words(undecided: Masks, holding: Masks) -> NDArray[np.int64]:
    """Return a number of words that any rules for some undecided cells have at least.

    Each value needs a rule, and all rules but the last name a cell.
    """
    n_values: NDArray[np.int64] = np.stack([(undecided & mask) > 0 for mask in holding]).sum(0)
    return np.maximum(2 * n_values - 1, 0)


def _path(
    boxes: Boxes, came_from: Masks, by_box: NDArray[np.int64], holding: Sequence[tuple[int, int]]
) -> list[tuple[int, int]]:
    undecided, steps, everything = 0, [], len(came_from) - 1
    while undecided != everything:
        before, box = int(came_from[undecided]), int(by_box[undecided])
        decided = before & int(boxes.masks[box])
        steps.append((box, next(value for mask, value in holding if decided & ~mask == 0)))
        undecided = before
    return steps[::-1]


def _box(axes: Sequence[Axis], chosen: NDArray[np.int64]) -> Box:
    """Return a box of groups as one of cells; all groups are the whole input."""
    return tuple(
        tuple(range(axis.size))
        if subset == (1 << len(axis.groups)) - 1
        else tuple(
            sorted(cell for index, group in enumerate(axis.groups) if subset >> index & 1 for cell in group)
        )
        for axis, subset in zip(axes, chosen.tolist(), strict=True)
    )
