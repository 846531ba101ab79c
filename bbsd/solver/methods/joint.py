"""One genetic algorithm over whole designs, all tables and the order: what co-evolution must beat.

Tournaments, uniform crossover of cells, position-based crossover of orders (Syswerda 1991), mutation of one cell in n.
All designs of a generation have the same episodes, and the elite has new ones in each: luck does not survive.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.jit import jit
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import chance, fold, name_word, word_of
from bbsd.solver.champions import no_champions
from bbsd.solver.methods.founding import SHARE, best_random, led
from bbsd.solver.methods.method import Method, SearchState
from bbsd.solver.methods.nomination import CAPACITY, begun, nominated, with_rest_spent
from bbsd.solver.paper.sharing import lifetime_fitness
from bbsd.solver.space import Designs, uniforms

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.solver.arena import Arena
    from bbsd.solver.space import Space

FOUNDED, GENERATIONS, EPISODE, PARENTS, MASKS, ORDERS, MUTATION = (
    name_word(name)
    for name in ("founded", "generations", "episodes", "parents", "masks", "orders", "mutation")
)

FEWEST, MOST = 40, 200
"""Designs of a population."""
POPULATION_SHARE = 1 / 240
"""Of the budget, what a generation costs where that is neither too few nor too many designs."""
EPISODES = 5
"""Common episodes of a generation."""
TOURNAMENT = 3
ELITE = 0.05
"""Of a population, what is copied unchanged."""
ORDER_MUTATION = 0.2
"""Probability that two behaviors of a child's order are exchanged."""
ROUND_SHARE = 0.02
"""Of the budget, what a round spends at least."""
NOMINATED = 10
"""Designs that are nominated after a round."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JointState(SearchState):
    """The designs of the next generation."""

    planned: int
    """Episodes that the search was begun with."""
    population: Designs


def begin(arena: Arena, key: int, budget: int) -> JointState:
    """Return the state before the first round."""
    count = min(max(int(budget * POPULATION_SHARE) // EPISODES, FEWEST), MOST)
    return JointState(
        champions=no_champions(arena.problem, CAPACITY),
        planned=max(1, budget),
        population=led(arena.space.random(fold(key, FOUNDED), count), arena.starts),
    )


def advance(state: JointState, arena: Arena, key: int, budget: int) -> JointState:
    """Breed some generations and nominate the best designs of the last."""
    state = begun(state, arena, key, budget)
    stream, left = fold(fold(key, GENERATIONS), word_of(state.round)), budget - state.spent
    tried = int(SHARE * state.planned) // EPISODES
    if state.round == 0 and len(state.population) <= tried <= left // EPISODES:
        return founded(state, arena, key, tried, left)
    cost = len(state.population) * EPISODES
    generations = min(int(ROUND_SHARE * state.planned) // cost or 1, left // cost)
    if not generations:
        return with_rest_spent(replace(state, round=state.round + 1), arena, key, left)
    population = state.population
    for generation in range(generations):
        own = fold(stream, word_of(generation))
        fitness = lifetime_fitness(arena.returns(population, fold(own, EPISODE), EPISODES))
        ranked = population[np.argsort(-fitness, kind="stable")]
        population = next_population(ranked, arena.space, own)
    spent = state.spent + generations * cost
    state = replace(state, round=state.round + 1, spent=spent, population=population)
    return nominated(state, arena, key, ranked[:NOMINATED], budget - spent)


def founded(state: JointState, arena: Arena, key: int, count: int, left: int) -> JointState:
    """Make the best of so many random designs the population."""
    size, spent = len(state.population), count * EPISODES
    population, _ = best_random(arena, fold(key, FOUNDED), count, EPISODES, size)
    population = led(population, arena.starts)
    state = replace(state, round=1, spent=state.spent + spent, population=population)
    return nominated(state, arena, key, population[:NOMINATED], left - spent)


def next_population(ranked: Designs, space: Space, key: int) -> Designs:
    """Return the next generation of designs, given this one with the fittest first: the elite, then children."""
    n_elite = max(1, int(len(ranked) * ELITE))
    n_children = len(ranked) - n_elite
    entrants = uniforms(fold(key, PARENTS), (2, n_children, TOURNAMENT)) * len(ranked)
    first, second = (ranked[parents] for parents in entrants.astype(np.int64).min(axis=2))
    from_first = uniforms(fold(key, MASKS), first.tables.shape) < 0.5
    tables = np.where(from_first, first.tables, second.tables)
    structures = crossed_orders(fold(key, ORDERS), space, first.structures, second.structures)
    stream = fold(key, MUTATION)
    children = space.mutated(stream, Designs(tables, structures), 1.0 / max(1, len(space.open_cells)))
    orders = space.reordered(stream, children.structures, ORDER_MUTATION)
    return ranked[:n_elite].joined(Designs(children.tables, orders))


def crossed_orders(
    key: int, space: Space, first: NDArray[np.int64], second: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return structures that keep each open layer of the first with probability 1/2, all (n, n_layers).

    The other open layers have the behaviors that are left, in the order of the second, then in that of the first.
    """
    holes, children = space.open_layers, first.copy()
    hands = np.empty((len(first), len(holes)), np.int64)
    deal(keys(key, 0, len(first)), first[:, holes], second[:, holes], space.problem.n_behaviors, hands)
    children[:, holes] = hands
    return children


@jit
def deal(
    streams: NDArray[np.uint64],
    first: NDArray[np.int64],
    second: NDArray[np.int64],
    n_behaviors: int,
    children: NDArray[np.int64],
) -> None:
    """Write into `children` the behaviors in the open layers of `crossed_orders`, all (n, n_open_layers)."""
    n_holes = first.shape[1]
    used = np.empty(n_behaviors, np.bool_)
    for row in range(len(first)):
        used[:] = False
        for hole in range(n_holes):
            children[row, hole] = -1
            if chance(int(streams[row]), word_of(hole), 0.5):
                children[row, hole] = first[row, hole]
                used[first[row, hole]] = True
        donor = 0
        for hole in range(n_holes):
            while children[row, hole] < 0:
                behavior = second[row, donor] if donor < n_holes else first[row, donor - n_holes]
                donor += 1
                if not used[behavior]:
                    children[row, hole] = behavior
                    used[behavior] = True


METHOD = Method("joint", begin, advance)
