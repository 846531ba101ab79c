"""How the robots' time is divided among behaviors: excited, activated, suppressed, in control, and by which rule."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.architecture.deciding import cells_at, excited_at

if TYPE_CHECKING:
    from bbsd.architecture import Architecture, JointSpace
    from bbsd.evaluation.situations import Situations


@dataclass(frozen=True, slots=True, eq=False)
class Activity:
    """The shares of all robot-steps in which a behavior was excited, activated and in control.

    `by_cell` (n_cells,) divides its control among the cells of its table.
    """

    excited: float
    activated: float
    by_cell: npt.NDArray[np.float64]

    @property
    def control(self) -> float:
        """The share of robot-steps in which it controlled."""
        return float(self.by_cell.sum())

    @property
    def suppressed(self) -> float:
        """The share in which it was activated, and a higher layer controlled."""
        return max(0.0, self.activated - self.control)


def activities(space: JointSpace, architecture: Architecture, met: Situations) -> dict[int, Activity]:
    """Return the activity of each behavior of the structure in the situations that the design met."""
    is_free, total = np.ones(len(met.cells), np.bool_), float(met.steps)
    found = {}
    for behavior in architecture.structure[::-1].tolist():
        cells, excited = cells_at(space, behavior, met.cells), excited_at(space, behavior, met.cells)
        table = architecture.tables[behavior]
        activated = excited & (table[cells] > 0)
        controls = np.where(activated & is_free, met.visits, 0)
        found[behavior] = Activity(
            float(met.visits[excited].sum()) / total,
            float(met.visits[activated].sum()) / total,
            np.bincount(cells, weights=controls, minlength=len(table)) / total,
        )
        is_free &= ~activated
    return found
