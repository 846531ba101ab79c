"""The cross-entropy method: a distribution over designs moves toward the best that were drawn from it.

Rubinstein, R. Y.: The cross-entropy method for combinatorial and continuous optimization (1999). It shares the
fitness of agents uniformly, as (15) does, but among cells and layers instead of whole modules.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.champions import no_champions
from bbsd.solver.methods.distribution import Distribution, uniform_distribution
from bbsd.solver.methods.method import Method, SearchState
from bbsd.solver.methods.nomination import CAPACITY, begun, nominated, with_rest_spent
from bbsd.solver.paper.sharing import lifetime_fitness

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.solver.arena import Arena

DRAWN, EPISODE = name_word("drawn"), name_word("episodes")

FEWEST, MOST = 50, 1000
"""Designs of a round."""
ROUND_SHARE = 0.02
"""Of the budget, what a round spends where that is neither too few nor too many designs."""
EPISODES = 5
"""Common episodes of a round."""
ELITE = 0.1
"""Of a round's designs, those that the distribution moves toward."""
STEP, FLOOR = 0.3, 0.01
NOMINATED = 10
"""Designs of a round that are nominated, the most probable one among them."""
LONGEST = 80
"""Rounds after which the distribution is as good as settled, and another one begins."""
CHUNK = 10_000_000
"""Cells of designs in memory at a time."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CrossEntropyState(SearchState):
    """The distribution that the next round draws from."""

    planned: int
    """Episodes that the search was begun with."""
    distribution: Distribution


def begin(arena: Arena, key: int, budget: int) -> CrossEntropyState:
    """Return the state before the first round."""
    del key
    return CrossEntropyState(
        champions=no_champions(arena.problem, CAPACITY),
        planned=max(1, budget),
        distribution=uniform_distribution(arena.space),
    )


def advance(state: CrossEntropyState, arena: Arena, key: int, budget: int) -> CrossEntropyState:
    """Draw designs, move the distribution toward the best tenth, and nominate its best guess and theirs."""
    state = begun(state, arena, key, budget)
    space, stream, left = arena.space, fold(key, word_of(state.round)), budget - state.spent
    count = min(max(int(state.planned * ROUND_SHARE) // EPISODES, FEWEST), MOST, left // EPISODES)
    if count < min(FEWEST, 1 / ELITE):
        return with_rest_spent(state, arena, key, left)
    distribution = state.distribution
    if state.round % LONGEST == 0:
        distribution = uniform_distribution(space)
    if state.round == 0 and arena.starts is not None:
        distribution = distribution.moved(space, arena.starts, STEP, FLOOR)
    fitness = fitness_of_drawn(distribution, arena, stream, count)
    best = np.argsort(-fitness, kind="stable")[: int(count * ELITE)]
    elite = distribution.drawn(space, fold(stream, DRAWN), best)
    distribution = distribution.moved(space, elite, STEP, FLOOR)
    promising = distribution.most_probable(space).joined(elite[: NOMINATED - 1])
    spent = state.spent + count * EPISODES
    state = replace(state, round=state.round + 1, spent=spent, distribution=distribution)
    return nominated(state, arena, key, promising, budget - spent)


def fitness_of_drawn(distribution: Distribution, arena: Arena, key: int, count: int) -> NDArray[np.float64]:
    """Return the mean returns of so many designs in common episodes, (count,), with few of them in memory at a time."""
    size = max(1, CHUNK // max(1, len(arena.space.given)))
    parts = []
    for first in range(0, count, size):
        which = np.arange(first, min(first + size, count))
        designs = distribution.drawn(arena.space, fold(key, DRAWN), which)
        parts.append(lifetime_fitness(arena.returns(designs, fold(key, EPISODE), EPISODES)))
    return np.concatenate(parts)


METHOD = Method("cross_entropy", begin, advance)
