"""How the returns of episodes are spread: quantiles, and which episodes are worth a look."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation.choosing import RANKS, Rank, chosen_episode

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

PERCENTS = (5, 25, 50, 75, 95)
"""The quantiles that are told."""


@dataclass(frozen=True, slots=True)
class Spread:
    """The returns of single episodes."""

    worst: float
    best: float
    quantiles: dict[int, float]
    """By percent: between the two nearest returns, linearly; of weighted ones the least that reaches the share."""
    episodes: dict[Rank, int] = field(default_factory=dict)
    """The numbers of the worst, the median and the best episode; empty where episodes have no numbers."""


@dataclass(frozen=True, slots=True, eq=False)
class EachEpisode:
    """What each episode brought, (n_episodes,): the return, its reward terms by name, the number of steps."""

    returns: Floats
    terms: dict[str, Floats]
    steps: Floats
    agents: int = 1
    """How many agents lived them, agent after agent."""
    probabilities: Floats | None = None
    """Of the starts, where every possible one was run."""


def spread_of(returns: Floats, *, numbered: bool) -> Spread:
    """Return the spread of returns (n,), of episodes that are numbered in this order or have no numbers."""
    quantiles = np.quantile(returns, [percent / 100 for percent in PERCENTS]).tolist()
    return Spread(
        float(returns.min()),
        float(returns.max()),
        dict(zip(PERCENTS, quantiles, strict=True)),
        {rank: chosen_episode(returns, rank) for rank in RANKS} if numbered else {},
    )


def weighted_spread(returns: Floats, weights: Floats) -> Spread:
    """Return the spread of returns (n,) with probabilities (n,)."""
    order = np.argsort(returns, kind="stable")
    reached = np.cumsum(weights[order]) / weights.sum()
    places = np.searchsorted(reached, [percent / 100 - 1e-12 for percent in PERCENTS])
    possible = returns[weights > 0]
    return Spread(
        float(possible.min()),
        float(possible.max()),
        dict(zip(PERCENTS, returns[order][places].tolist(), strict=True)),
    )
