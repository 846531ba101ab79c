"""Single changes of a design: another choice in one cell, or another place for one behavior.

They are named by a number each, so that few of many need not be written out as designs.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.solver.space import Designs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.solver.space import Space


@dataclass(frozen=True, eq=False)
class Changes:
    """All single changes of a design: of its cells first, then of its order."""

    design: Designs
    cells: NDArray[np.int64]
    """The cell that each of the first changes alters, (n_cell_changes,)."""
    choices: NDArray[np.uint8]
    """What it then holds, (n_cell_changes,)."""
    orders: NDArray[np.int64]
    """The structures of the other changes, (n_order_changes, n_layers)."""

    def __len__(self) -> int:
        return len(self.cells) + len(self.orders)

    def applied(self, which: NDArray[np.int64]) -> Designs:
        """Return the design after each of some changes by itself, (len(which),)."""
        return self._applied(which, [slice(row, row + 1) for row in range(len(which))])

    def applied_together(self, which: NDArray[np.int64]) -> Designs:
        """Return the design after the first of some changes, after the first two, and so on, (len(which),)."""
        return self._applied(which, [slice(row, None) for row in range(len(which))])

    def _applied(self, which: NDArray[np.int64], rows: list[slice]) -> Designs:
        tables = np.repeat(self.design.tables, len(which), axis=0)
        structures = np.repeat(self.design.structures, len(which), axis=0)
        for index, altered in zip(which.tolist(), rows, strict=True):
            if index < len(self.cells):
                tables[altered, self.cells[index]] = self.choices[index]
            else:
                structures[altered] = self.orders[index - len(self.cells)]
        return Designs(tables, structures)

    def compatible(self, which: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return those of some changes that can be made together: the first of each cell, and the first order."""
        altered = np.full(len(which), -1)
        of_cells = which < len(self.cells)
        altered[of_cells] = self.cells[which[of_cells]]
        _, first = np.unique(altered, return_index=True)
        return which[np.sort(first)]


def changes_of(space: Space, design: Designs) -> Changes:
    """Return all single changes of one design within a space."""
    (table,), (structure,) = design.tables, design.structures
    others = space.choices[space.open_cells] - 1
    cells = np.repeat(space.open_cells, others)
    ranks = np.arange(len(cells)) - np.repeat(np.cumsum(others) - others, others)
    choices = (ranks + (ranks >= table[cells])).astype(np.uint8)
    orders = space.neighboring_orders(structure)
    return Changes(design, cells, choices, np.array(orders, np.int64).reshape(len(orders), len(structure)))
