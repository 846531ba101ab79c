"""Hill climbing with restarts: from the best of some random designs, single changes until none helps, then anew."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.champions import no_champions
from bbsd.solver.climb import Climb, advance_climb, begin_climb
from bbsd.solver.methods.method import Method, SearchState, with_champions
from bbsd.solver.methods.nomination import begun

if TYPE_CHECKING:
    from bbsd.solver.arena import Arena
    from bbsd.solver.space import Designs

DRAWN, HEATS, CLIMBS = (name_word(name) for name in ("drawn", "heats", "climbs"))

CAPACITY = 1000
STARTS = 512
"""Random designs of which the best becomes the start of a climb."""
START_PART = 20
"""One part in so many of what is left of the budget is for choosing a start."""
FIRST_HEAT, KEPT, LONGER = 2, 4, 2
"""Episodes of the first heat of the random designs; one in so many is kept, and runs so many times the episodes."""
MOST_EPISODES = 800
"""Common episodes of the last round of a climb: restarts help more than certainty about small gains."""


@dataclass(frozen=True, eq=False, kw_only=True)
class HillState(SearchState):
    """What hill climbing keeps: the present climb, which is over before the first start."""

    climb: Climb
    starts: int = 0
    """Climbs begun; the number names the random streams of the present one."""


def begin(arena: Arena, key: int, budget: int) -> HillState:
    """Return the state before the first round."""
    del budget
    nowhere = begin_climb(arena.space.random(key, 1))
    return HillState(champions=no_champions(arena.problem, CAPACITY), climb=replace(nowhere, at_optimum=True))


def advance(state: HillState, arena: Arena, key: int, budget: int) -> HillState:
    """Take the climb further, or begin another where it is over."""
    state = begun(state, arena, key, budget)
    if state.climb.at_optimum:
        return _restarted(state, arena, fold(key, word_of(state.round)), budget)
    before = state.climb.spent
    stream = fold(fold(key, CLIMBS), word_of(state.starts))
    climb = advance_climb(state.climb, arena, stream, before + budget - state.spent, MOST_EPISODES)
    if climb.spent == before:  # nothing is open but what all designs have
        return _restarted(state, arena, fold(key, word_of(state.round)), budget)
    return replace(
        state,
        round=state.round + 1,
        spent=state.spent + climb.spent - before,
        champions=with_champions(state.champions, climb.design, np.array([climb.mean])),
        climb=climb,
    )


def _restarted(state: HillState, arena: Arena, stream: int, budget: int) -> HillState:
    """Return the state with a new climb: from each known design, then from the best of some random ones."""
    left = budget - state.spent
    if arena.starts is not None and state.starts < len(arena.starts):
        climb = begin_climb(arena.starts[state.starts : state.starts + 1])
        return replace(state, round=state.round + 1, climb=climb, starts=state.starts + 1)
    count = max(1, min(STARTS, left // START_PART // (FIRST_HEAT * LONGER)))
    designs, mean, spent = _best_by_heats(
        arena.space.random(fold(stream, DRAWN), count), arena, fold(stream, HEATS), left
    )
    return replace(
        state,
        round=state.round + 1,
        spent=state.spent + spent,
        champions=with_champions(state.champions, designs, np.array([mean])),
        climb=begin_climb(designs),
        starts=state.starts + 1,
    )


def _best_by_heats(designs: Designs, arena: Arena, stream: int, left: int) -> tuple[Designs, float, int]:
    """Return the winner of some designs in heats that double, its mean in the last, and the episodes."""
    episodes, spent, heat = min(FIRST_HEAT, left // len(designs)), 0, 0
    while True:
        means = arena.means(designs, fold(stream, word_of(heat)), episodes)
        spent += len(designs) * episodes
        best = np.argsort(-means, kind="stable")[: max(1, len(designs) // KEPT)]
        designs, episodes, heat = designs[best], episodes * LONGER, heat + 1
        if len(designs) == 1 or len(designs) * episodes > left - spent:
            return designs[:1], float(means[best[0]]), spent


METHOD = Method("hill", begin, advance)
