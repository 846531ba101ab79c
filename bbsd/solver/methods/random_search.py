"""Random search: new random designs in every round, of which the best get more episodes."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.champions import no_champions
from bbsd.solver.methods.method import Method, SearchState, with_champions
from bbsd.solver.methods.nomination import begun

if TYPE_CHECKING:
    from bbsd.solver.arena import Arena

DRAWN, FIRST, MORE = (name_word(name) for name in ("drawn", "first episodes", "more episodes"))

DESIGNS = 1000
"""Random designs of a round."""
EPISODES, MORE_EPISODES = 2, 8
"""Common episodes of all of them, and further ones of the best tenth."""
CAPACITY = 1000


def begin(arena: Arena, key: int, budget: int) -> SearchState:
    """Return the state before the first round."""
    del key, budget
    return SearchState(champions=no_champions(arena.problem, CAPACITY))


def advance(state: SearchState, arena: Arena, key: int, budget: int) -> SearchState:
    """Draw designs, and let the best tenth have more episodes than the others."""
    state = begun(state, arena, key, budget)
    stream, left = fold(key, word_of(state.round)), budget - state.spent
    count = max(1, min(DESIGNS, left * 10 // (10 * EPISODES + MORE_EPISODES)))
    designs = arena.space.random(fold(stream, DRAWN), count)
    episodes = min(EPISODES, left // count)
    means = arena.means(designs, fold(stream, FIRST), episodes)
    spent = count * episodes
    best = np.argsort(-means, kind="stable")[: max(1, count // 10)]
    more = min(MORE_EPISODES, (left - spent) // len(best))
    if more > 0:
        means = arena.means(designs[best], fold(stream, MORE), more)
        spent += len(best) * more
    else:
        means = means[best]
    champions = with_champions(state.champions, designs[best], means)
    return replace(state, round=state.round + 1, spent=state.spent + spent, champions=champions)


METHOD = Method("random", begin, advance)
