"""What a design will cost, before it is begun: sizes, episodes, memory, and the time of a sample of real episodes."""

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
from bbsd.runs.sampling import sample
from bbsd.solver.judgement import RANDOM_AGENTS, RANDOM_EPISODES
from bbsd.solver.race import FIRST_ROUND

if TYPE_CHECKING:
    from bbsd.compiler import Problem
    from bbsd.solver.settings import Settings

SAMPLE = name_word("sample")
RACED = 2 * FIRST_ROUND
"""Episodes for each candidate that may enter the final race, by experience: many behave alike, most lose early."""
NUMBER = 8
"""Bytes."""


@dataclass(frozen=True, slots=True)
class TablePrice:
    """A behavior's table."""

    behavior: str
    cells: int
    open_cells: int
    actions: int
    decades: float
    """The designs of this table, as a logarithm to base 10."""


@dataclass(frozen=True, slots=True)
class Price:
    """What a design will cost."""

    tables: tuple[TablePrice, ...]
    layers: int
    open_layers: int
    decades: float
    """The search space, all tables and orders, as a logarithm to base 10."""
    episodes: int
    """Episodes of single agents in all generations of all runs."""
    further_episodes: int
    """Those of the final races, and those that the answer is judged on, about."""
    steps: int
    """Steps of robots in all of them, at most."""
    bytes: int
    """Memory of the process, about."""
    starting: float
    """Seconds that were said to be needed beside the design itself."""
    compiling: float
    """Seconds until the kernels run; less where they are kept from before."""
    breeding: float
    """Seconds of a generation beside the episodes of its agents."""
    drawing: float
    """Seconds in which random tables are drawn: of first pools, and of agents that a design is compared with."""
    microseconds: float
    """Of an agent's episode in a lifetime, all that is learned after it included."""
    seconds: float
    """Of the whole, about."""


def price(
    problem: Problem, settings: Settings, seed: int, n_runs: int, jobs: int = 1, starting: float = 0.0
) -> Price:
    """The price of so many runs; lives some episodes for it and writes nothing.

    Times are the processor's, so that they do not depend on what else the machine does. With several jobs runs go side
    by side, and threads share what is lived.
    """
    processes = min(n_runs, jobs)
    sampled = replace(problem, jobs=jobs // processes)
    taken = sample(sampled, settings, fold(seed_key(seed), SAMPLE))
    generations, agents = settings.coevolution.generations, settings.coevolution.agents
    lived, raced = generations * _lifetimes(settings), _raced(settings)
    episode = taken.episode / taken.hastened
    one_after_the_other = -(-n_runs // processes)
    run = generations * taken.generation(agents) + (lived + raced) * episode
    judging = _judged(settings) * episode
    drawing = (one_after_the_other * settings.coevolution.population + RANDOM_AGENTS) * taken.newborn
    environment = problem.meaning.spec.environment
    episodes, further = n_runs * lived, n_runs * raced + _judged(settings)
    return Price(
        tables=_tables(problem),
        layers=len(problem.layers),
        open_layers=int(np.count_nonzero(problem.layers == OPEN_LAYER)),
        decades=problem.decades,
        episodes=episodes,
        further_episodes=further,
        steps=(episodes + further) * environment.steps * environment.robots,
        bytes=processes * (resident() + _bytes(problem, settings)),
        starting=starting,
        compiling=taken.compiling,
        breeding=taken.generation(agents),
        drawing=drawing,
        microseconds=taken.episode * 1e6,
        seconds=starting + taken.compiling + one_after_the_other * run + judging + drawing,
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


def _raced(settings: Settings) -> int:
    """Return the episodes of a run's final race, about."""
    agents = settings.coevolution.agents * settings.coevolution.generations
    return min(settings.answer.candidates, agents) * min(RACED, settings.answer.episodes)


def _judged(settings: Settings) -> int:
    return settings.answer.judged + RANDOM_AGENTS * RANDOM_EPISODES + _lifetimes(settings)


def _bytes(problem: Problem, settings: Settings) -> int:
    """The bytes of the large arrays of a run, where it has most of them: in a generation, or when it is judged."""
    cells = sum(table.n_cells for table in problem.tables)
    n_layers, n_behaviors = len(problem.layers), problem.n_behaviors
    evolved, learning = settings.coevolution, settings.learning
    agent = NUMBER * (learning.episodes + 2 * n_layers * n_behaviors + n_layers + 5 * n_behaviors)
    champions = settings.answer.candidates * cells
    generation = 3 * cells * (evolved.population + evolved.agents) + evolved.agents * agent + 2 * champions
    race = champions + settings.answer.candidates * NUMBER * RACED
    return max(generation, race, champions + 3 * cells * RANDOM_AGENTS)


def resident() -> int:
    """Return the bytes that this process had at most so far; 0 where the system does not tell."""
    try:
        # What Linux tells of a process's resources still knows the size of the process that started it.
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
