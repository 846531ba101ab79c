"""A run: generation after generation, then its answer; and the best of several runs' answers, judged."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.evaluation import Evaluation, Interval, agents_of, detailed, evaluation, interval, returns_of
from bbsd.evaluation.sums import row_means
from bbsd.kernel.keys import keys, own_keys
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.language.meaning import seed_key
from bbsd.runs import metrics
from bbsd.runs.checkpoint import Progress
from bbsd.solver.answer import answer, different
from bbsd.solver.generation import beginning, next_generation
from bbsd.solver.lifetime import live
from bbsd.solver.race import race
from bbsd.solver.random_agents import random_agents

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.solver.settings import Settings

RUNS, BEST, JUDGED, RANDOM, LIFETIMES = (
    name_word(name) for name in ("runs", "best", "judged", "random", "lifetimes")
)

RANDOM_AGENTS, RANDOM_EPISODES = 1000, 10


def run_key(seed: int, run: int) -> int:
    """The key of all streams of one run, which counts from 0."""
    return fold(fold(seed_key(seed), RUNS), word_of(run))


def start(problem: Problem, settings: Settings, seed: int, run: int) -> Progress:
    """A run's progress before its first generation."""
    return Progress(run, beginning(problem, settings, run_key(seed, run)))


def generations(
    progress: Progress, problem: Problem, settings: Settings, seed: int
) -> Iterator[tuple[Progress, dict[str, Any] | None]]:
    """Go on from some progress to the end of the run.

    Yields after every generation the progress and the generation's metrics, and after the race for the run's answer
    the progress with it, without metrics.
    """
    run, state, key = progress.run, progress.state, run_key(seed, progress.run)
    while state.generation < settings.coevolution.generations:
        state, census = next_generation(state, problem, settings, key)
        yield Progress(run, state), metrics.line(run, state, census, problem)
    if progress.answer is None:
        yield Progress(run, state, answer(state, problem, settings, key)), None


@dataclass(frozen=True, slots=True, eq=False)
class Judgement:
    """The design of all runs, what it earns on episodes that took no part in choosing it.

    And what to compare it with.
    """

    architecture: Architecture
    evaluation: Evaluation
    lifetime: Interval
    """Lifetime fitness of agents that are born with the design and go on learning, over agents."""
    random: Interval
    """Random agents of the same space, each in episodes of its own, over agents."""


def judge(answers: Sequence[Architecture], problem: Problem, settings: Settings, seed: int) -> Judgement:
    """Choose the best of the runs' answers and judge it on fresh episodes."""
    key = seed_key(seed)
    entrants = different(answers, problem)
    best = entrants[race(problem, entrants, fold(key, BEST), settings.answer.episodes).winner]
    generation = settings.coevolution.generations
    fresh = keys(fold(key, JUDGED), 0, settings.answer.judged)
    judged = evaluation(problem, detailed(problem, agents_of([best]), fresh, generation), 1)
    strangers = random_agents(problem, fold(key, RANDOM), RANDOM_AGENTS)
    streams = own_keys(fold(key, RANDOM), RANDOM_AGENTS, RANDOM_EPISODES)
    earned = returns_of(problem, strangers, streams, generation)
    return Judgement(best, judged, _lifetime(best, problem, settings, key), interval(row_means(earned)))


def _lifetime(best: Architecture, problem: Problem, settings: Settings, key: int) -> Interval:
    n_agents = settings.coevolution.agents
    agents = agents_of([best])[np.zeros(n_agents, np.int64)]
    streams = keys(fold(key, LIFETIMES), 0, n_agents)
    lives = live(problem, agents, streams, settings.coevolution.generations, settings.learning)
    return interval(row_means(lives.returns))
