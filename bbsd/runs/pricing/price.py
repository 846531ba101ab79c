"""The price of a design before it begins: sizes, episodes, memory, and time by a sample of real episodes."""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace
from math import log10
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.streams import fold, name_word
from bbsd.language.meaning import seed_key
from bbsd.language.meaning.structure import OPEN_LAYER
from bbsd.runs.pricing.sampling import sample, sample_search
from bbsd.solver.budget import automatic_budget
from bbsd.solver.judgement import random_sample
from bbsd.solver.race import FIRST_ROUND

if TYPE_CHECKING:
    from bbsd.compiler import Problem
    from bbsd.solver.paper.settings import Settings

SAMPLE = name_word("sample")
RACED = 2 * FIRST_ROUND
"""Episodes of each candidate in the final race, by experience: many behave alike, most are out early."""
SEARCHED = 5_000
"""Designs that a search holds in memory: a round's, its champions and copies of them."""
PRACTISING = frozenset({"auto", "practice", "q"})
"""The methods that call the kernel for practice."""
NUMBER = 8
"""Bytes of a number."""


@dataclass(frozen=True, slots=True)
class TablePrice:
    """The size of a behavior's table."""

    behavior: str
    cells: int
    open_cells: int
    actions: int
    decades: float
    """How many designs of this table there are, as a logarithm to base 10."""


@dataclass(frozen=True, slots=True)
class Price:
    """The price of a design: its size, and what it takes."""

    tables: tuple[TablePrice, ...]
    layers: int
    open_layers: int
    decades: float
    """The size of the search space, all tables and orders, as a logarithm to base 10."""
    episodes: int
    """Episodes of single agents in all generations of all runs."""
    further_episodes: int
    """Episodes of the final races and of the judgement of the answer, estimated."""
    steps: int
    """Steps of robots in all these episodes, at most."""
    bytes: int
    """Memory of all processes, estimated."""
    starting: float
    """Seconds beside the design itself, as given by the caller."""
    compiling: float
    """Seconds until the kernels run; less where they are in the cache."""
    to_compile: float
    """Seconds that compiling the kernels was estimated to take, by their size; 0 where they were in the cache."""
    breeding: float
    """Seconds of a generation beside the episodes of its agents."""
    drawing: float
    """Seconds of drawing random tables, for the first pools and for agents that the design is compared with."""
    microseconds: float
    """Microseconds of an agent's episode in a lifetime, learning included."""
    seconds: float
    """Seconds of the whole, estimated by episodes as long as those that were sampled."""
    most_seconds: float
    """The same if every episode lasts as long as one can; more only where an environment is stepped in Python."""
    sampled_length: float | None
    """The mean length in steps of the episodes that were sampled, where time goes by steps."""
    most_length: int
    """How many steps an episode can last."""
    method: str = "paper"


def price(
    problem: Problem,
    settings: Settings,
    seed: int,
    n_runs: int,
    jobs: int = 1,
    starting: float = 0.0,
    most_steps: int | None = None,
) -> Price:
    """Return the price of so many runs, from a sample of their episodes; write nothing.

    `most_steps` is how long an environment's own limit lets an episode last. Times are processor times, so that they do
    not depend on what else the machine does. With several jobs, runs go side by side and threads share episodes.
    """
    to_compile = problem.kernels.seconds_to_compile(practices=settings.method in PRACTISING)
    environment = problem.meaning.spec.environment
    most_length = min(environment.steps, most_steps or environment.steps)
    if settings.method != "paper":
        return _price_of_search(problem, settings, seed, n_runs, jobs, starting, to_compile, most_length)
    processes = min(n_runs, jobs)
    sampled = replace(problem, jobs=jobs // processes)
    measured = sample(
        sampled, replace(settings, sharing="uniform"), fold(seed_key(seed), SAMPLE), most_length
    )
    generations, agents = settings.coevolution.generations, settings.coevolution.agents
    learning = generations * (_lifetimes(settings) + _differences(problem, settings))
    raced = _raced(settings)
    episode = measured.episode / measured.speedup
    rounds = -(-n_runs // processes)
    judged = _judged(problem, settings)
    living = (rounds * (learning + raced) + judged) * episode
    breeding = rounds * generations * measured.generation(agents)
    drawing = (rounds * settings.coevolution.population + random_sample(problem)[0]) * measured.random_agent
    beside = starting + measured.compiling + breeding + drawing
    episodes, further = n_runs * learning, n_runs * raced + judged
    return Price(
        tables=_tables(problem),
        layers=len(problem.layers),
        open_layers=int(np.count_nonzero(problem.layers == OPEN_LAYER)),
        decades=problem.decades,
        episodes=episodes,
        further_episodes=further,
        steps=(episodes + further) * environment.steps * environment.robots,
        bytes=(jobs if problem.is_stepped else processes) * (resident() + _bytes(problem, settings)),
        starting=starting,
        compiling=measured.compiling,
        to_compile=to_compile,
        breeding=measured.generation(agents),
        drawing=drawing,
        microseconds=measured.episode * 1e6,
        seconds=beside + living,
        most_seconds=beside + living * measured.longest,
        sampled_length=measured.length,
        most_length=most_length,
    )


def _price_of_search(
    problem: Problem,
    settings: Settings,
    seed: int,
    n_runs: int,
    jobs: int,
    starting: float,
    to_compile: float,
    most_length: int,
) -> Price:
    """Return the price of so many searches, from the first rounds of one."""
    processes = min(n_runs, jobs)
    budget = settings.budget or automatic_budget(problem)
    sampled = replace(problem, jobs=jobs // processes)
    measured = sample_search(sampled, settings, fold(seed_key(seed), SAMPLE), budget, most_length)
    rounds = -(-n_runs // processes)
    n_agents, n_episodes = random_sample(problem)
    further = settings.answer.judged + n_agents * n_episodes
    episode = measured.episode / measured.speedup
    drawing = n_agents * measured.random_agent
    living = (rounds * budget + further) * episode
    beside = starting + measured.compiling + drawing
    environment = problem.meaning.spec.environment
    cells = sum(table.n_cells for table in problem.tables)
    return Price(
        tables=_tables(problem),
        layers=len(problem.layers),
        open_layers=int(np.count_nonzero(problem.layers == OPEN_LAYER)),
        decades=problem.decades,
        episodes=n_runs * budget,
        further_episodes=further,
        steps=(n_runs * budget + further) * environment.steps * environment.robots,
        bytes=(jobs if problem.is_stepped else processes) * (resident() + SEARCHED * cells),
        starting=starting,
        compiling=measured.compiling,
        to_compile=to_compile,
        breeding=0.0,
        drawing=drawing,
        microseconds=measured.episode * 1e6,
        seconds=beside + living,
        most_seconds=beside + living * measured.longest,
        sampled_length=measured.length,
        most_length=most_length,
        method=settings.method,
    )


def _tables(problem: Problem) -> tuple[TablePrice, ...]:
    return tuple(
        TablePrice(
            table.name,
            table.n_cells,
            table.n_open,
            table.n_actions,
            table.n_open * log10(table.n_actions + 1),
        )
        for table in problem.tables
    )


def _lifetimes(settings: Settings) -> int:
    """Return the episodes of one generation."""
    return settings.coevolution.agents * settings.learning.episodes


def _differences(problem: Problem, settings: Settings) -> int:
    """Return the episodes of one generation that run again with a behavior held to No Action."""
    if settings.sharing != "difference":
        return 0
    evolving = sum(problem.evolves(behavior) for behavior in range(problem.n_behaviors))
    return settings.coevolution.agents * settings.learning.last * evolving


def _raced(settings: Settings) -> int:
    """Return the episodes of a run's final race, estimated."""
    agents = settings.coevolution.agents * settings.coevolution.generations
    return min(settings.answer.candidates, agents) * min(RACED, settings.answer.episodes)


def _judged(problem: Problem, settings: Settings) -> int:
    n_agents, n_episodes = random_sample(problem)
    return settings.answer.judged + n_agents * n_episodes + _lifetimes(settings)


def _bytes(problem: Problem, settings: Settings) -> int:
    """Return the bytes of a run's large arrays where there are most: in a generation, a race, or the judgement."""
    cells = sum(table.n_cells for table in problem.tables)
    n_layers, n_behaviors = len(problem.layers), problem.n_behaviors
    evolved, learning = settings.coevolution, settings.learning
    agent = NUMBER * (learning.episodes + 2 * n_layers * n_behaviors + n_layers + 5 * n_behaviors)
    champions = settings.answer.candidates * cells
    generation = 3 * cells * (evolved.population + evolved.agents) + evolved.agents * agent + 2 * champions
    race = champions + settings.answer.candidates * NUMBER * RACED
    return max(generation, race, champions + 3 * cells * random_sample(problem)[0])


def resident() -> int:
    """Return the most bytes that this process had so far; 0 where the system does not report them."""
    try:
        # Linux counts the size of the process that started this one among its resources, but not here.
        return 1024 * int(Path("/proc/self/status").read_text(encoding="ascii").split("VmHWM:")[1].split()[0])
    except (OSError, IndexError, ValueError):
        return _resident_by_resources()


def _resident_by_resources() -> int:
    try:
        import resource
    except ImportError:
        return 0
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most if sys.platform == "darwin" else 1024 * most
