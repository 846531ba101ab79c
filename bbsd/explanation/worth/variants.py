"""Changed versions of one design as agents, side by side with the design itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation.agents import Agents, no_action
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.language.meaning.tables.table import OPEN_CELL
from bbsd.solver.paper.genetics import random_pool

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem

RANDOM_TABLES = 25
"""Random tables that replace a behavior's; each has its part of the episodes, so that their means are independent."""
TABLES = name_word("worth of random tables")


def with_random_tables(
    problem: Problem, base: Architecture, behavior: int, key: int, episodes: int
) -> Agents:
    """Return a design with random tables of one behavior: an agent for each table, as many as so many episodes allow.

    `key` names the stream of the episodes, and so the tables.
    """
    shape, n_tables = problem.tables[behavior], min(RANDOM_TABLES, episodes)
    is_open = np.full(shape.n_cells, OPEN_CELL, np.uint8)
    pools = [table[np.newaxis] for table in base.tables]
    pools[behavior] = random_pool(
        fold(fold(key, TABLES), word_of(behavior)), n_tables, is_open, shape.n_actions
    )
    members = np.zeros((n_tables, len(pools)), np.int64)
    members[:, behavior] = np.arange(n_tables)
    return Agents(tuple(pools), members, np.tile(base.structure, (n_tables, 1)))


class Variants:
    """A design, the number 0, and variants of it; tables that stay are shared."""

    def __init__(self, base: Architecture) -> None:
        self._base = base
        self._pools = [[table] for table in base.tables]
        self._members = [[0] * len(base.tables)]
        self._structures = [base.structure]
        self.labels = ["the design itself"]

    def with_table(self, behavior: int, table: NDArray[np.uint8], label: str) -> int:
        """Add the design with another table of one behavior, and return the variant's number."""
        self._pools[behavior].append(table)
        member = [0] * len(self._pools)
        member[behavior] = len(self._pools[behavior]) - 1
        return self._add(member, self._base.structure, label)

    def without(self, behavior: int, label: str) -> int:
        """Add the design with one behavior held to No Action, and return the variant's number."""
        return self.with_table(behavior, no_action(self._base.tables[behavior]), label)

    def with_structure(self, structure: NDArray[np.int64], label: str) -> int:
        """Add the design with another structure, lowest layer first, and return the variant's number."""
        return self._add([0] * len(self._pools), structure, label)

    def _add(self, member: list[int], structure: NDArray[np.int64], label: str) -> int:
        self._members.append(member)
        self._structures.append(structure)
        self.labels.append(label)
        return len(self._members) - 1

    @property
    def agents(self) -> Agents:
        """All of them, in the order of their numbers."""
        pools = tuple(np.stack(pool) for pool in self._pools)
        return Agents(pools, np.array(self._members, np.int64), np.stack(self._structures))
