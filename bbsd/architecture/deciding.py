"""Who decides what in some situations of a joint space, however large it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from bbsd.architecture.architecture import Architecture
    from bbsd.architecture.policy import JointSpace

    Cells = NDArray[np.int64]
    """Situations (n, n_dimensions): the index of each dimension's cell."""


def cells_at(space: JointSpace, behavior: int, cells: Cells) -> Cells:
    """Return the cell of a behavior's own table in situations, (n,)."""
    projection, own = space.projections[behavior], np.zeros(len(cells), np.int64)
    for axis, size in zip(projection.axes, projection.sizes, strict=True):
        own = own * size + cells[:, axis]
    return own


def excited_at(space: JointSpace, behavior: int, cells: Cells) -> NDArray[np.bool_]:
    """Return whether a behavior is excited in situations, (n,)."""
    projection = space.projections[behavior]
    if projection.excitement is None:
        return np.full(len(cells), projection.excited_at == 1)
    is_excited: NDArray[np.bool_] = cells[:, projection.excitement] == projection.excited_at
    return is_excited


def policy_at(space: JointSpace, architecture: Architecture, cells: Cells) -> Cells:
    """Return the number of the controlling action in situations, (n,), as `policy` does; 0 where nobody controls."""
    numbers = np.zeros(len(cells), np.int64)
    for behavior, asked in asked_at(space, architecture, cells):
        choices = architecture.tables[behavior][cells_at(space, behavior, cells)].astype(np.int64)
        numbers = np.where(asked & (choices > 0), choices + space.first_actions[behavior], numbers)
    return numbers


def asked_at(
    space: JointSpace, architecture: Architecture, cells: Cells
) -> Iterator[tuple[int, NDArray[np.bool_]]]:
    """Yield the behaviors from the highest layer down, and where each is asked: it is excited, and no higher one acts.

    A behavior's decision in a situation matters only where it is asked.
    """
    is_free = np.ones(len(cells), np.bool_)
    for behavior in architecture.structure[::-1].tolist():
        asked = is_free & excited_at(space, behavior, cells)
        yield behavior, asked
        is_free &= ~(asked & (architecture.tables[behavior][cells_at(space, behavior, cells)] > 0))
