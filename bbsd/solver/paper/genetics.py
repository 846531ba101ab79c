"""Pools of look-up tables and their genetic operators (V.B.2).

A pool is a uint8 array (population, n_cells) of 0 (No Action) to n_actions. `given` is a uint8 array
(n_cells,): the action that the spec gives a cell, or OPEN_CELL where it is to be evolved. Given cells never
change.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.kernel.jit import jit
from bbsd.kernel.streams import chance, fold, word_of
from bbsd.solver.draws import below

if TYPE_CHECKING:
    from numpy.typing import NDArray

OPEN_CELL = 255

FIRST_PARENT, SECOND_PARENT, MASK, HARD, RANDOM_TABLE, SOFT = range(6)  # the streams of one child
WHETHER, WHICH = range(2)  # the streams of one cell


class Breeding(NamedTuple):
    """The settings of the genetic operators in one generation (V.B.2), for compiled code."""

    tournament: int
    """Individuals that compete to be a parent."""
    elites: int
    """Fittest individuals that are copied unchanged."""
    crossover: float
    """p_c, the probability that a cell comes from the first parent."""
    children: int
    """Of a pair of parents: 1, or 2 with complementary masks."""
    hard_mutation: float
    """p_hard, of a child."""
    soft_mutation: float
    """p_soft, of a cell."""


def random_pool(key: int, population: int, given: NDArray[np.uint8], n_actions: int) -> NDArray[np.uint8]:
    """Return tables drawn uniformly from all that agree with the given cells.

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
    """Return the next generation of one pool: the fittest unchanged in the first slots, then children.

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
    breed(np.uint64(key), pool, fitness, n_actions, given, breeding, children)
    return children


def expected_fitness(key: int, fitness: NDArray[np.float64], breeding: Breeding) -> NDArray[np.float64]:
    """Return the fitness expected of each individual that `next_pool` makes from the same key, (population,).

    It is an elite's own fitness, or the mean of a child's parents; an individual that took part in no agent counts as
    the worst. Arguments as of `next_pool`.
    """
    known = np.where(
        np.isfinite(fitness), fitness, np.min(fitness, where=np.isfinite(fitness), initial=np.inf)
    )
    elites = np.argsort(-fitness, kind="stable")[: breeding.elites]
    expected = np.empty_like(fitness)
    expected[: len(elites)] = known[elites]
    expect(np.uint64(key), fitness, known, breeding, expected)
    return expected


@jit
def expect(
    key: np.uint64,
    fitness: NDArray[np.float64],
    known: NDArray[np.float64],
    breeding: Breeding,
    expected: NDArray[np.float64],
) -> None:
    """Write into `expected`, for each child, the mean fitness of the parents that `breed` chooses by the same key."""
    for slot in range(breeding.elites, len(expected)):
        sibling = (slot - breeding.elites) % breeding.children
        family = fold(int(key), word_of(slot - sibling))
        first = tournament(fold(family, word_of(FIRST_PARENT)), fitness, breeding.tournament)
        second = tournament(fold(family, word_of(SECOND_PARENT)), fitness, breeding.tournament)
        expected[slot] = (known[first] + known[second]) / 2.0


@jit
def fill(key: np.uint64, pool: NDArray[np.uint8], given: NDArray[np.uint8], n_actions: int) -> None:
    """Draw every open cell of every individual of `pool`, in place."""
    for individual in range(len(pool)):
        redraw(fold(int(key), word_of(individual)), pool[individual], given, n_actions, 1.0)


@jit
def breed(
    key: np.uint64,
    pool: NDArray[np.uint8],
    fitness: NDArray[np.float64],
    n_actions: int,
    given: NDArray[np.uint8],
    breeding: Breeding,
    children: NDArray[np.uint8],
) -> None:
    """Apply selection, crossover and mutation for each of `children` (population, n_cells) after the elites."""
    for slot in range(breeding.elites, len(children)):
        stream = fold(int(key), word_of(slot))
        child = children[slot]
        sibling = (slot - breeding.elites) % breeding.children
        family = fold(int(key), word_of(slot - sibling))
        first = tournament(fold(family, word_of(FIRST_PARENT)), fitness, breeding.tournament)
        second = tournament(fold(family, word_of(SECOND_PARENT)), fitness, breeding.tournament)
        if sibling == 1:  # the second child has the complement of the mask
            first, second = second, first
        crossover(fold(family, word_of(MASK)), pool[first], pool[second], breeding.crossover, child)
        if chance(stream, word_of(HARD), breeding.hard_mutation):
            redraw(fold(stream, word_of(RANDOM_TABLE)), child, given, n_actions, 1.0)
        redraw(fold(stream, word_of(SOFT)), child, given, n_actions, breeding.soft_mutation)


@jit
def tournament(key: int, fitness: NDArray[np.float64], n_entrants: int) -> int:
    """Return the fittest of individuals drawn with replacement; of equals the one with the lowest index."""
    winner = below(fold(int(key), word_of(0)), len(fitness))
    for entrant in range(1, n_entrants):
        rival = below(fold(int(key), word_of(entrant)), len(fitness))
        if fitness[rival] > fitness[winner] or (fitness[rival] == fitness[winner] and rival < winner):
            winner = rival
    return winner


@jit
def cross(x: int, a: int, b: int) -> int:
    """Return (19) for a cell or for whole tables: a where the mask x is 1, b where it is 0."""
    return x * a + (1 - x) * b


@jit
def crossover(
    key: int, first: NDArray[np.uint8], second: NDArray[np.uint8], p_first: float, child: NDArray[np.uint8]
) -> None:
    """Write into `child` (19) with a mask X of Bernoulli(p_c) cells; all tables (n_cells,)."""
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
