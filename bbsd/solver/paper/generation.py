"""The loop of Fig. 4: one generation, from the state that it begins with to the state that it leaves to the next."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation import Agents
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.champions import Champions, no_champions
from bbsd.solver.paper import sharing
from bbsd.solver.paper.culture import Culture, draw_memes, empty_culture, take_in
from bbsd.solver.paper.genetics import expected_fitness, next_pool, random_pool
from bbsd.solver.paper.lifetime import Lifetimes, run_lifetimes
from bbsd.solver.paper.pairing import members
from bbsd.solver.space import Space
from bbsd.solver.structures import random_structures

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler import Pool, Problem
    from bbsd.solver.paper.settings import Settings
    from bbsd.solver.space import Designs

POOLS, PAIRING, BIRTH, MEMES, LIFETIMES, BREEDING = (
    name_word(name) for name in ("pools", "pairing", "birth", "memes", "lives", "breeding")
)


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """Everything that a generation leaves to the next. Generation 0 is the state before the first."""

    generation: int
    pools: tuple[Pool, ...]
    """The pools of which this generation's agents were made."""
    fitness: NDArray[np.float64]
    """The shared fitness of their individuals, (n_behaviors, largest population)."""
    culture: Culture
    champions: Champions
    """The fittest agents of all generations so far."""
    improved: int = 0
    """The generation of the fittest agent so far."""
    ended: int = 0
    """Why the run ended before its last generation, by its number in `ENDINGS`."""


@dataclass(frozen=True, slots=True, eq=False)
class Census:
    """The agents of one generation: fitness (14) and lifetime fitness (n_agents,), and final structures."""

    fitness: NDArray[np.float64]
    lifetime_fitness: NDArray[np.float64]
    structures: NDArray[np.int64]


def initial_state(problem: Problem, settings: Settings, key: int) -> State:
    """Initialize n different behavior pools and an empty culture.

    A behavior without open cells gets a pool of one individual.
    """
    pools = tuple(
        random_pool(
            fold(fold(key, POOLS), word_of(index)),
            settings.coevolution.population if problem.evolves(index) else 1,
            table.given,
            table.n_actions,
        )
        for index, table in enumerate(problem.tables)
    )
    known = known_agents(problem, settings, key)
    if known is not None:
        for pool, tables in zip(pools, Space(problem).by_behavior(known.tables), strict=True):
            pool[:] = np.concatenate([tables, pool])[: len(pool)]
    unknown = np.zeros((len(pools), settings.coevolution.population))
    culture = empty_culture(len(problem.layers))
    return State(0, pools, unknown, culture, no_champions(problem, settings.answer.candidates))


def known_agents(problem: Problem, settings: Settings, run_key: int) -> Designs | None:
    """Return the known designs that a run begins with, at most as many as agents and individuals; None of none."""
    if settings.starts is None:
        return None
    evolved = settings.coevolution
    return settings.starts.drawn(Space(problem), run_key)[: min(evolved.population, evolved.agents)]


def next_generation(state: State, problem: Problem, settings: Settings, run_key: int) -> tuple[State, Census]:
    """Go once around the loop of Fig. 4 and return the new state, and what the agents achieved.

    The genetic operators come first here, since a state keeps pools beside the fitness of their individuals.
    """
    generation = state.generation + 1
    key = fold(run_key, word_of(generation))

    pools, expected = state.pools, [np.zeros(len(pool)) for pool in state.pools]
    if generation > 1:
        pools, expected = breed_pools(state, problem, settings, fold(key, BREEDING))
    # Select n different behavior modules, one from each pool; select a meme, the initial structure.
    chosen = members(fold(key, PAIRING), expected, settings.coevolution.agents, settings.coevolution.pairing)
    structures = initial_structures(state.culture, problem, settings, key, len(chosen))
    known = known_agents(problem, settings, run_key) if generation == 1 else None
    if known is not None:
        # The individuals of a known design stand first in the pools, and meet in an agent.
        structures[: len(known)] = known.structures
        for index, pool in enumerate(pools):
            chosen[: len(known), index] = np.minimum(np.arange(len(known)), len(pool) - 1)
    agents = Agents(pools, chosen, structures)
    # For a lifetime: choose T* (9), interact, receive reinforcement, update the values (13).
    streams = keys(fold(key, LIFETIMES), 0, len(agents))
    lifetimes = run_lifetimes(problem, agents, streams, generation, settings)
    # Return fitness (14) and the final structure; share fitness to behaviors by (15), (17) or differences.
    fitness = sharing.agent_fitness(lifetimes.returns, settings.learning.last)
    shared = share(fitness, lifetimes, chosen, settings)
    # Update the meme pool using T* and its fitness (22).
    culture = state.culture
    if settings.culture is not None:
        if known is not None:
            culture = take_in(culture, known.structures, fitness[: len(known)], settings.culture)
        culture = take_in(culture, lifetimes.structures, fitness, settings.culture)

    champions = state.champions.joined(agents.with_structures(lifetimes.structures), fitness)
    census = Census(fitness, sharing.lifetime_fitness(lifetimes.returns), lifetimes.structures)
    is_better = not len(state.champions.fitness) or champions.fitness[0] > state.champions.fitness[0]
    improved = generation if is_better else state.improved
    return State(generation, pools, shared, culture, champions, improved), census


def initial_structures(
    culture: Culture, problem: Problem, settings: Settings, key: int, n_agents: int
) -> NDArray[np.int64]:
    """Return the structure of each newborn agent: a meme where there is any, else a random one."""
    if settings.culture is not None and len(culture):
        return draw_memes(fold(key, MEMES), culture, n_agents, settings.culture.scaled)
    return random_structures(keys(fold(key, BIRTH), 0, n_agents), problem.layers, problem.candidates)


def share(
    fitness: NDArray[np.float64], lifetimes: Lifetimes, members: NDArray[np.int64], settings: Settings
) -> NDArray[np.float64]:
    """Return the fitness of individuals (n_behaviors, population) by the sharing policy."""
    if settings.sharing == "uniform":
        return sharing.uniform(fitness, members, settings.coevolution.population)
    if lifetimes.differences is not None:
        return sharing.difference_based(lifetimes.differences, members, settings.coevolution.population)
    return sharing.value_based(lifetimes.values, members, settings.coevolution.population)


def breed_pools(
    state: State, problem: Problem, settings: Settings, key: int
) -> tuple[tuple[Pool, ...], list[NDArray[np.float64]]]:
    """Apply selection, crossover and mutation to each pool, at the rates of the generation that ended.

    Returns the pools, and the fitness expected of their individuals, (population,) each.
    """
    breeding = settings.breeding(state.generation)
    pools: list[Pool] = []
    expected = []
    for index, (pool, table) in enumerate(zip(state.pools, problem.tables, strict=True)):
        stream, fitness = fold(key, word_of(index)), state.fitness[index, : len(pool)]
        if problem.evolves(index):
            pools.append(next_pool(stream, pool, fitness, table.n_actions, table.given, breeding))
            expected.append(expected_fitness(stream, fitness, breeding))
        else:
            pools.append(pool)
            expected.append(np.zeros(len(pool)))
    return tuple(pools), expected
