"""Several small societies with cultures of their own, then a larger one, whose best agents are champions.

One society ends in one basin; several, and of two sizes, find better ones than a single one that lives longer.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.champions import no_champions
from bbsd.solver.methods.method import Method, SearchState
from bbsd.solver.methods.nomination import CAPACITY, nominated, with_rest_spent
from bbsd.solver.methods.society import Size, Society, composed, first_society, next_societies

if TYPE_CHECKING:
    from bbsd.solver.arena import Arena

FOUNDED, GENERATIONS = name_word("founded"), name_word("generations")

SMALL, LARGE = Size(10, 60), Size(20, 120)
N_SMALL = 4
SMALL_SHARE = 0.5
"""Of a ladder's episodes, what the small societies have together."""
EPISODES = 5
"""Episodes of a lifetime."""
FEWEST_GENERATIONS = 20
"""Of each small society; where a ladder has not the episodes, a single one has them all."""
ROUND_SHARE = 0.02
"""Of a ladder, what a round spends at least."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SocietiesState(SearchState):
    """A ladder of societies, of which the small ones live first; when it is spent, another one begins."""

    begun: int = 0
    """Episodes that were spent before this ladder."""
    planned: int
    """Episodes of this ladder."""
    small: tuple[Society, ...]
    large: Society


def begin(arena: Arena, key: int, budget: int) -> SocietiesState:
    """Return the state before the first round."""
    small, large = founded(arena, key, 0)
    champions = no_champions(arena.problem, CAPACITY)
    return SocietiesState(champions=champions, planned=max(1, budget), small=small, large=large)


def founded(arena: Arena, key: int, episode: int) -> tuple[tuple[Society, ...], Society]:
    """Return the societies of a ladder that begins after so many episodes."""
    stream = fold(fold(key, FOUNDED), word_of(episode))
    small = tuple(
        first_society(arena.space, fold(stream, word_of(index)), SMALL.population) for index in range(N_SMALL)
    )
    return small, first_society(arena.space, fold(stream, word_of(N_SMALL)), LARGE.population)


def advance(state: SocietiesState, arena: Arena, key: int, budget: int) -> SocietiesState:
    """Take the societies whose turn it is some generations further, and nominate their best agents."""
    if state.spent >= state.begun + state.planned:
        small, large = founded(arena, key, state.spent)
        planned = max(state.planned, budget - state.spent)
        state = replace(state, begun=state.spent, planned=planned, small=small, large=large)
    lives = state.spent - state.begun
    if state.planned < N_SMALL * (1 + SMALL.agents) * EPISODES * FEWEST_GENERATIONS / SMALL_SHARE:
        size, living = SMALL, state.small[:1]
    elif lives < SMALL_SHARE * state.planned:
        size, living = SMALL, state.small
    else:
        size, living = LARGE, (state.large,)
    stream = fold(fold(key, GENERATIONS), word_of(state.round))
    cost = len(living) * (1 + size.agents) * EPISODES
    generations = min(-(-int(ROUND_SHARE * state.planned) // cost) or 1, (budget - state.spent) // cost)
    for generation in range(generations):
        living, _ = next_societies(living, arena, fold(stream, word_of(generation)), size.agents, EPISODES)
    if size is LARGE:
        state = replace(state, large=living[0])
    else:
        state = replace(state, small=(*living, *state.small[len(living) :]))
    state = replace(state, round=state.round + 1, spent=state.spent + generations * cost)
    if not generations:
        return with_rest_spent(state, arena, key, budget - state.spent)
    for society in living:
        state = nominated(state, arena, key, composed(society), budget - state.spent)
    return state


METHOD = Method("societies", begin, advance)
