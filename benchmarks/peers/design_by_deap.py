"""The design algorithm as a user would write it, with DEAP for the pools and NumPy, all agents at once, for the rest.

Cooperative co-evolution, stochastic search for structures and memes, as in the generations of `bbsd design`; there is
no final race.
"""

from __future__ import annotations

import random
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from deap import base, creator, tools

from benchmarks.peers.by_numpy import lift
from benchmarks.workloads.lifting import BEHAVIORS, ROBOTS, Workload

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.solver.paper.settings import Settings
    from benchmarks.workloads.arrays import Floats, Integers, Symbols

    Run = Callable[[Symbols, Integers, np.random.Generator], tuple[Floats, Floats]]
    """Maps tables (n_agents, n_behaviors, n_cells) and structures to returns (n_agents,) and credit by behavior."""

LIFTING_CELLS = (1, 6, 2, 6, 6)
ABSTRACT_CELLS = (25,) * 7


def run_lifting(tables: Symbols, structures: Integers, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Run one episode of each agent."""
    earnings = lift(Workload(rng.uniform(2, 3, (len(tables), ROBOTS)), tables, structures))
    return earnings.returns, earnings.credit[:, :BEHAVIORS]


def run_abstract(policy: Integers) -> Run:
    """Return the function that runs episodes of one answer each, of which `policy` (5, 5) holds the right ones."""

    def run(tables: Symbols, structures: Integers, rng: np.random.Generator) -> tuple[Floats, Floats]:
        agents, n_behaviors = np.arange(len(tables)), tables.shape[1]
        i, j = rng.integers(0, 5, (2, len(tables)))
        active = tables[agents, :, i * 5 + j]
        who = np.full(len(tables), -1)
        for layer in structures.T:  # lowest first: higher ones overwrite it
            who = np.where(active[agents, layer] > 0, layer, who)
        returns = np.where(who + 1 == policy[i, j], 1.0, -1.0)
        credit = np.where(np.arange(n_behaviors) == who[:, None], returns[:, None], 0.0)
        return returns, credit

    return run


def design(run: Run, cells: tuple[int, ...], settings: Settings, generations: int, seed: int) -> list[float]:
    """Return the mean fitness of the agents in each generation."""
    random.seed(seed)
    rng = np.random.default_rng(seed)
    toolbox = toolbox_for(settings)
    pools = [[toolbox.individual(n) for _ in range(settings.coevolution.population)] for n in cells]
    culture: list[tuple[list[int], float]] = []
    means = []
    for generation in range(1, generations + 1):
        if generation > 1:
            pools = [next_pool(pool, toolbox, settings, generation - 1) for pool in pools]
        members = np.stack([pairing(len(pool), settings.coevolution.agents, rng) for pool in pools], axis=1)
        tables = np.zeros((len(members), len(pools), max(cells)), np.uint8)
        for index, pool in enumerate(pools):
            tables[:, index, : cells[index]] = np.array(pool, np.uint8)[members[:, index]]
        structures = first_structures(culture, len(members), len(pools), settings, rng)
        returns, structures, values = lifetimes(run, tables, structures, settings, rng)
        fitness = returns[:, -settings.learning.last :].mean(axis=1)
        share(pools, members, fitness, values, settings)
        for structure, value in zip(structures.tolist(), fitness.tolist(), strict=True):
            learn(culture, structure, value, settings)
        means.append(float(fitness.mean()))
    return means


def toolbox_for(settings: Settings) -> Any:  # noqa: ANN401 - DEAP is not typed
    """Return DEAP's operators with the settings of Table 1."""
    if not hasattr(creator, "Shared"):
        creator.create("Shared", base.Fitness, weights=(1.0,))
        creator.create("Table", list, fitness=creator.Shared)
    toolbox = base.Toolbox()
    toolbox.register(
        "individual", lambda n: tools.initRepeat(creator.Table, partial(random.randint, 0, 1), n)
    )
    toolbox.register("select", tools.selTournament, tournsize=settings.coevolution.tournament)
    toolbox.register("mate", tools.cxUniform, indpb=1 - settings.coevolution.crossover)
    toolbox.register("mutate", tools.mutUniformInt, low=0, up=1)
    return toolbox


def next_pool(pool: list[Any], toolbox: Any, settings: Settings, generation: int) -> list[Any]:  # noqa: ANN401
    """Return the next generation of a pool: selection, crossover, hard and soft mutation; the best stay."""
    breeding = settings.breeding(generation)
    children = [toolbox.clone(best) for best in tools.selBest(pool, breeding.elites)]
    while len(children) < len(pool):
        child, other = map(toolbox.clone, toolbox.select(pool, 2))
        toolbox.mate(child, other)
        if random.random() < breeding.hard_mutation:
            child = toolbox.individual(len(child))
        (child,) = toolbox.mutate(child, indpb=breeding.soft_mutation)
        del child.fitness.values
        children.append(child)
    return children


def pairing(population: int, n_agents: int, rng: np.random.Generator) -> Integers:
    """Return an individual for each agent: every one equally often, in random order."""
    decks = [rng.permutation(population) for _ in range(-(-n_agents // population))]
    return np.concatenate(decks)[:n_agents]


def first_structures(
    culture: list[tuple[list[int], float]],
    n_agents: int,
    n_layers: int,
    settings: Settings,
    rng: np.random.Generator,
) -> Integers:
    """Return each agent's first structure: a meme by a scaled roulette wheel, any meme, or random without memes."""
    if settings.culture is None or not culture:
        return rng.permuted(np.tile(np.arange(n_layers), (n_agents, 1)), axis=1)
    fitness = np.array([value for _, value in culture])
    width = fitness.max() - fitness.min()
    wheel = fitness - fitness.min() + 0.1 * width if width > 0 else np.ones(len(fitness))
    by_wheel = rng.choice(len(culture), n_agents, p=wheel / wheel.sum())
    anyone = rng.integers(0, len(culture), n_agents)
    chosen = np.where(rng.random(n_agents) < settings.culture.scaled, by_wheel, anyone)
    return np.array([structure for structure, _ in culture])[chosen]


def lifetimes(
    run: Run,
    tables: Symbols,
    structures: Integers,
    settings: Settings,
    rng: np.random.Generator,
) -> tuple[Floats, Integers, Floats]:
    """Return the returns (n_agents, n_episodes), final structures, learned values (n_agents, n_layers, n_behaviors)."""
    n_agents, n_layers = structures.shape
    agents, layers = np.arange(n_agents)[:, None], np.arange(n_layers)
    values = np.zeros((n_agents, n_layers, tables.shape[1]))
    returns = np.empty((n_agents, settings.learning.episodes))
    for episode in range(1, settings.learning.episodes + 1):
        if episode > 1:
            structures = searched_structures(values, structures, settings.learning.candidates, rng)
        returns[:, episode - 1], credit = run(tables, structures, rng)
        rate = settings.rates.learning[episode - 1]
        old = values[agents, layers, structures]
        values[agents, layers, structures] = (1 - rate) * old + rate * credit[agents, structures]
    return returns, structures, values


def searched_structures(
    values: Floats, structures: Integers, n_random: int, rng: np.random.Generator
) -> Integers:
    """Return the best of the present structure and random ones by the learned values."""
    n_agents, n_layers = structures.shape
    random_ones = rng.random((n_agents, n_random, n_layers)).argsort(axis=2)
    candidates = np.concatenate([structures[:, None, :], random_ones], axis=1)
    agents = np.arange(n_agents)[:, None, None]
    worth = values[agents, np.arange(n_layers), candidates].sum(axis=2)
    best: Integers = candidates[np.arange(n_agents), worth.argmax(axis=1)]
    return best


def share(
    pools: list[list[Any]], members: Integers, fitness: Floats, values: Floats, settings: Settings
) -> None:
    """Set each individual's fitness to the mean of its agents' fitness, or of its own contributions to them."""
    shares = (
        values.sum(axis=1) if settings.sharing == "value" else np.repeat(fitness[:, None], len(pools), axis=1)
    )
    for index, pool in enumerate(pools):
        counts = np.bincount(members[:, index], minlength=len(pool))
        sums = np.bincount(members[:, index], weights=shares[:, index], minlength=len(pool))
        for individual, total, count in zip(pool, sums, counts, strict=True):
            individual.fitness.values = (total / count if count else -np.inf,)


def learn(
    culture: list[tuple[list[int], float]], structure: list[int], value: float, settings: Settings
) -> None:
    """Add a structure to the culture, or update its fitness there."""
    if settings.culture is None:
        return
    memes = [meme for meme, _ in culture]
    if structure in memes:
        index = memes.index(structure)
        culture[index] = (
            structure,
            (1 - settings.culture.rate) * culture[index][1] + settings.culture.rate * value,
        )
    elif len(culture) < settings.culture.size:
        culture.append((structure, value))
    elif value > min(fitness for _, fitness in culture):
        least = min(range(len(culture)), key=lambda index: culture[index][1])
        culture[least] = structure, value
