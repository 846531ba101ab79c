"""Several small societies with cultures of their own, then a larger one that continues with what they found.

One society ends in one basin; several find better ones than a single one that lives longer. The larger one tries every
module beside those of the best leader only: a finer search, which finds nothing where no leader earns anything.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.champions import no_champions
from bbsd.solver.methods.founding import SHARE
from bbsd.solver.methods.method import Method, SearchState
from bbsd.solver.methods.nomination import CAPACITY, begun, nominated, nominated_means, with_rest_spent
from bbsd.solver.methods.society import (
    CULTURE,
    Size,
    Society,
    composed,
    first_society,
    next_societies,
    society_of,
)
from bbsd.solver.paper.culture import take_in

if TYPE_CHECKING:
    from bbsd.solver.arena import Arena

FOUNDED, GENERATIONS = name_word("founded"), name_word("generations")

SMALL = Size(population=10, paired=30, exchanged=30)
LARGE = Size(population=20, paired=0, exchanged=120)
MOST_SMALL = 4
SMALL_SHARE = 0.5
"""Of a ladder's episodes, what the small societies have together."""
EPISODES = 4
"""Episodes of a lifetime. Longer lives did not help where returns are noisy: 3 to 20 on lake, 5 and 10 on pursuit."""
FEWEST_GENERATIONS = 20
"""Of each small society; with fewer episodes there are fewer societies."""
LONGEST = 300_000
"""Episodes of a ladder at most: of 1,300,000 on lifting, four found the best known design in each of six seeds."""
ROUND_SHARE = 0.02
"""Of a ladder, what a round spends at least."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SocietiesState(SearchState):
    """A ladder of societies: small ones, then a larger one; when it is spent, another one begins."""

    begun: int = 0
    """Episodes that were spent before this ladder."""
    planned: int
    """Episodes of this ladder."""
    small: tuple[Society, ...]
    """Of which the first ones live."""
    large: Society
    succeeded: bool = False
    """Whether the larger one has taken over; before, it is one of the small ones."""


def begin(arena: Arena, key: int, budget: int) -> SocietiesState:
    """Return the state before the first round, in which no society has been founded yet."""
    nobody = society_of(arena.space.random(key, SMALL.population))
    return SocietiesState(
        champions=no_champions(arena.problem, CAPACITY),
        planned=ladder(budget),
        small=(nobody,) * MOST_SMALL,
        large=nobody,
    )


def ladder(episodes: int) -> int:
    """Return how many episodes the next of several ladders of equal length has, if so many are left for all."""
    return max(1, episodes // max(1, -(-episodes // LONGEST)))


def number_of_small(planned: int) -> int:
    """Return how many small societies live for long enough in a ladder of so many episodes."""
    of_one = SMALL.agents * EPISODES * FEWEST_GENERATIONS
    return min(max(1, int(SMALL_SHARE * planned) // of_one), MOST_SMALL)


def advance(state: SocietiesState, arena: Arena, key: int, budget: int) -> SocietiesState:
    """Take the societies whose turn it is some generations further, and nominate their best agents."""
    if state.spent >= state.begun + state.planned:
        planned = max(state.planned, ladder(budget - state.spent))
        state = replace(state, begun=state.spent, planned=planned, succeeded=False)
    if state.spent == state.begun:
        return founded(state, arena, key, budget)
    n_small = number_of_small(state.planned)
    size, living = SMALL, state.small[:n_small]
    if state.spent - state.begun >= SMALL_SHARE * state.planned:
        size = LARGE if n_small == MOST_SMALL else SMALL
        living = (state.large if state.succeeded else successor(state, living, size.population),)
        state = replace(state, succeeded=True)
    cost, left = len(living) * size.agents * EPISODES, budget - state.spent
    generations = min(int(ROUND_SHARE * state.planned) // cost + 1, left // cost)
    if not generations:
        return with_rest_spent(replace(state, round=state.round + 1), arena, key, left)
    stream = fold(fold(key, GENERATIONS), word_of(state.round))
    for generation in range(generations):
        living, _ = next_societies(living, arena, fold(stream, word_of(generation)), size, EPISODES)
    if state.succeeded:
        state = replace(state, large=living[0])
    else:
        state = replace(state, small=(*living, *state.small[n_small:]))
    return after_round(state, living, generations * cost, arena, key, budget)


def founded(state: SocietiesState, arena: Arena, key: int, budget: int) -> SocietiesState:
    """Found the small societies of a ladder, each of the best of random agents; the very first has known ones too."""
    n_small, stream = number_of_small(state.planned), fold(fold(key, FOUNDED), word_of(state.spent))
    count = int(SHARE * state.planned) // (n_small * EPISODES)
    is_first = not state.spent
    state = begun(state, arena, key, budget)
    if count < SMALL.population or n_small * count * EPISODES > budget - state.spent:
        return with_rest_spent(replace(state, round=state.round + 1), arena, key, budget - state.spent)
    small = tuple(
        first_society(
            arena if is_first and not index else arena.afresh,
            fold(stream, word_of(index)),
            SMALL.population,
            count,
            EPISODES,
        )
        for index in range(n_small)
    )
    state = replace(state, small=(*small, *state.small[n_small:]))
    return after_round(state, small, n_small * count * EPISODES, arena, key, budget)


def after_round(
    state: SocietiesState, living: tuple[Society, ...], spent: int, arena: Arena, key: int, budget: int
) -> SocietiesState:
    """Return the state after a round that spent so many episodes, with the best agents nominated."""
    state = replace(state, round=state.round + 1, spent=state.spent + spent)
    for society in living:
        state = nominated(state, arena, key, composed(society), budget - state.spent)
    return state


def successor(state: SocietiesState, small: tuple[Society, ...], population: int) -> Society:
    """Return a society of small ones' best individuals and memes, led by the best of their leaders."""
    leaders = small[0].leader.joined(*(society.leader for society in small[1:]))
    best = small[int(np.argmax(nominated_means(state, leaders)))]
    rows = np.concatenate([society.pools[: -(-population // len(small))] for society in small])
    culture = best.culture
    for society in [each for each in small if len(each.culture)]:
        fittest = [int(np.argmax(society.culture.fitness))]
        culture = take_in(culture, society.culture.memes[fittest], society.culture.fitness[fittest], CULTURE)
    return replace(best, pools=np.resize(rows, (population, rows.shape[1])), culture=culture)


METHOD = Method("societies", begin, advance)
