"""A search from its beginning to its answer: rounds of a method, then the race that is the same for all methods."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.answer import distinct
from bbsd.solver.race import still_running
from bbsd.solver.space import Designs

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.solver.arena import Arena
    from bbsd.solver.methods.method import Method, SearchState

ROUNDS, FINAL = name_word("search rounds"), name_word("final race")

RACE_SHARE = 0.2
"""Of a budget, what is left for the final race."""
FIRST_ROUND = 400
"""Episodes of the race's first round: after 50, a design of 3.31 was chosen over one of 7.2 that fails rarely."""


class Answer(NamedTuple):
    """The winner of the final race, its mean return in it, and the episodes that the race took in all."""

    design: Designs
    mean: float
    spent: int


def search_budget(budget: int) -> int:
    """Return the part of a budget that rounds may spend."""
    return budget - int(budget * RACE_SHARE)


def rounds(method: Method, state: SearchState, arena: Arena, key: int, budget: int) -> Iterator[SearchState]:
    """Continue a search round by round until its part of the budget is spent; yield the state after each."""
    while state.spent < search_budget(budget):
        state = method.advance(state, arena, fold(key, ROUNDS), search_budget(budget))
        yield state


def final_race(
    state: SearchState, arena: Arena, key: int, episodes: int, first: Designs | None = None
) -> Answer:
    """Race the champions, and other designs before them, on common fresh episodes, in rounds that double.

    It spends at most so many episodes in all. Designs that behave alike count as one. Among those that are left when
    the episodes are spent, the mean decides.
    """
    stream, champions = fold(fold(key, FINAL), word_of(state.spent)), state.champions
    few = max(2, episodes // (2 * FIRST_ROUND))
    entrants = Designs(champions.tables[:few], champions.structures[:few])
    if first is not None:
        entrants = first.joined(entrants)
    running = arena.space.designs(distinct(arena.space.architectures(entrants), arena.problem))
    earned, spent = np.empty((len(running), 0)), 0
    while len(running) > 1:
        done = earned.shape[1]
        count = min(max(done, FIRST_ROUND), (episodes - spent) // len(running))
        if count < 1:
            break
        earned = np.hstack([earned, arena.returns(running, stream, count, first=done)])
        spent += len(running) * count
        kept = still_running(earned)
        running, earned = running[kept], earned[kept]
    means = earned.mean(axis=1) if earned.shape[1] else np.zeros(len(running))
    best = int(np.argmax(means))
    return Answer(running[best : best + 1], float(means[best]), spent)
