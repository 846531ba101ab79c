"""Pools of look-up tables and their genetic operators (V.B.2).

A pool is a uint8 array (population, n_cells) of 0 (No Action) to n_actions. `given` is a uint8 array
(n_cells,): the action that the spec gives a cell, or OPEN_CELL where it is to be evolved. Given cells never
change.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.jit import jit
from bbsd.kernel.streams import chance, fold, word_of
from bbsd.solver.draws import below

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.solver.settings import Breeding

OPEN_CELL = 255

FIRST_PARENT, SECOND_PARENT, MASK, HARD, RANDOM_TABLE, SOFT = range(6)  # the streams of one child
WHETHER, WHICH = range(2)  # the streams of one cell


def random_pool(key: int, population: int, given: NDArray[np.uint8], n_actions: int) -> NDArray[np.uint8]:
    """Tables drawn uniformly from all that agree with the given cells.

    Returns:
        (population, n_cells).
    """
    pool = np.tile(given, (population, 1))
    fill(np.uint64(key), pool, given, n_actions)
    return pool


def next_pool(
    key: int,
    pool: NDArray[np.uint8],
    fitness: NDArray[np.float64],
    n_actions: int,
    given: NDArray[np.uint8],
    breeding: Breeding,
) -> NDArray[np.uint8]:
    """The next generation of one pool: the fittest unchanged in the first slots, then children.

    Args:
        key: the stream of this pool in this generation.
        pool: (population, n_cells).
        fitness: (population,), -inf for an individual that took part in no agent.
        n_actions: |A|.
        given: (n_cells,).
        breeding: the settings of this generation.

    Returns:
        (population, n_cells).
    """
    elites = np.argsort(-fitness, kind="stable")[: breeding.elites]
    children = np.empty_like(pool)
    children[: len(elites)] = pool[elites]
    breed(
        np.uint64(key),
        pool,
        fitness,
        n_actions,
        given,
        len(elites),
        breeding.tournament,
        breeding.crossover,
        breeding.children,
        breeding.hard_mutation,
        breeding.soft_mutation,
        children,
    )
    return children


def expected_fitness(key: int, fitness: NDArray[np.float64], breeding: Breeding) -> NDArray[np.float64]:
    """What is expected of the individuals that `next_pool` makes of the same key.

    An elite's own fitness, a child's parents' mean; individuals that took part in no agent count as the worst.
    Arguments as of `next_pool`; returns (population,).
    """
    known = np.where(
        np.isfinite(fitness), fitness, np.min(fitness, where=np.isfinite(fitness), initial=np.inf)
    )
    elites = np.argsort(-fitness, kind="stable")[: breeding.elites]
    expected = np.empty_like(fitness)
    expected[: len(elites)] = known[elites]
    expect(np.uint64(key), fitness, known, len(elites), breeding.tournament, breeding.children, expected)
    return expected


@jit
def expect(
    key: np.uint64,
    fitness: NDArray[np.float64],
    known: NDArray[np.float64],
    n_elites: int,
    n_entrants: int,
    n_siblings: int,
    expected: NDArray[np.float64],
) -> None:
    """The mean of the parents that `breed` chooses with the same key, for each child."""
    for slot in range(n_elites, len(expected)):
        family = fold(int(key), word_of(slot - (slot - n_elites) % n_siblings))
        first = tournament(fold(family, word_of(FIRST_PARENT)), fitness, n_entrants)
        second = tournament(fold(family, word_of(SECOND_PARENT)), fitness, n_entrants)
        expected[slot] = (known[first] + known[second]) / 2.0


@jit
def fill(key: np.uint64, pool: NDArray[np.uint8], given: NDArray[np.uint8], n_actions: int) -> None:
    """Draw every open cell of every individual."""
    for individual in range(len(pool)):
        redraw(fold(int(key), word_of(individual)), pool[individual], given, n_actions, 1.0)


@jit
def breed(
    key: np.uint64,
    pool: NDArray[np.uint8],
    fitness: NDArray[np.float64],
    n_actions: int,
    given: NDArray[np.uint8],
    n_elites: int,
    n_entrants: int,
    p_crossover: float,
    n_siblings: int,
    p_hard: float,
    p_soft: float,
    children: NDArray[np.uint8],
) -> None:
    """Selection, crossover and mutation for each of `children` (population, n_cells) after the elites."""
    for slot in range(n_elites, len(children)):
        stream = fold(int(key), word_of(slot))
        child = children[slot]
        place = (slot - n_elites) % n_siblings
        family = fold(int(key), word_of(slot - place))
        first = tournament(fold(family, word_of(FIRST_PARENT)), fitness, n_entrants)
        second = tournament(fold(family, word_of(SECOND_PARENT)), fitness, n_entrants)
        if place == 1:  # the second child has the complement of the mask
            first, second = second, first
        crossover(fold(family, word_of(MASK)), pool[first], pool[second], p_crossover, child)
        if chance(stream, word_of(HARD), p_hard):
            redraw(fold(stream, word_of(RANDOM_TABLE)), child, given, n_actions, 1.0)
        redraw(fold(stream, word_of(SOFT)), child, given, n_actions, p_soft)


@jit
def tournament(key: int, fitness: NDArray[np.float64], n_entrants: int) -> int:
    """The fittest of individuals drawn with replacement; of equals the one with the lowest index."""
    winner = below(fold(int(key), word_of(0)), len(fitness))
    for entrant in range(1, n_entrants):
        rival = below(fold(int(key), word_of(entrant)), len(fitness))
        if fitness[rival] > fitness[winner] or (fitness[rival] == fitness[winner] and rival < winner):
            winner = rival
    return winner


@jit
def cross(x: int, a: int, b: int) -> int:
    """(19), of a cell or of whole tables: a where the mask x is 1, b where it is 0."""
    return x * a + (1 - x) * b


@jit
def crossover(
    key: int, first: NDArray[np.uint8], second: NDArray[np.uint8], p_first: float, child: NDArray[np.uint8]
) -> None:
    """(19) with a mask X of Bernoulli(p_c) cells, into `child`; all tables (n_cells,)."""
    for cell in range(len(child)):
        x = int(chance(int(key), word_of(cell), p_first))
        child[cell] = cross(x, first[cell], second[cell])


@jit
def redraw(
    key: int, table: NDArray[np.uint8], given: NDArray[np.uint8], n_actions: int, probability: float
) -> None:
    """Draw each open cell anew with the given probability, from No Action and all actions, in place.

    This is soft mutation; with probability 1 it is hard mutation, which keeps nothing but the given cells.
    """
    for cell in range(len(table)):
        stream = fold(int(key), word_of(cell))
        if given[cell] == OPEN_CELL and chance(stream, word_of(WHETHER), probability):
            table[cell] = below(fold(stream, word_of(WHICH)), n_actions + 1)
