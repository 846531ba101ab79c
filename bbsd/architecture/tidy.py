"""Cells that never matter, set so that the rules become short.

Evolution leaves random decisions in the cells in which a behavior never controls, because a layer above always does.
Whatever they hold, the agent does the same in every joint cell.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.architecture import Architecture
from bbsd.architecture.policy import decisions, joint_space, own_cells
from bbsd.architecture.rules import boxes_of, most_common
from bbsd.language.meaning.tables.table import NO_ACTION, OPEN_CELL

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.architecture.policy import JointSpace
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module


def tidy_tables(meaning: Meaning, architecture: Architecture) -> Architecture:
    """Return an architecture that does the same in every joint cell, with rules that are not longer; given cells stay.

    Where the joint space is too large to go through, the architecture itself is returned.
    """
    space = joint_space(meaning)
    if not space.is_small:
        return architecture
    matters = where_decisions_matter(space, architecture)
    tables = tuple(
        _shortest(module, table, cells)
        for module, table, cells in zip(meaning.episode.modules, architecture.tables, matters, strict=True)
    )
    return Architecture(tables, architecture.structure)


def where_decisions_matter(
    space: JointSpace, architecture: Architecture, possible: NDArray[np.bool_] | None = None
) -> list[NDArray[np.bool_]]:
    """Return for each behavior which of its cells (n_cells,) decide the action in some joint cell.

    If `possible`, of the shape `space.sizes`, is given, only joint cells count that may occur.
    """
    matters = [np.zeros(len(table), np.bool_) for table in architecture.tables]
    controlled = np.zeros(space.sizes, np.bool_) if possible is None else ~possible
    for behavior in reversed(architecture.structure.tolist()):
        table = architecture.tables[behavior]
        excited = decisions(space, behavior, np.ones_like(table)) > 0
        cells = np.broadcast_to(own_cells(space, behavior), space.sizes)
        matters[behavior][np.unique(cells[excited & ~controlled])] = True
        controlled = controlled | (decisions(space, behavior, table) > 0)
    return matters


def _shortest(module: Module, table: NDArray[np.uint8], matters: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Return the table as it is, or with one decision in all cells that do not matter, whichever has fewer rules."""
    free = ~matters & (np.frombuffer(module.table.given, np.uint8) == OPEN_CELL)
    if not free.any():
        return table
    common = np.uint8(most_common(table[matters])) if matters.any() else np.uint8(NO_ACTION)
    tidy = np.where(free, common, table)
    lengths = [len(boxes_of(candidate, module.inputs)[0]) for candidate in (tidy, table)]
    return tidy if lengths[0] <= lengths[1] else table
