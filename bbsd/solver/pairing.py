"""Which modules meet in an agent (V.B.1): every individual equally often, in random order."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.jit import jit
from bbsd.kernel.streams import fold, word_of
from bbsd.solver.draws import shuffle

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray


def members(key: int, populations: Sequence[int], n_agents: int) -> NDArray[np.int64]:
    """The individual of each pool that each agent is made of.

    Args:
        key: the generation's stream for pairing.
        populations: the number of individuals in each pool.
        n_agents: how many agents live in a generation.

    Returns:
        (n_agents, n_behaviors).
    """
    columns = [balanced(fold(key, word_of(pool)), size, n_agents) for pool, size in enumerate(populations)]
    return np.stack(columns, axis=1)


def balanced(key: int, population: int, n_agents: int) -> NDArray[np.int64]:
    """One pool's individual for each agent: how often two individuals are used differs by at most one.

    Returns:
        (n_agents,).
    """
    drawn = np.empty(n_agents, np.int64)
    deal_decks(np.uint64(key), population, drawn)
    return drawn


@jit
def deal_decks(key: np.uint64, population: int, drawn: NDArray[np.int64]) -> None:
    """Deal shuffled decks of all individuals until every agent has one; the last deck may not be used up."""
    deck = np.arange(population)
    for start in range(0, len(drawn), population):
        n_dealt = min(population, len(drawn) - start)
        shuffle(fold(int(key), word_of(start)), deck, n_dealt)
        for card in range(n_dealt):
            drawn[start + card] = deck[card]
