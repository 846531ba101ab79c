"""The record of a practice rollout."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Steps(NamedTuple):
    """What the robots of a batch of lanes were asked and earned, step by step.

    A lane's numbers mean something up to the last step that it took.
    """

    first: int
    """The first lane."""
    asked: NDArray[np.signedinteger]
    """Of each behavior that was asked: twice the number of its pair of a cell and a choice, plus 1 where it strayed.

    -1 of the others; (n_steps, n_robots, n_behaviors, n_lanes). Pairs are numbered behavior by behavior, cell by cell.
    Asked are the excited behaviors from the top layer down to the one that controls.
    """
    joint_cells: NDArray[np.int32]
    """The joint cell, (n_steps, n_robots, n_lanes)."""
    gains: NDArray[np.float64]
    """What each robot earned, (n_steps, n_robots, n_lanes)."""
