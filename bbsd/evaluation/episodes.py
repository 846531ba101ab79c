"""Episodes of finished agents: lanes are agents in episodes, in batches of a fixed size so memory is bounded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.architecture import Architecture
from bbsd.evaluation.finite import require_finite

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.compiler import DetailedOutcome, Pool, Problem

BATCH = 4000
"""Lanes of one call. Fixed, since sums are made batch by batch."""

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Keys = npt.NDArray[np.uint64]


@dataclass(frozen=True, slots=True, eq=False)
class Agents:
    """Agents of individuals: pools, members (n_agents, n_behaviors), structures (n_agents, n_layers)."""

    pools: tuple[Pool, ...]
    members: Integers
    structures: Integers

    def __len__(self) -> int:
        return len(self.members)

    def __getitem__(self, which: Integers) -> Agents:
        return Agents(self.pools, self.members[which], self.structures[which])

    def living(self, structures: Integers) -> Agents:
        """The same agents with other structures."""
        return Agents(self.pools, self.members, structures)

    def architecture(self, agent: int) -> Architecture:
        """One agent by itself."""
        tables = tuple(pool[self.members[agent, index]] for index, pool in enumerate(self.pools))
        return Architecture(tables, self.structures[agent])


def agents_of(architectures: Sequence[Architecture]) -> Agents:
    """Each architecture as an agent of its own."""
    n_behaviors = len(architectures[0].tables)
    pools = tuple(np.stack([each.tables[index] for each in architectures]) for index in range(n_behaviors))
    members = np.repeat(np.arange(len(architectures))[:, None], n_behaviors, axis=1)
    return Agents(pools, members, np.stack([each.structure for each in architectures]))


def returns_of(problem: Problem, agents: Agents, keys: Keys, generation: int) -> Floats:
    """The return of every agent in every episode, (n_agents, n_episodes); all agents meet the same episodes."""
    returns = np.empty(len(agents) * len(keys))
    for lanes, lived, streams in _batches(agents, keys):
        team = problem.assemble(agents.pools, lived.members, generation)
        returns[lanes] = team.episode(streams, lived.structures).returns
        require_finite(problem, lived, streams, returns[lanes], generation)
    return returns.reshape(len(agents), len(keys))


def detailed(problem: Problem, agents: Agents, keys: Keys, generation: int) -> Iterator[DetailedOutcome]:
    """The same episodes in detail, batch by batch, agent after agent."""
    for _, lived, streams in _batches(agents, keys):
        team = problem.assemble(agents.pools, lived.members, generation)
        outcome = team.detailed_episode(streams, lived.structures)
        require_finite(problem, lived, streams, outcome.returns, generation)
        yield outcome


def _batches(agents: Agents, keys: Keys) -> Iterator[tuple[slice, Agents, Keys]]:
    total = len(agents) * len(keys)
    for first in range(0, total, BATCH):
        lanes = np.arange(first, min(first + BATCH, total))
        yield slice(first, first + len(lanes)), agents[lanes // len(keys)], keys[lanes % len(keys)]
