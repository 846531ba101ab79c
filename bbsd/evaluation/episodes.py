"""Episodes of finished agents: lanes are agents in episodes, in batches of a fixed size so memory is bounded."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.evaluation.finite import require_finite

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.compiler import DetailedOutcome, Problem
    from bbsd.evaluation.agents import Agents

BATCH = 4000
"""Lanes of one call. Fixed, since sums are made batch by batch."""

Floats = npt.NDArray[np.float64]
Keys = npt.NDArray[np.uint64]


def returns_of(problem: Problem, agents: Agents, keys: Keys, generation: int) -> Floats:
    """The return of every agent in every episode, (n_agents, n_episodes).

    Keys (n_episodes,) are of episodes that all agents meet, (n_agents, n_episodes) of each agent's own.
    """
    returns = np.empty(len(agents) * keys.shape[-1])
    for lanes, lived, streams in _batches(agents, keys):
        team = problem.assemble(agents.pools, lived.members, generation)
        returns[lanes] = team.episode(streams, lived.structures).returns
        require_finite(problem, lived, streams, returns[lanes], generation)
    return returns.reshape(len(agents), -1)


def detailed_outcomes(
    problem: Problem, agents: Agents, keys: Keys, generation: int
) -> Iterator[DetailedOutcome]:
    """The same episodes in detail, batch by batch, agent after agent."""
    for _, lived, streams in _batches(agents, keys):
        team = problem.assemble(agents.pools, lived.members, generation)
        outcome = team.detailed_episode(streams, lived.structures)
        require_finite(problem, lived, streams, outcome.returns, generation)
        yield outcome


def _batches(agents: Agents, keys: Keys) -> Iterator[tuple[slice, Agents, Keys]]:
    each = keys.shape[-1]
    total = len(agents) * each
    for first in range(0, total, BATCH):
        lanes = np.arange(first, min(first + BATCH, total))
        streams = keys[lanes % each] if keys.ndim == 1 else keys.ravel()[lanes]
        yield slice(first, first + len(lanes)), agents[lanes // each], streams
