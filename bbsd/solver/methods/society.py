"""A society of agents, the paper's loop (Fig. 4) repaired: how it gets from one generation to the next.

Agents live a few episodes, the same for all. They inherit memes, now and then changed, instead of learning structures
anew in each lifetime. Fitness is shared leniently. Some of the agents are the leader with one module exchanged: what
these earn is the fitness of that module alone. Who earned most is a challenger; it leads when it earns at least as much
as the leader in the next generation's episodes too, for which it was not chosen.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.evaluation import Agents
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.language.design import CultureSettings
from bbsd.solver.methods.founding import best_random, led
from bbsd.solver.paper.culture import Culture, draw_memes, empty_culture, take_in
from bbsd.solver.paper.genetics import Breeding, next_pool
from bbsd.solver.paper.pairing import members
from bbsd.solver.paper.sharing import lenient, lifetime_fitness
from bbsd.solver.space import Designs

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.solver.arena import Arena
    from bbsd.solver.space import Space

ORDERS, PAIRING, EXCHANGES, MEMES, CHANGES, LIFETIMES, BREEDING = (
    name_word(name) for name in ("orders", "pairing", "exchanges", "memes", "changes", "lives", "breeding")
)

BEST_AGENTS = 3
"""Agents of an individual whose mean is its fitness."""
MEME_MUTATION = 0.2
"""Probability that two behaviors of an inherited meme are exchanged."""
LEADERS_MODULE = 1
"""The slot of a pool that the leader's module has: behind the elite."""
CULTURE = CultureSettings()
GENETICS = Breeding(tournament=3, elites=1, crossover=0.5, children=1, hard_mutation=0.0, soft_mutation=0.0)
"""Without the rate of mutation: it is one cell in n, those of the behavior that are open."""


class Size(NamedTuple):
    """How large a society is."""

    population: int
    """Individuals in each pool."""
    paired: int
    """Agents of a generation whose individuals are paired at random."""
    exchanged: int
    """Agents of a generation that are the leader with one module exchanged."""

    @property
    def agents(self) -> int:
        """All agents of a generation, with the leader and the challenger."""
        return 2 + self.paired + self.exchanged


@dataclass(frozen=True, slots=True, eq=False)
class Society:
    """What a generation leaves to the next."""

    pools: NDArray[np.uint8]
    """The tables of all behaviors' individuals, (population, n_cells)."""
    culture: Culture
    leader: Designs
    """The agent whose modules others are tried with, one row."""
    challenger: Designs
    """The best other agent of the last generation, one row."""


def society_of(agents: Designs) -> Society:
    """Return a society of the modules of some agents, at least two, without a culture yet."""
    return Society(agents.tables, empty_culture(agents.structures.shape[1]), agents[:1], agents[1:2])


def first_society(arena: Arena, key: int, population: int, count: int, episodes: int) -> Society:
    """Return a society of known agents and the best of `count` random ones: modules, and structures as memes.

    It spends count * episodes episodes; count is at least the population, and that at least 2.
    """
    best, fitness = best_random(arena, key, count, episodes, population)
    best = led(best, arena.starts)  # which count as the best until they have lived
    society = society_of(best)
    return replace(society, culture=take_in(society.culture, best.structures, fitness, CULTURE))


def next_societies(
    societies: Sequence[Society], arena: Arena, key: int, size: Size, episodes: int
) -> tuple[tuple[Society, ...], NDArray[np.float64]]:
    """Take societies of the same size one generation further, side by side in the same episodes.

    Args:
        societies: at least one.
        arena: where the agents live.
        key: the generation's.
        size: of each society.
        episodes: of a lifetime.

    Returns:
        The societies, and the agents' returns (n_societies, n_agents, episodes), each leader's and challenger's first.
    """
    streams = [fold(key, word_of(index)) for index in range(len(societies))]
    teams = [
        agents_of_society(society, arena.space, stream, size)
        for society, stream in zip(societies, streams, strict=True)
    ]
    returns = arena.agents_returns(side_by_side(teams), fold(key, LIFETIMES), episodes)
    returns = returns.reshape(len(societies), size.agents, episodes)
    after = tuple(
        next_society(society, team, lifetime_fitness(earned), arena.space, fold(stream, BREEDING))
        for society, team, earned, stream in zip(societies, teams, returns, streams, strict=True)
    )
    return after, returns


def agents_of_society(society: Society, space: Space, key: int, size: Size) -> Agents:
    """Return the leader, the challenger, agents paired at random, and leaders with one module exchanged.

    In each pool the leader's and the challenger's modules stand behind the individuals.
    """
    population, known = len(society.pools), society.leader.joined(society.challenger)
    pools = space.by_behavior(np.concatenate([society.pools, known.tables]))
    anyone = [np.zeros(population)] * len(pools)
    paired = members(fold(key, PAIRING), anyone, size.paired)
    exchanged = np.full((size.exchanged, len(pools)), population)
    evolving = np.flatnonzero([space.problem.evolves(index) for index in range(len(pools))])
    if len(evolving):
        dealt = members(fold(key, EXCHANGES), anyone, -(-size.exchanged // len(evolving)))[:, evolving]
        behaviors = np.resize(evolving, size.exchanged)
        exchanged[np.arange(size.exchanged), behaviors] = dealt.ravel()[: size.exchanged]
    if len(society.culture):
        inherited = draw_memes(fold(key, MEMES), society.culture, size.paired, CULTURE.scaled)
    else:
        inherited = space.random_orders(fold(key, ORDERS), size.paired)
    orders = np.concatenate([inherited, np.repeat(society.leader.structures, size.exchanged, axis=0)])
    return Agents(
        pools,
        np.concatenate([np.full((1, len(pools)), population + own) for own in (0, 1)] + [paired, exchanged]),
        np.concatenate([known.structures, space.reordered(fold(key, CHANGES), orders, MEME_MUTATION)]),
    )


def side_by_side(teams: Sequence[Agents]) -> Agents:
    """Return the agents of several societies as those of one."""
    behind = np.cumsum([0, *(len(team.pools[0]) for team in teams)])
    return Agents(
        tuple(np.concatenate(pools) for pools in zip(*(team.pools for team in teams), strict=True)),
        np.concatenate([team.members + before for team, before in zip(teams, behind[:-1], strict=True)]),
        np.concatenate([team.structures for team in teams]),
    )


def next_society(
    society: Society, agents: Agents, fitness: NDArray[np.float64], space: Space, key: int
) -> Society:
    """Share the agents' fitness (n_agents,), take their structures into the culture, and breed the pools."""
    population = len(society.pools)
    shared = lenient(fitness, agents.members, population + 2, BEST_AGENTS)[:, :population]
    leader = agents.architecture(int(fitness[1] >= fitness[0]))
    challenger = agents.architecture(2 + int(np.argmax(fitness[2:])))
    pools = []
    for index, (pool, table) in enumerate(zip(agents.pools, space.problem.tables, strict=True)):
        children = pool[:population]
        if space.problem.evolves(index):
            genetics = GENETICS._replace(soft_mutation=1.0 / table.n_open)
            stream = fold(key, word_of(index))
            children = next_pool(stream, children, shared[index], table.n_actions, table.given, genetics)
            children[LEADERS_MODULE] = leader.tables[index]
        pools.append(children)
    culture = take_in(society.culture, agents.structures, fitness, CULTURE)
    return Society(
        np.concatenate(pools, axis=1), culture, space.designs([leader]), space.designs([challenger])
    )


def composed(society: Society) -> Designs:
    """Return the leader, and the best individuals of all pools under the fittest meme."""
    if not len(society.culture):
        return society.leader
    meme = society.culture.memes[int(np.argmax(society.culture.fitness))]
    return society.leader.joined(Designs(society.pools[:1], meme[None]))
