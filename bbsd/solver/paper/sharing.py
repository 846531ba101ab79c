"""Fitness of agents (14), and how it is shared among their behaviors (V.B.1).

Sums run in the order of episodes, layers and agents, so the same numbers give the same bits on every machine.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray


def agent_fitness(returns: NDArray[np.float64], last: int) -> NDArray[np.float64]:
    """Return (14), each agent's mean return over its last K episodes.

    Args:
        returns: (n_agents, n_episodes).
        last: K, from 1 to n_episodes.

    Returns:
        (n_agents,).
    """
    return in_order(returns.T[-last:]) / last


def lifetime_fitness(returns: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return each agent's mean return over all its episodes; shapes as in `agent_fitness`."""
    return agent_fitness(returns, returns.shape[1])


def uniform(fitness: NDArray[np.float64], members: NDArray[np.int64], population: int) -> NDArray[np.float64]:
    """Return individuals' fitness by (15): the mean fitness of the agents that each took part in.

    Args:
        fitness: the agents', (n_agents,).
        members: (n_agents, n_behaviors).
        population: individuals a pool.

    Returns:
        (n_behaviors, population), -inf for an individual that was never drawn.
    """
    return mean_of_agents(np.repeat(fitness[:, None], members.shape[1], axis=1), members, population)


def value_based(
    values: NDArray[np.float64], members: NDArray[np.int64], population: int
) -> NDArray[np.float64]:
    """Return individuals' fitness by (17): the mean contribution to the agents that each took part in.

    Args:
        values: Ṽ at the end of the lifetimes, (n_agents, n_layers, n_behaviors).
        members: (n_agents, n_behaviors).
        population: individuals a pool.

    Returns:
        (n_behaviors, population), -inf for an individual that was never drawn.
    """
    return mean_of_agents(contributions(values), members, population)


def difference_based(
    differences: NDArray[np.float64], members: NDArray[np.int64], population: int
) -> NDArray[np.float64]:
    """Return individuals' fitness by what each agent that they took part in earns less without them, as a mean.

    Args:
        differences: an agent's fitness minus what it earns in the same episodes with the behavior held to No Action,
            (n_agents, n_behaviors).
        members: (n_agents, n_behaviors).
        population: individuals a pool.

    Returns:
        (n_behaviors, population), -inf for an individual that was never drawn.
    """
    return mean_of_agents(differences, members, population)


def contributions(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (16), what each behavior contributes in all layers: its sum of Ṽ; (n_agents, n_behaviors)."""
    return in_order(values.swapaxes(0, 1))


def mean_of_agents(
    shares: NDArray[np.float64], members: NDArray[np.int64], population: int
) -> NDArray[np.float64]:
    """Return the mean of each individual's shares (n_agents, n_behaviors); (n_behaviors, population)."""
    fitness = np.full((members.shape[1], population), -np.inf)
    for behavior, individuals in enumerate(members.T):
        counts = np.bincount(individuals, minlength=population)
        sums = np.bincount(individuals, weights=shares[:, behavior], minlength=population)
        np.divide(sums, counts, out=fitness[behavior], where=counts > 0)
    return fitness


def lenient(
    fitness: NDArray[np.float64], members: NDArray[np.int64], population: int, best: int
) -> NDArray[np.float64]:
    """Return for each individual the mean fitness of its best agents: partners that fail tell nothing of it.

    Args:
        fitness: the agents', (n_agents,).
        members: (n_agents, n_behaviors).
        population: individuals a pool.
        best: how many agents of each individual count at most.

    Returns:
        (n_behaviors, population), -inf for an individual that was never drawn.
    """
    shared = np.full((members.shape[1], population), -np.inf)
    for behavior, individuals in enumerate(members.T):
        order = np.lexsort((-fitness, individuals))
        sorted_individuals = individuals[order]
        ranks = np.arange(len(order)) - np.searchsorted(sorted_individuals, sorted_individuals)
        counted = order[ranks < best]
        counts = np.bincount(individuals[counted], minlength=population)
        sums = np.bincount(individuals[counted], weights=fitness[counted], minlength=population)
        np.divide(sums, counts, out=shared[behavior], where=counts > 0)
    return shared


def in_order(terms: Iterable[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Return the elementwise sum of arrays, added first to last (`np.sum` chooses an order of its own)."""
    first, *others = terms
    total = first.copy()
    for term in others:
        total += term
    return total
