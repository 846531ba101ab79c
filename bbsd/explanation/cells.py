"""Which cells of a behavior's table matter, and why the others do not."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.policy import decisions, own_cells
from bbsd.architecture.tidy import where_decisions_matter
from bbsd.explanation.words import CellKinds

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.architecture import Architecture, JointSpace
    from bbsd.architecture.visits import Visits

    Cells = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Cares:
    """For each cell of a behavior's own table, (n_cells,), whether it matters; the kinds exclude each other."""

    counts: Cells
    """The rules have to say what the table says."""
    covered: Cells
    """A higher layer always acts before."""
    impossible: Cells
    """They cannot occur, or not while the behavior is excited."""
    unasked: Cells
    """It could matter, and was never asked in the episodes looked at."""
    prevented_by: tuple[int, ...]
    """The behaviors that control in covered cells."""

    @property
    def by_tables(self) -> Cells:
        """The cells that matter as far as the tables tell, asked or not."""
        return self.counts | self.unasked

    @property
    def kinds(self) -> CellKinds:
        """The number of cells of each kind."""
        parts = (self.counts, self.covered, self.impossible, self.unasked)
        return CellKinds(*(int(np.count_nonzero(part)) for part in parts))


def cares_of(
    space: JointSpace,
    architecture: Architecture,
    possible: Cells | None,
    controller: NDArray[np.int64] | None,
    visits: Visits | None,
) -> list[Cares]:
    """Return what matters of each behavior, in the spec's order.

    A behavior that never could decide anything, or was never asked, is described by its table alone.

    Args:
        space: the joint space.
        architecture: tables and structure.
        possible: which joint cells may occur, of the shape `space.sizes`; None if nothing is known.
        controller: the controlling behavior in every joint cell, below 0 where there is none; None where the space is
            too large.
        visits: None where they are not known.
    """
    matters = (
        [np.ones(len(table), np.bool_) for table in architecture.tables]
        if controller is None
        else where_decisions_matter(space, architecture, possible)
    )
    return [
        _cares(
            matters[behavior],
            _occurring(space, behavior, len(table), possible),
            None if visits is None else visits.asked[behavior] > 0,
            _preventing(space, architecture, behavior, controller, matters[behavior]),
        )
        for behavior, table in enumerate(architecture.tables)
    ]


def _cares(matters: Cells, occurs: Cells, asked: Cells | None, prevented_by: tuple[int, ...]) -> Cares:
    if not matters.any():
        # It never decides anything: all of its table is of interest, or what can occur of it.
        occurs = occurs if occurs.any() else ~occurs
        return Cares(occurs, np.zeros_like(occurs), ~occurs, np.zeros_like(occurs), prevented_by)
    is_known = asked is not None and (asked & matters).any()
    unasked = matters & ~asked if asked is not None and is_known else np.zeros_like(matters)
    return Cares(matters & ~unasked, occurs & ~matters, ~occurs, unasked, prevented_by)


def _occurring(space: JointSpace, behavior: int, n_cells: int, possible: Cells | None) -> Cells:
    """Return in which of its cells a behavior may be excited."""
    if possible is None:
        return np.ones(n_cells, np.bool_)
    everywhere = decisions(space, behavior, np.ones(n_cells, np.uint8))
    own = np.broadcast_to(own_cells(space, behavior), space.sizes)
    return any_of(own[possible & (everywhere > 0)], n_cells)


def _preventing(
    space: JointSpace,
    architecture: Architecture,
    behavior: int,
    controller: NDArray[np.int64] | None,
    matters: Cells,
) -> tuple[int, ...]:
    """Return who controls where a behavior has an action that never counts; if all count, where it is excited."""
    table = architecture.tables[behavior]
    if controller is None or behavior not in architecture.structure or not table.any():
        return ()
    own = np.broadcast_to(own_cells(space, behavior), space.sizes).ravel()
    lost = ~matters[own] & (controller >= 0)
    for choices in (table, np.ones_like(table)):
        acts = np.broadcast_to(decisions(space, behavior, choices) > 0, space.sizes).ravel()
        if (acts & lost).any():
            return tuple(np.unique(controller[acts & lost]).tolist())
    return ()


def any_of(cells: NDArray[np.int64], n_cells: int) -> Cells:
    """Return for each of the cells (n_cells,) whether it is among some numbers."""
    return np.bincount(cells, minlength=n_cells) > 0


def in_order(structure: Sequence[int], behaviors: Sequence[int]) -> list[int]:
    """Return behaviors from the highest layer down."""
    return [behavior for behavior in reversed(structure) if behavior in behaviors]
