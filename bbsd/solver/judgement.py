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
from bbsd.solver.paper.lifetime import run_lifetimes
from bbsd.solver.race import race
from bbsd.solver.random_agents import random_agents

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.solver.paper.settings import Settings

BEST, JUDGED, RANDOM, LIFETIMES = (name_word(name) for name in ("best", "judged", "random", "lifetimes"))

RANDOM_AGENTS, RANDOM_EPISODES = 1000, 10
"""Random agents that a design is compared with, and the episodes of each."""
RANDOM_IN_PYTHON = 200, 5
"""The same where the environment is stepped in Python."""


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
    selection: Selection
    """What selection among random agents has to work on."""


@dataclass(frozen=True, slots=True)
class Selection:
    """Whether random agents earn different returns at all."""

    alike: float | None
    """The return that all of them had in all episodes; None where returns differ."""
    unearned: tuple[str, ...]
    """The reward terms that were zero in all their episodes, but for costs, which are written with a minus."""
    agents: int
    episodes: int


def judge(answers: Sequence[Architecture], problem: Problem, settings: Settings, seed: int) -> Judgement:
    """Choose the best of the runs' answers and evaluate it on fresh episodes."""
    key = seed_key(seed)
    best = best_of(answers, problem, settings, seed)
    generation = settings.coevolution.generations
    fresh = judging_keys(settings, seed)
    judged = evaluation(problem, detailed_outcomes(problem, agents_of([best]), fresh, generation), 1)
    lifetime = _lifetime_fitness(best, problem, settings, key) if settings.method == "paper" else None
    return Judgement(best, judged, lifetime, *_random_returns(problem, generation, fold(key, RANDOM)))


def best_of(answers: Sequence[Architecture], problem: Problem, settings: Settings, seed: int) -> Architecture:
    """Return the best of several runs' answers, by a race."""
    entrants = distinct(answers, problem)
    finish = race(problem, entrants, fold(seed_key(seed), BEST), settings.answer.episodes)
    return entrants[finish.winner]


def judging_keys(settings: Settings, seed: int) -> NDArray[np.uint64]:
    """Return the keys of the fresh episodes on which all answers of a seed are judged, (n_episodes,)."""
    return keys(fold(seed_key(seed), JUDGED), 0, settings.answer.judged)


def fresh_returns(architecture: Architecture, problem: Problem, settings: Settings, seed: int) -> Interval:
    """Return the return of a design on the fresh episodes on which all answers of a seed are judged."""
    fresh, generation = judging_keys(settings, seed), settings.coevolution.generations
    return interval(returns_of(problem, agents_of([architecture]), fresh, generation)[0])


def random_sample(problem: Problem) -> tuple[int, int]:
    """Return how many random agents a design is compared with, and the episodes of each."""
    return RANDOM_IN_PYTHON if problem.is_stepped else (RANDOM_AGENTS, RANDOM_EPISODES)


def _random_returns(problem: Problem, generation: int, key: int) -> tuple[Interval, Selection]:
    n_agents, n_episodes = random_sample(problem)
    agents = random_agents(problem, key, n_agents)
    episodes = own_keys(key, n_agents, n_episodes)
    outcomes = [
        (outcome.returns, np.any(outcome.terms != 0, axis=0))
        for outcome in detailed_outcomes(problem, agents, episodes, generation)
    ]
    returns = np.concatenate([each for each, _ in outcomes])
    earned = np.any([each for _, each in outcomes], axis=0)
    terms = zip(problem.meaning.spec.reward.items(), earned, strict=True)
    selection = Selection(
        float(returns[0]) if np.all(returns == returns[0]) else None,
        tuple(name for (name, term), is_earned in terms if not is_earned and not term.text.startswith("-")),
        n_agents,
        len(returns),
    )
    return interval(row_means(returns.reshape(n_agents, -1))), selection


def _lifetime_fitness(best: Architecture, problem: Problem, settings: Settings, key: int) -> Interval:
    n_agents = settings.coevolution.agents
    agents = agents_of([best])[np.zeros(n_agents, np.int64)]
    streams = keys(fold(key, LIFETIMES), 0, n_agents)
    unshared = replace(settings, sharing="uniform")  # nobody's fitness is shared here
    lifetimes = run_lifetimes(problem, agents, streams, settings.coevolution.generations, unshared)
    return interval(row_means(lifetimes.returns))
