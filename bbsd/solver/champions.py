"""Champions: the fittest agents of a run so far, kept for the final race."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture import Architecture

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.evaluation import Agents


@dataclass(frozen=True, slots=True, eq=False)
class Champions:
    """The fittest agents, each different genotype once, the fittest first."""

    tables: NDArray[np.uint8]
    """(n, cells of all behaviors one after the other)."""
    structures: NDArray[np.int64]
    """(n, n_layers)."""
    fitness: NDArray[np.float64]
    """(14), (n,): from the few episodes of one lifetime, so that of the fittest is mostly too high."""
    capacity: int
    """The most that are kept."""

    def joined(self, agents: Agents, fitness: NDArray[np.float64]) -> Champions:
        """Return the champions after a generation's agents were added."""
        own = [pool[agents.members[:, index]] for index, pool in enumerate(agents.pools)]
        tables = np.concatenate([self.tables, np.concatenate(own, axis=1)])
        structures = np.concatenate([self.structures, agents.structures])
        values = np.concatenate([self.fitness, fitness])
        order = np.argsort(-values, kind="stable")
        kept = order[_first_of_each(tables[order], structures[order])][: self.capacity]
        return Champions(tables[kept], structures[kept], values[kept], self.capacity)

    def architectures(self, problem: Problem) -> list[Architecture]:
        """Return the champions as architectures."""
        ends = np.cumsum([table.n_cells for table in problem.tables])[:-1]
        return [
            Architecture(tuple(np.split(tables, ends)), structure)
            for tables, structure in zip(self.tables, self.structures, strict=True)
        ]


def _first_of_each(tables: NDArray[np.uint8], structures: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the indices of the first of all with the same tables and structure, in ascending order."""
    rows = np.hstack([tables, np.ascontiguousarray(structures).view(np.uint8)])
    _, first = np.unique(rows.view(f"V{rows.shape[1]}").ravel(), return_index=True)
    return np.sort(first)


def no_champions(problem: Problem, capacity: int) -> Champions:
    """Return no champions yet, and room for so many."""
    n_cells = sum(table.n_cells for table in problem.tables)
    layers = np.empty((0, len(problem.layers)), np.int64)
    return Champions(np.empty((0, n_cells), np.uint8), layers, np.empty(0), capacity)
