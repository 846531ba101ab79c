"""How often the cells of behaviors were asked, and how often they controlled, in some episodes of a design."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Visits:
    """Counts of each behavior's cells, (n_cells,), in the spec's order; the counts are steps of single robots.

    A cell is asked where its behavior is excited and no higher one acts: only then does what it holds matter.
    """

    episodes: int
    robot_steps: int
    """The steps of all robots in all episodes."""
    asked: tuple[NDArray[np.int64], ...]
    controlled: tuple[NDArray[np.int64], ...]

    @property
    def nobody(self) -> int:
        """The steps in which nobody controlled."""
        return self.robot_steps - int(sum(cells.sum() for cells in self.controlled))

    def share(self, behavior: int) -> float:
        """Return the share of the steps in which a behavior controlled."""
        return int(self.controlled[behavior].sum()) / max(1, self.robot_steps)
