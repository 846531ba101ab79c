"""The judgement of a design on fresh episodes, beside random agents and agents that go on learning."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation import (
    Evaluation,
    Interval,
    agents_of,
    detailed_outcomes,
    evaluation,
    interval,
    returns_of,
)
from bbsd.evaluation.sums import row_means
from bbsd.kernel.keys import keys, own_keys
from bbsd.kernel.streams import fold, name_word
from bbsd.language.meaning import seed_key
from bbsd.solver.answer import distinct
from bbsd.solver.lifetime import run_lifetimes
from bbsd.solver.race import race
from bbsd.solver.random_agents import random_agents

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.solver.settings import Settings

BEST, JUDGED, RANDOM, LIFETIMES = (name_word(name) for name in ("best", "judged", "random", "lifetimes"))

RANDOM_AGENTS, RANDOM_EPISODES = 1000, 10
"""Random agents that a design is compared with, and the episodes of each."""


@dataclass(frozen=True, slots=True, eq=False)
class Judgement:
    """The design of all runs, its return on episodes that took no part in choosing it, and what to compare it with."""

    architecture: Architecture
    evaluation: Evaluation
    lifetime: Interval | None
    """Lifetime fitness, over agents that start with the design and go on learning their structure.

    None for methods that have no lifetimes.
    """
    random: Interval
    """Mean return of random agents of the same design space, each in episodes of its own, over agents."""


def judge(answers: Sequence[Architecture], problem: Problem, settings: Settings, seed: int) -> Judgement:
    """Choose the best of the runs' answers and evaluate it on fresh episodes."""
    key = seed_key(seed)
    entrants = distinct(answers, problem)
    best = entrants[race(problem, entrants, fold(key, BEST), settings.answer.episodes).winner]
    generation = settings.coevolution.generations
    fresh = keys(fold(key, JUDGED), 0, settings.answer.judged)
    judged = evaluation(problem, detailed_outcomes(problem, agents_of([best]), fresh, generation), 1)
    lifetime = _lifetime_fitness(best, problem, settings, key) if settings.method == "paper" else None
    return Judgement(best, judged, lifetime, _random_returns(problem, generation, fold(key, RANDOM)))


def _random_returns(problem: Problem, generation: int, key: int) -> Interval:
    agents = random_agents(problem, key, RANDOM_AGENTS)
    episodes = own_keys(key, RANDOM_AGENTS, RANDOM_EPISODES)
    return interval(row_means(returns_of(problem, agents, episodes, generation)))


def _lifetime_fitness(best: Architecture, problem: Problem, settings: Settings, key: int) -> Interval:
    n_agents = settings.coevolution.agents
    agents = agents_of([best])[np.zeros(n_agents, np.int64)]
    streams = keys(fold(key, LIFETIMES), 0, n_agents)
    unshared = replace(settings, sharing="uniform")  # nobody's fitness is shared here
    lifetimes = run_lifetimes(problem, agents, streams, settings.coevolution.generations, unshared)
    return interval(row_means(lifetimes.returns))
