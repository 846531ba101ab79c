"""How methods nominate champions: by their mean return in episodes that are the same for all, in any round.

What a design earned in the few episodes of its own round says more of those episodes, and of luck, than of the design.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.methods.method import SearchState, with_champions
from bbsd.solver.space import Designs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.solver.arena import Arena

NOMINATION, VARIATION = name_word("nomination"), name_word("variation")

EPISODES = 50
"""Episodes of a nominated design; returns of 0 and 1 are then known within 0.07."""
CAPACITY = 200
"""Champions that are kept; a race of 60,000 episodes begins with 75 of them."""

State = TypeVar("State", bound=SearchState)


def nominated(state: State, arena: Arena, key: int, designs: Designs, left: int) -> State:
    """Run the designs that are no champions yet in the common episodes, as many as the episodes left allow.

    Args:
        state: of any method.
        arena: where the episodes run.
        key: the method's own, the same in every round.
        designs: the most promising first.
        left: episodes that may be spent.
    """
    known = Designs(state.champions.tables, state.champions.structures)
    first = known.joined(designs).distinct()
    new = designs[first[first >= len(known)] - len(known)][: left // EPISODES]
    if not len(new):
        return state
    means = arena.means(new, fold(key, NOMINATION), EPISODES)
    champions = with_champions(state.champions, new, means)
    return replace(state, champions=champions, spent=state.spent + len(new) * EPISODES)


def begun(state: State, arena: Arena, key: int, budget: int) -> State:
    """Return the state, before the first round with the known designs nominated that the search begins with.

    They have half of the budget at most.
    """
    if arena.starts is None or state.round or state.spent:
        return state
    return nominated(state, arena, key, arena.starts, budget // 2)


def nominated_means(state: SearchState, designs: Designs) -> NDArray[np.float64]:
    """Return the mean of each design that is a champion, -inf for another, (n_designs,)."""
    champions = state.champions
    same = (designs.tables[:, None] == champions.tables).all(axis=2)
    same &= (designs.structures[:, None] == champions.structures).all(axis=2)
    means: NDArray[np.float64] = np.where(same, champions.fitness, -np.inf).max(axis=1, initial=-np.inf)
    return means


def with_rest_spent(state: State, arena: Arena, key: int, left: int) -> State:
    """Spend what is left where a whole round does not fit: on variations of the best champion, or random designs."""
    stream = fold(fold(key, VARIATION), word_of(state.spent))
    space, count, episodes = arena.space, max(1, left // EPISODES), min(left, EPISODES)
    if len(state.champions.tables):
        best = Designs(state.champions.tables[:1], state.champions.structures[:1]).repeated(count)
        changed = space.mutated(stream, best, 1.0 / max(1, len(space.open_cells)))
        designs = Designs(changed.tables, space.reordered(stream, changed.structures, 0.5))
    else:
        designs = space.random(stream, count)
    means = arena.means(designs, fold(key, NOMINATION), episodes)
    champions = state.champions
    if episodes == EPISODES or not len(champions.tables):
        champions = with_champions(champions, designs, means)
    return replace(state, champions=champions, spent=state.spent + count * episodes)
