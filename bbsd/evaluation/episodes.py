"""Episodes of agents with fixed structures: a lane is an agent in an episode, in batches, so memory is bounded."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.evaluation.finite import require_finite
from bbsd.stopping import raise_if_stopped

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.compiler import DetailedOutcome, Problem
    from bbsd.evaluation.agents import Agents

BATCH = 4000
"""Lanes of one call. Fixed, since outcomes are summed batch by batch."""

Floats = npt.NDArray[np.float64]
Keys = npt.NDArray[np.uint64]


def returns_of(
    problem: Problem, agents: Agents, keys: Keys, generation: int, *, all_finite: bool = True
) -> Floats:
    """Return the return of every agent in every episode, (n_agents, n_episodes).

    Keys (n_episodes,) name episodes that all agents have, keys (n_agents, n_episodes) each agent's own. Raises
    RewardNotFinite unless not `all_finite`; then returns may be infinite or NaN.
    """
    returns = np.empty(len(agents) * keys.shape[-1])
    for lanes, batch, streams in batches_of(agents, keys):
        team = problem.assemble(agents.pools, batch.members, generation)
        returns[lanes] = team.episode(streams, batch.structures).returns
        if all_finite:
            require_finite(problem, batch, streams, returns[lanes], generation)
    return returns.reshape(len(agents), -1)


def detailed_outcomes(
    problem: Problem, agents: Agents, keys: Keys, generation: int
) -> Iterator[DetailedOutcome]:
    """Yield the outcomes of the same episodes in detail, batch by batch, agent after agent."""
    for _, batch, streams in batches_of(agents, keys):
        team = problem.assemble(agents.pools, batch.members, generation)
        outcome = team.detailed_episode(streams, batch.structures)
        require_finite(problem, batch, streams, outcome.returns, generation)
        yield outcome


def batches_of(agents: Agents, keys: Keys) -> Iterator[tuple[slice, Agents, Keys]]:
    """Yield the lanes of each batch, agent after agent, with their agents and the keys of their episodes.

    Raises KeyboardInterrupt where a stop was requested.
    """
    n_episodes = keys.shape[-1]
    total = len(agents) * n_episodes
    for first in range(0, total, BATCH):
        raise_if_stopped()
        lanes = np.arange(first, min(first + BATCH, total))
        streams = keys[lanes % n_episodes] if keys.ndim == 1 else keys.ravel()[lanes]
        yield slice(first, first + len(lanes)), agents[lanes // n_episodes], streams
