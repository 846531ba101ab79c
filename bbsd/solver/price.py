"""What a design will cost, before it is begun: sizes, episodes, memory, and the time of a sample of real episodes."""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace
from math import log10
from time import perf_counter, process_time
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation import detailed
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import fold, name_word
from bbsd.solver import metrics
from bbsd.solver.generation import beginning, next_generation
from bbsd.solver.lifetime import live
from bbsd.solver.race import FIRST_ROUND
from bbsd.solver.random_agents import random_agents
from bbsd.solver.rehearsal import in_the_smallest, rehearse
from bbsd.solver.run import RANDOM_AGENTS, RANDOM_EPISODES
from bbsd.spec.meaning import seed_key
from bbsd.spec.meaning.structure import OPEN_LAYER

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.compiler import Problem
    from bbsd.solver.settings import Settings

SAMPLE = name_word("sample")
SAMPLED_EPISODES = 3
"""Episodes of a sampled lifetime: one as born, the others with a structure that was searched for."""
LONG_ENOUGH = 0.3
"""Seconds after which a sample is believed."""
RACED = 4 * FIRST_ROUND
"""Episodes that a candidate lives in the final race on average, by experience."""
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
    """Seconds of this process so far."""
    compiling: float
    """Seconds until the kernels run; less where they are kept from before."""
    breeding: float
    """Seconds of a generation beside the lives of its agents."""
    microseconds: float
    """Of an agent's episode in a lifetime, all that is learned after it included."""
    seconds: float
    """Of the whole, about."""


@dataclass(frozen=True, slots=True)
class _Sample:
    """Seconds that were measured: until everything is compiled, of breeding, and of an agent's episode."""

    compiling: float
    breeding: float
    episode: float
    hastened: float
    """How much faster several threads are."""


def price(
    problem: Problem, settings: Settings, seed: int, n_runs: int, jobs: int = 1, starting: float = 0.0
) -> Price:
    """The price of so many runs; lives some episodes for it and writes nothing.

    Times are the processor's, so that they do not depend on what else the machine does. With several jobs runs go side
    by side, and threads share what is lived.
    """
    processes = min(n_runs, jobs)
    sampled = replace(problem, jobs=jobs // processes)
    sample = _measured(sampled, settings, fold(seed_key(seed), SAMPLE))
    lived, raced = settings.coevolution.generations * _lifetimes(settings), _raced(settings)
    run = (
        settings.coevolution.generations * sample.breeding
        + (lived + raced) * sample.episode / sample.hastened
    )
    one_after_the_other = -(-n_runs // processes)
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
        compiling=sample.compiling,
        breeding=sample.breeding,
        microseconds=sample.episode * 1e6,
        seconds=starting
        + sample.compiling
        + one_after_the_other * run
        + _judged(settings) * sample.episode / sample.hastened,
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
    return settings.coevolution.agents * settings.learning.lifetime


def _raced(settings: Settings) -> int:
    return settings.answer.candidates * min(RACED, settings.answer.episodes)


def _judged(settings: Settings) -> int:
    return settings.answer.judged + RANDOM_AGENTS * RANDOM_EPISODES + _lifetimes(settings)


def _measured(problem: Problem, settings: Settings, key: int) -> _Sample:
    first, second = (_seconds(_all_kernels, problem, settings, key) for _ in range(2))
    breeding = _generation_seconds(problem, settings, key)
    lifetime = min(SAMPLED_EPISODES, settings.learning.lifetime)
    n_agents, seconds, began = min(problem.lanes, settings.coevolution.agents), 0.0, 0.0
    while seconds < LONG_ENOUGH:
        began = perf_counter()
        seconds = _seconds(_live, problem, settings, key, n_agents, lifetime)
        clock, each = perf_counter() - began, seconds / (n_agents * lifetime)
        hastened = min(max(1.0, seconds / clock), problem.jobs)
        if n_agents == settings.coevolution.agents:
            break
        n_agents = min(settings.coevolution.agents, 4 * n_agents)
    return _Sample(max(0.0, first - second), breeding, each, hastened)


def _seconds(what: Callable[..., object], *arguments: object) -> float:
    began = process_time()
    what(*arguments)
    return process_time() - began


def _all_kernels(problem: Problem, settings: Settings, key: int) -> None:
    """Call once whatever is compiled when it is called."""
    rehearse(problem, settings)
    agents = random_agents(problem, key, 1)
    for _ in detailed(problem, agents, keys(key, 0, 1), settings.coevolution.generations):
        pass


def _generation_seconds(problem: Problem, settings: Settings, key: int) -> float:
    """The seconds of a generation but for its lives: whole pools, and next to no agents."""
    few = in_the_smallest(settings)
    whole = replace(settings.coevolution, agents=few.coevolution.agents)
    few = replace(settings, coevolution=whole, learning=few.learning)
    state, _ = next_generation(beginning(problem, few, key), problem, few, key)

    def generation() -> None:
        following, census = next_generation(state, problem, few, key)
        metrics.line(0, following, census, problem)

    return _seconds(generation)


def _live(problem: Problem, settings: Settings, key: int, n_agents: int, lifetime: int) -> None:
    """Let random agents live and learn, as in the last generation."""
    agents = random_agents(problem, key, n_agents)
    learning = replace(settings.learning, lifetime=lifetime)
    live(problem, agents, keys(key, 0, n_agents), settings.coevolution.generations, learning)


def _bytes(problem: Problem, settings: Settings) -> int:
    """Return the bytes of the large arrays of a run."""
    cells = sum(table.n_cells for table in problem.tables)
    n_layers, n_behaviors = len(problem.layers), problem.n_behaviors
    evolved, learning = settings.coevolution, settings.learning
    agent = NUMBER * (learning.lifetime + n_layers * n_behaviors + n_layers + 5 * n_behaviors)
    searched = NUMBER * n_layers * (learning.candidates if learning.learned else 0)
    return (
        evolved.population * cells
        + evolved.agents * (agent + searched + cells)
        + settings.answer.candidates * (cells + NUMBER * RACED)
    )


def resident() -> int:
    """Return the bytes that this process had at most so far; 0 where the system does not tell."""
    try:
        import resource
    except ImportError:
        return 0
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most if sys.platform == "darwin" else 1024 * most
