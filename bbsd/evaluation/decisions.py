"""The decisions of an episode: what every behavior perceived and wanted in each step, and who controlled."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.compiler import Column, Problem


@dataclass(frozen=True, slots=True, eq=False)
class Decisions:
    """What every behavior of every robot perceived and wanted in each step, and who controlled."""

    excited: NDArray[np.bool_]
    """(n_steps, n_robots, n_behaviors), behaviors in the spec's order, as in `cells` and `wishes`."""
    cells: NDArray[np.int64]
    """The cell of the behavior's own table, also where it is not excited."""
    wishes: NDArray[np.int64]
    """The number of the action that its table has in that cell, from 1; 0 is No Action."""
    controlling: NDArray[np.int64]
    """(n_steps, n_robots): the index of the behavior, -1 where nobody controls."""


def decisions_of(
    problem: Problem, architecture: Architecture, columns: list[Column], record: NDArray[np.float64]
) -> Decisions:
    """Read the decisions from a trace's record (n_steps, n_columns)."""
    n_steps, robots = len(record), problem.meaning.spec.environment.robots

    def recorded(content: str) -> NDArray[np.float64]:
        indices = [index for index, column in enumerate(columns) if column.content == content]
        return record[:, indices].reshape(n_steps, robots, -1)

    cells = recorded("cell").astype(np.int64)
    wishes = np.stack([table[cells[..., index]] for index, table in enumerate(architecture.tables)], axis=-1)
    first_actions = [*accumulate((table.n_actions for table in problem.tables), initial=0)][:-1]
    choices = recorded("choice")[..., 0].astype(np.int64)
    controlling = np.searchsorted(first_actions, choices, side="left") - 1
    return Decisions(recorded("excited") != 0.0, cells, wishes.astype(np.int64), controlling.astype(np.int64))
