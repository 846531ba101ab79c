"""The default method: a portfolio of searches on one budget, whose best designs are bred, and climb.

Each search is good where another is not: societies where returns tell designs apart, practice where nothing is earned
until choices vary within an episode, Q-learning where the joint cell tells the state. All get an opening. With a large
budget, the one whose best design earns most in common episodes gets further runs: restarts find other local optima.
Then the best designs of all become the population of the joint genetic algorithm, and the best of all climb until no
single change helps. Q-learning is left out where its table would be too large.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.champions import no_champions
from bbsd.solver.climb import Climb, advance_climb, begin_climb
from bbsd.solver.methods import joint, practice, random_search, societies
from bbsd.solver.methods.founding import led
from bbsd.solver.methods.method import Method, SearchState, with_champions
from bbsd.solver.methods.nomination import CAPACITY, begun, nominated, with_rest_spent
from bbsd.solver.methods.q_learning import q_learning
from bbsd.solver.space import Designs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.solver.arena import Arena

OPENINGS = (
    (random_search.METHOD, 0.02),
    (societies.METHOD, 0.19),
    (practice.METHOD, 0.08),
    (q_learning.METHOD, 0.12),
)
"""The searches in their order, and the share of the budget that each begins with."""
FEW = 60_000
FEW_OPENINGS = (
    (random_search.METHOD, 0.02),
    (societies.METHOD, 0.10),
    (q_learning.METHOD, 0.20),
)
"""With a budget below that, those that need the fewest episodes."""
LEARNED_SHARE, FEW_LEARNED_SHARE = 0.15, 0.10
"""Of the budget, what Q-learning goes on for where it leads after the openings."""
FURTHER_SHARE, LONGEST_FURTHER = 0.22, 180_000
"""Of the budget, what a further run of the leading search gets, and its episodes at most.

With 14 % of 400,000 to 600,000 episodes, pursuit and forager came to worse designs; with 22 % of 1,300,000 lifting did.
"""
MOST_BRED = 150_000
"""Episodes of breeding at most; a larger budget is spent on further runs before."""
BRED_UNTIL, FEW_BRED_UNTIL = 0.85, 0.96
"""Share of the budget that is spent when breeding ends and climbs begin, which need many episodes."""
NOMINEES = 12
"""Designs of a run that take part in the common episodes."""
MANY, MANY_NOMINEES = 1_000_000, 50
"""With a budget of so many episodes, there are more of them.

Of 1,300,000 on lifting, runs found the best known design in three of twenty seeds where it was not in their first 12.
"""
CLIMBS = 3
"""Designs that climb, each to its optimum, before another run is worth more."""
LEAST_SHARE = 0.08
"""Of the budget, what must be left for another run and its climb."""

OPENING, RUN, COMMON, BREEDING, FINISH, TEMPLATE = (
    name_word(name) for name in ("opening", "run", "common episodes", "breeding", "finish", "template")
)


@dataclass(frozen=True, eq=False, kw_only=True)
class AutoState(SearchState):
    """The searches, the breeding of what they found, and the climb of a good design."""

    planned_in_all: int
    """Episodes that the search was begun with."""
    searches: tuple[SearchState, ...]
    """The present or last run of each; the last one is breeding."""
    planned: NDArray[np.int64]
    """Episodes of these runs, (n_searches,)."""
    runs: NDArray[np.int64]
    """Runs of each search that are over, (n_searches,)."""
    best: NDArray[np.float64]
    """What the best design of each earns in the common episodes, -inf before its first run is over, (n_searches,)."""
    turn: int = 0
    """The search that has its turn; their number while designs climb."""
    climb: Climb
    climbs: int = 0
    """Climbs since the last run."""
    climbing: bool = False
    """Whether a climb was begun and is not over."""
    tried_tables: NDArray[np.uint8]
    """Designs from which a climb began, or at which one ended, (n, n_cells)."""
    tried_structures: NDArray[np.int64]
    """(n, n_layers)."""


def openings(arena: Arena, budget: int) -> tuple[tuple[Method, float], ...]:
    """Return the searches that a problem and a budget allow, and the share of the budget that each begins with."""
    return tuple(
        (method, share)
        for method, share in (FEW_OPENINGS if budget < FEW else OPENINGS)
        if method is not q_learning.METHOD or q_learning.has_room(arena)
    )


def begin(arena: Arena, key: int, budget: int) -> AutoState:
    """Return the state before the first round."""
    stream = fold(key, OPENING)
    planned = [*(max(1, int(share * budget)) for _, share in openings(arena, budget)), 0]
    searches = tuple(
        method.begin(arena, _run_key(key, index, 0), planned[index])
        for index, method in enumerate(_methods(arena, budget))
    )
    some = arena.space.random(fold(stream, TEMPLATE), 1)
    return AutoState(
        champions=no_champions(arena.problem, CAPACITY),
        planned_in_all=budget,
        searches=searches,
        planned=np.array(planned, np.int64),
        runs=np.zeros(len(planned), np.int64),
        best=np.full(len(planned), -np.inf),
        climb=begin_climb(some),
        tried_tables=some.tables[:0],
        tried_structures=some.structures[:0],
    )


def _methods(arena: Arena, budget: int) -> list[Method]:
    return [*(method for method, _ in openings(arena, budget)), joint.METHOD]


def _run_key(key: int, search: int, run: int) -> int:
    return fold(fold(fold(key, RUN), word_of(search)), word_of(run))


def advance(state: AutoState, arena: Arena, key: int, budget: int) -> AutoState:
    """Take the search that has its turn, or the climb, a round further."""
    state = begun(state, arena, fold(key, COMMON), budget)
    further = _search_round if state.turn < len(state.searches) else _climb_round
    after = further(state, arena, key, budget)
    if after.spent == state.spent and after.spent < budget:
        after = with_rest_spent(after, arena, fold(key, COMMON), min(budget - after.spent, budget // 100 + 1))
    if after.spent >= budget and not len(after.champions.tables):
        after = _with_own_champions(after)
    return replace(after, round=state.round + 1)


def _search_round(state: AutoState, arena: Arena, key: int, budget: int) -> AutoState:
    index = state.turn
    search, method = state.searches[index], _methods(arena, state.planned_in_all)[index]
    most = min(int(state.planned[index]), search.spent + budget - state.spent)
    begins_known = not state.runs[index] and method is not random_search.METHOD
    where = arena if begins_known else arena.afresh
    after = method.advance(search, where, _run_key(key, index, int(state.runs[index])), most)
    searches = (*state.searches[:index], after, *state.searches[index + 1 :])
    state = replace(state, searches=searches, spent=state.spent + after.spent - search.spent)
    return state if after.spent < most else _after_run(state, arena, key, budget)


def _with_own_champions(state: AutoState) -> AutoState:
    """Take over what the searches know, where there were too few episodes for common ones."""
    champions = state.champions
    for search in state.searches:
        own = search.champions
        champions = with_champions(champions, Designs(own.tables, own.structures), own.fitness)
    return replace(state, champions=champions)


def _after_run(state: AutoState, arena: Arena, key: int, budget: int) -> AutoState:
    """Let the best designs of a run that is over take part in the common episodes, and give the next turn."""
    index, champions = state.turn, state.searches[state.turn].champions
    most = NOMINEES if state.planned_in_all < MANY else MANY_NOMINEES
    nominees = _found(Designs(champions.tables, champions.structures), arena)[:most]
    state = nominated(state, arena, fold(key, COMMON), nominees, budget - state.spent)
    best, runs = state.best.copy(), state.runs.copy()
    best[index] = max(best[index], _best_of(state, nominees))
    runs[index] += 1
    state = replace(state, best=best, runs=runs)
    if index + 2 < len(state.searches) and not runs[index + 1] and _is_promising(state, arena, index + 1):
        return replace(state, turn=index + 1)
    return _after_openings(state, arena, key, budget)


def _after_openings(state: AutoState, arena: Arena, key: int, budget: int) -> AutoState:
    """Give the next turn: to Q-learning where it leads, to a further run, to breeding, or to climbs."""
    is_few, breeding = state.planned_in_all < FEW, len(state.searches) - 1
    leader, methods = _leader(state.best[:breeding]), _methods(arena, state.planned_in_all)
    until = int((FEW_BRED_UNTIL if is_few else BRED_UNTIL) * budget)
    learns = methods[leader] is q_learning.METHOD
    if learns and state.runs[leader] == 1:
        share = FEW_LEARNED_SHARE if is_few else LEARNED_SHARE
        return _with_more(state, leader, max(int(share * budget), until - MOST_BRED - state.spent))
    if state.spent < until - MOST_BRED and not learns:
        return _with_further_run(state, arena, key, min(int(FURTHER_SHARE * budget), LONGEST_FURTHER))
    if state.spent < until and not state.runs[breeding]:
        return _with_breeding(state, arena, fold(key, BREEDING), until - state.spent)
    return replace(state, turn=len(state.searches), climbs=0)


def _with_more(state: AutoState, index: int, episodes: int) -> AutoState:
    """Let a search go on."""
    planned = state.planned.copy()
    planned[index] = state.searches[index].spent + max(1, episodes)
    return replace(state, planned=planned, turn=index)


def _with_breeding(state: AutoState, arena: Arena, key: int, episodes: int) -> AutoState:
    """Begin the joint genetic algorithm with the best designs of each search, and random ones where these are few."""
    search = joint.begin(arena, key, episodes)
    size = len(search.population)
    found = [(search.champions.tables, search.champions.structures) for search in state.searches[:-1]]
    rows = [
        (rank, index) for index, (tables, _) in enumerate(found) for rank in range(min(size, len(tables)))
    ]
    best = [
        Designs(found[index][0][rank : rank + 1], found[index][1][rank : rank + 1])
        for rank, index in sorted(rows)[:size]
    ]
    population = best[0].joined(*best[1:], search.population)[np.arange(size)] if best else search.population
    search = replace(search, population=led(population, arena.starts), round=1)
    return _with_more(
        replace(state, searches=(*state.searches[:-1], search)), len(state.searches) - 1, episodes
    )


def _found(designs: Designs, arena: Arena) -> Designs:
    """Return the designs that were found, without those with which all searches began."""
    if arena.starts is None:
        return designs
    known = {_bytes_of(arena.starts, index) for index in range(len(arena.starts))}
    return designs[np.array([_bytes_of(designs, index) not in known for index in range(len(designs))], bool)]


def _is_promising(state: AutoState, arena: Arena, index: int) -> bool:
    """Tell whether a search that has not begun should.

    Practice and Q-learning both learn what joint cells are worth; where practice trails, those hide too much.
    """
    methods = _methods(arena, state.planned_in_all)
    if methods[index] is not q_learning.METHOD or practice.METHOD not in methods:
        return True
    return bool(state.best[methods.index(practice.METHOD)] == state.best.max())


def _leader(best: NDArray[np.float64]) -> int:
    """Return the search whose best design earns most; of equals the last, as practice needs no difference to begin."""
    return len(best) - 1 - int(np.argmax(best[::-1]))


def _best_of(state: AutoState, designs: Designs) -> float:
    """Return what the best of some designs earned in the common episodes, as far as they are champions."""
    rows = {_bytes_of(designs, index) for index in range(len(designs))}
    champions = Designs(state.champions.tables, state.champions.structures)
    earned = [
        float(state.champions.fitness[index])
        for index in range(len(champions))
        if _bytes_of(champions, index) in rows
    ]
    return max(earned, default=-np.inf)


def _bytes_of(designs: Designs, index: int) -> bytes:
    row: bytes = designs.tables[index].tobytes() + designs.structures[index].tobytes()
    return row


def _with_further_run(state: AutoState, arena: Arena, key: int, episodes: int) -> AutoState:
    """Begin a new run of the leading search."""
    index = _leader(state.best[:-1])
    planned = state.planned.copy()
    planned[index] = max(1, episodes)
    fresh = _methods(arena, state.planned_in_all)[index].begin(
        arena.afresh, _run_key(key, index, int(state.runs[index])), int(planned[index])
    )
    searches = (*state.searches[:index], fresh, *state.searches[index + 1 :])
    return replace(state, searches=searches, planned=planned, turn=index)


def _climb_round(state: AutoState, arena: Arena, key: int, budget: int) -> AutoState:
    if not state.climbing:
        start = _next_climber(state)
        left = budget - state.spent
        if start is None or (state.climbs >= CLIMBS and left > LEAST_SHARE * budget):
            return _with_further_run(state, arena, key, int(0.6 * left))
        state = replace(_with_tried(state, start), climb=begin_climb(start), climbing=True)
    climb = state.climb
    stream = fold(fold(key, FINISH), word_of(len(state.tried_tables)))
    after = advance_climb(climb, arena, stream, climb.spent + budget - state.spent)
    state = replace(state, climb=after, spent=state.spent + after.spent - climb.spent)
    if after.at_optimum or state.spent >= budget:
        state = nominated(state, arena, fold(key, COMMON), after.design, budget - state.spent)
        state = replace(_with_tried(state, after.design), climbs=state.climbs + 1, climbing=False)
    return state


def _next_climber(state: AutoState) -> Designs | None:
    """Return the best champion from which no climb began and at which none ended."""
    tried = Designs(state.tried_tables, state.tried_structures)
    known = {_bytes_of(tried, index) for index in range(len(tried))}
    champions = Designs(state.champions.tables, state.champions.structures)
    for index in range(len(champions)):
        if _bytes_of(champions, index) not in known:
            return champions[index : index + 1]
    return None


def _with_tried(state: AutoState, design: Designs) -> AutoState:
    return replace(
        state,
        tried_tables=np.concatenate([state.tried_tables, design.tables]),
        tried_structures=np.concatenate([state.tried_structures, design.structures]),
    )


METHOD = Method("auto", begin, advance)
