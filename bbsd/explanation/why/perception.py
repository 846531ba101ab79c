"""The smallest change of what a robot perceives after which it would have acted otherwise."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from math import prod
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.architecture import Architecture, JointSpace
    from bbsd.explanation.why.situation import Situation

MOST_WITHOUT_ALL = 2
"""Inputs that are changed together where the joint space is too large to go through."""
MOST_CELLS_OF_A_CHANGE = 4_000_000
"""Cells of the inputs that are changed together; a larger combination is left out."""


@dataclass(frozen=True, slots=True)
class InputChange:
    """Another cell of an input, by labels; `distance` is how many cells away it is in the spec's order."""

    input: str
    was: str
    becomes: str
    distance: int


@dataclass(frozen=True, slots=True)
class Perception:
    """The smallest change of inputs, of several the one that is nearest, of these the first in the spec's order."""

    changes: tuple[InputChange, ...]
    """Empty where no change was found."""
    act: int
    """The number of the act that would have controlled then."""
    equally_small: int
    """How many changes of as many inputs there are, this one included."""
    tried: str
    """`all` joint cells; or `pairs`, single inputs and pairs of inputs; or `some pairs`, where cells are too many."""

    @property
    def is_found(self) -> bool:
        """Whether there is such a change."""
        return bool(self.changes)


def joint_cell(space: JointSpace, situation: Situation) -> tuple[int, ...]:
    """Return the index in every dimension of the joint space."""
    cell = [0] * len(space.dimensions)
    for projection, own, excited in zip(space.projections, situation.cells, situation.excited, strict=True):
        places = np.unravel_index(own, projection.sizes) if projection.sizes else ()
        for axis, place in zip(projection.axes, places, strict=True):
            cell[axis] = int(place)
        if projection.excitement is not None:
            cell[projection.excitement] = projection.excited_at if excited else 1 - projection.excited_at
    return tuple(cell)


def acts_around(
    space: JointSpace, architecture: Architecture, cell: Sequence[int], free: Sequence[int]
) -> NDArray[np.uint16]:
    """Return the numbers of the acts where the dimensions `free` take every value and the others are those of a cell.

    The result has a dimension for each of them, of its size.
    """
    sizes = [space.sizes[axis] for axis in free]
    mesh: dict[int, NDArray[np.int64]] = dict(zip(free, np.ogrid[tuple(map(slice, sizes))], strict=True))

    def at(axis: int) -> NDArray[np.int64] | int:
        return mesh.get(axis, cell[axis])

    control = np.zeros(sizes, np.uint16)
    for behavior in architecture.structure.tolist():
        projection = space.projections[behavior]
        own: NDArray[np.int64] | int = 0
        for axis, size in zip(projection.axes, projection.sizes, strict=True):
            own = own * size + at(axis)
        wishes = architecture.tables[behavior][own].astype(np.int64)
        excited = (
            projection.excited_at == 1
            if projection.excitement is None
            else at(projection.excitement) == projection.excited_at
        )
        control = np.where((wishes > 0) & excited, wishes + space.first_actions[behavior], control)
    return control.astype(np.uint16)


def nearest_perception(
    space: JointSpace,
    architecture: Architecture,
    cell: Sequence[int],
    wanted: Sequence[int],
    possible: NDArray[np.bool_] | None = None,
) -> Perception:
    """Return the smallest change of a joint cell after which one of the wanted acts, given by numbers, controls.

    None of them controls in the cell itself. Of a small space only joint cells count that are `possible`, an array of
    the shape `space.sizes`; without it every combination of cells counts, also one that cannot occur.
    """
    dimensions = range(len(space.dimensions))
    if space.is_small:
        found = _nearest(space, architecture, cell, dimensions, wanted, possible=possible)
        return _perception(space, cell, [] if found is None else [found], "all")
    tried = "pairs"
    for n_changed in range(1, MOST_WITHOUT_ALL + 1):
        candidates = list[_Nearest]()
        for free in combinations(dimensions, n_changed):
            if prod(space.sizes[axis] for axis in free) > MOST_CELLS_OF_A_CHANGE:
                tried = "some pairs"
            elif found := _nearest(space, architecture, cell, free, wanted, n_changed):
                candidates.append(found)
        if candidates:
            break
    return _perception(space, cell, candidates, tried)


class _Nearest(NamedTuple):
    """Of the cells with the fewest changes in a part of the joint space, the nearest; and how many there are."""

    n_changed: int
    distance: int
    cell: tuple[int, ...]
    act: int
    equally_small: int


def _nearest(
    space: JointSpace,
    architecture: Architecture,
    cell: Sequence[int],
    free: Sequence[int],
    wanted: Sequence[int],
    n_changed: int | None = None,
    possible: NDArray[np.bool_] | None = None,
) -> _Nearest | None:
    """Return the nearest wanted cell in some dimensions, with the fewest changes, or with exactly so many."""
    acts = acts_around(space, architecture, cell, free)
    mesh = np.ogrid[tuple(slice(space.sizes[axis]) for axis in free)]
    offsets = [np.abs(places - cell[axis]) for axis, places in zip(free, mesh, strict=True)]
    changed = sum((offset > 0 for offset in offsets), np.zeros(acts.shape, np.int64))
    wanted_there = np.isin(acts, wanted) & (changed > 0)
    if possible is not None:
        wanted_there &= possible
    fewest = n_changed or int(changed[wanted_there].min(initial=len(free) + 1))
    wanted_there &= changed == fewest
    if not wanted_there.any():
        return None
    distances = sum(offsets, np.zeros(acts.shape, np.int64))
    distances = np.where(wanted_there, distances, np.iinfo(np.int64).max)
    best = np.unravel_index(int(distances.argmin()), acts.shape)
    there = [*cell]
    for axis, place in zip(free, best, strict=True):
        there[axis] = int(place)
    return _Nearest(
        fewest, int(distances[best]), tuple(there), int(acts[best]), int(np.count_nonzero(wanted_there))
    )


def _perception(
    space: JointSpace, cell: Sequence[int], candidates: Sequence[_Nearest], tried: str
) -> Perception:
    if not candidates:
        return Perception((), 0, 0, tried)
    best = min(candidates)
    changes = [
        InputChange(name, labels[was], labels[becomes], abs(becomes - was))
        for (name, labels), was, becomes in zip(space.dimensions.items(), cell, best.cell, strict=True)
        if was != becomes
    ]
    return Perception(tuple(changes), best.act, sum(each.equally_small for each in candidates), tried)
