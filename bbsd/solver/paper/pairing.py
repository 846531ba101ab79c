"""Which modules meet in an agent (V.B.1): every individual equally often in random order, at random, or by fitness."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.jit import jit
from bbsd.kernel.keys import keys, units
from bbsd.kernel.streams import fold, word_of
from bbsd.solver.draws import marks, shuffle
from bbsd.solver.paper.culture import wheel

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray


def members(
    key: int, expected: Sequence[NDArray[np.float64]], n_agents: int, pairing: str = "balanced"
) -> NDArray[np.int64]:
    """Choose the individuals that each agent is made of, one from each pool.

    Args:
        key: the generation's stream for pairing.
        expected: for each pool, the fitness expected of its individuals, (population,).
        n_agents: how many agents a generation has.
        pairing: balanced, random, or proportional to the fitness expected.

    Returns:
        (n_agents, n_behaviors).
    """
    streams = [fold(key, word_of(pool)) for pool in range(len(expected))]
    if pairing == "balanced":
        columns = [
            balanced(stream, len(pool), n_agents) for stream, pool in zip(streams, expected, strict=True)
        ]
    else:
        weights = [
            wheel(pool) if pairing == "proportional" else np.arange(1.0, len(pool) + 1) for pool in expected
        ]
        columns = [spun(stream, ends, n_agents) for stream, ends in zip(streams, weights, strict=True)]
    return np.stack(columns, axis=1)


def spun(key: int, ends: NDArray[np.float64], n_agents: int) -> NDArray[np.int64]:
    """Return for each agent the sector, of those that end at `ends`, in which a roulette wheel stops; (n_agents,)."""
    places = units(keys(key, 0, n_agents)) * ends[-1]
    chosen: NDArray[np.int64] = np.minimum(np.searchsorted(ends, places, side="right"), len(ends) - 1)
    return chosen


def balanced(key: int, population: int, n_agents: int) -> NDArray[np.int64]:
    """Choose one pool's individual for each agent: how often two individuals are used differs by at most one.

    Returns:
        (n_agents,).
    """
    drawn = np.empty(n_agents, np.int64)
    deal_decks(np.uint64(key), population, drawn)
    return drawn


@jit
def deal_decks(key: np.uint64, population: int, drawn: NDArray[np.int64]) -> None:
    """Deal shuffled decks of all individuals until every agent has one; the last deck may not be used up."""
    deck, places = np.arange(population), marks(population)
    for start in range(0, len(drawn), population):
        n_dealt = min(population, len(drawn) - start)
        shuffle(fold(int(key), word_of(start)), deck, n_dealt, places)
        for card in range(n_dealt):
            drawn[start + card] = deck[card]
