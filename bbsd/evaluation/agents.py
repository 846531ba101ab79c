"""Agents as the solver and the evaluation handle them: individuals of pools, and a structure each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.architecture import Architecture
from bbsd.language.meaning.tables.table import NO_ACTION

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.compiler import Pool

Integers = npt.NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Agents:
    """Agents as individuals of pools, members (n_agents, n_behaviors), and structures (n_agents, n_layers)."""

    pools: tuple[Pool, ...]
    members: Integers
    structures: Integers

    def __len__(self) -> int:
        return len(self.members)

    def __getitem__(self, indices: Integers) -> Agents:
        return Agents(self.pools, self.members[indices], self.structures[indices])

    def with_structures(self, structures: Integers) -> Agents:
        """Return the same agents with other structures."""
        return Agents(self.pools, self.members, structures)

    def held(self, behavior: int) -> Agents:
        """Return the same agents with one of their behaviors held to No Action, its given cells too."""
        pools, members = list(self.pools), self.members.copy()
        pools[behavior] = no_action(self.pools[behavior][:1])
        members[:, behavior] = 0
        return Agents(tuple(pools), members, self.structures)

    def architecture(self, agent: int) -> Architecture:
        """Return the architecture of one agent."""
        tables = tuple(pool[self.members[agent, index]] for index, pool in enumerate(self.pools))
        return Architecture(tables, self.structures[agent])


def no_action(tables: Pool) -> Pool:
    """Return tables of the same shape that hold a behavior to No Action, its given cells too."""
    return np.full_like(tables, NO_ACTION)


def agents_of(architectures: Sequence[Architecture]) -> Agents:
    """Return agents, one for each architecture."""
    n_behaviors = len(architectures[0].tables)
    pools = tuple(
        np.stack([architecture.tables[index] for architecture in architectures])
        for index in range(n_behaviors)
    )
    members = np.repeat(np.arange(len(architectures))[:, None], n_behaviors, axis=1)
    return Agents(pools, members, np.stack([architecture.structure for architecture in architectures]))
