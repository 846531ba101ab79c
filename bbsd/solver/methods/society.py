"""A society of agents, the paper's loop (Fig. 4) repaired: how it gets from one generation to the next.

Agents live a few episodes, the same for all. They inherit memes, now and then changed, instead of learning structures
anew in each lifetime. Fitness is shared leniently. Half of the agents are the leader, which is the best agent of the
generation before, with one module exchanged: what these earn is the fitness of that module alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.evaluation import Agents
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.language.design import CultureSettings
from bbsd.solver.culture import Culture, draw_memes, empty_culture, take_in
from bbsd.solver.genetics import Breeding, next_pool
from bbsd.solver.pairing import members
from bbsd.solver.sharing import lenient, lifetime_fitness
from bbsd.solver.space import Designs

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.solver.arena import Arena
    from bbsd.solver.space import Space

POOLS, ORDERS, PAIRING, EXCHANGES, MEMES, CHANGES, LIFETIMES, BREEDING = (
    name_word(name)
    for name in ("pools", "orders", "pairing", "exchanges", "memes", "changes", "lives", "breeding")
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
    """How many individuals each pool of a society has, and how many agents beside the leader a generation."""

    population: int
    agents: int


@dataclass(frozen=True, slots=True, eq=False)
class Society:
    """What a generation leaves to the next."""

    pools: NDArray[np.uint8]
    """The tables of all behaviors' individuals, (population, n_cells)."""
    culture: Culture
    leader: Designs
    """The best agent of the last generation, one row."""


def first_society(space: Space, key: int, population: int) -> Society:
    """Return a society of random individuals; its leader is a random agent."""
    pools = space.random(fold(key, POOLS), population).tables
    leader = Designs(pools[:1], space.random_orders(fold(key, ORDERS), 1))
    return Society(pools, empty_culture(leader.structures.shape[1]), leader)


def next_societies(
    societies: Sequence[Society], arena: Arena, key: int, n_agents: int, episodes: int
) -> tuple[tuple[Society, ...], NDArray[np.float64]]:
    """Take societies of the same size one generation further, side by side in the same episodes.

    Args:
        societies: at least one.
        arena: where the agents live.
        key: the generation's.
        n_agents: of each society, beside its leader.
        episodes: of a lifetime.

    Returns:
        The societies, and the agents' returns (n_societies, 1 + n_agents, episodes), each leader's first.
    """
    streams = [fold(key, word_of(index)) for index in range(len(societies))]
    teams = [
        agents_of_society(society, arena.space, stream, n_agents)
        for society, stream in zip(societies, streams, strict=True)
    ]
    returns = arena.agents_returns(side_by_side(teams), fold(key, LIFETIMES), episodes)
    returns = returns.reshape(len(societies), 1 + n_agents, episodes)
    after = tuple(
        next_society(society, team, lifetime_fitness(earned), arena.space, fold(stream, BREEDING))
        for society, team, earned, stream in zip(societies, teams, returns, streams, strict=True)
    )
    return after, returns


def agents_of_society(society: Society, space: Space, key: int, n_agents: int) -> Agents:
    """Return the leader, agents of individuals that are paired at random, and leaders with a module exchanged.

    In each pool the leader's module stands behind the individuals.
    """
    population, leaders = len(society.pools), society.leader
    n_exchanged = n_agents // 2
    pools = space.by_behavior(np.concatenate([society.pools, leaders.tables]))
    anyone = [np.zeros(population)] * len(pools)
    paired = members(fold(key, PAIRING), anyone, n_agents - n_exchanged)
    exchanged = np.full((1 + n_exchanged, len(pools)), population)
    evolving = np.flatnonzero([space.problem.evolves(index) for index in range(len(pools))])
    if n_exchanged and len(evolving):
        dealt = members(fold(key, EXCHANGES), anyone, -(-n_exchanged // len(evolving)))[:, evolving]
        agents, behaviors = np.arange(1, 1 + n_exchanged), np.resize(evolving, n_exchanged)
        exchanged[agents, behaviors] = dealt.ravel()[:n_exchanged]
    memes = leaders.structures[np.zeros(n_agents, np.int64)]
    if len(society.culture):
        inherited = draw_memes(fold(key, MEMES), society.culture, len(paired), CULTURE.scaled)
    else:
        inherited = space.random_orders(fold(key, ORDERS), len(paired))
    memes[: len(paired)] = inherited
    structures = space.reordered(fold(key, CHANGES), memes, MEME_MUTATION)
    return Agents(
        pools,
        np.concatenate([exchanged[:1], paired, exchanged[1:]]),
        np.concatenate([leaders.structures, structures]),
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
    shared = lenient(fitness, agents.members, population + 1, BEST_AGENTS)[:, :population]
    best = agents.architecture(int(np.argmax(fitness)))
    pools = []
    for index, (pool, table) in enumerate(zip(agents.pools, space.problem.tables, strict=True)):
        children = pool[:population]
        if space.problem.evolves(index):
            genetics = GENETICS._replace(soft_mutation=1.0 / table.n_open)
            stream = fold(key, word_of(index))
            children = next_pool(stream, children, shared[index], table.n_actions, table.given, genetics)
            children[LEADERS_MODULE] = best.tables[index]
        pools.append(children)
    culture = take_in(society.culture, agents.structures, fitness, CULTURE)
    return Society(np.concatenate(pools, axis=1), culture, space.designs([best]))


def composed(society: Society) -> Designs:
    """Return the leader, and the best individuals of all pools under the fittest meme."""
    if not len(society.culture):
        return society.leader
    meme = society.culture.memes[int(np.argmax(society.culture.fitness))]
    return society.leader.joined(Designs(society.pools[:1], meme[None]))
