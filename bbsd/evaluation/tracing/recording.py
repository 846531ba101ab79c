"""One episode exactly as it was computed: all numbers that are stored, and who did what."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.compiler.details import traced_columns
from bbsd.evaluation.tracing.scene import starting_values

if TYPE_CHECKING:
    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.expression.node_data import Slot


@dataclass(frozen=True, slots=True, eq=False)
class Recording:
    """An episode as numbers: truths are 0 and 1, partitions the index of the cell.

    `stored[k]` is what is stored before step k + 1, on which it is decided; `choices` (n_steps, n_robots) are the
    numbers of the controlling actions, counted over all behaviors from 1, 0 is nobody's. `key` names the episode's
    random streams.
    """

    stored: list[dict[Slot, float]]
    choices: npt.NDArray[np.int64]
    key: int


def record_episode(problem: Problem, architecture: Architecture, key: int, generation: int) -> Recording:
    """Run one episode as plain Python and record it."""
    meaning, columns = problem.meaning, traced_columns(problem.meaning)
    record = np.full((meaning.spec.environment.steps, len(columns)), np.nan)
    members = np.zeros((1, problem.n_behaviors), np.int64)
    team = problem.assemble([table[None] for table in architecture.tables], members, generation)
    record = record[: team.traced_episode(key, architecture.structure, record)]
    at = {column.slot: index for index, column in enumerate(columns) if column.content == "slot"}
    later = [dict(zip(at, row, strict=True)) for row in record[:-1, [*at.values()]].tolist()]
    start = starting_values(meaning, key, meaning.constants.vector(generation))
    is_choice = [column.content == "choice" for column in columns]
    return Recording([start, *later], record[:, is_choice].astype(np.int64), key)
