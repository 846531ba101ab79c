"""Compares results over seeds: quantiles, and how probable it is that a method does better than another one."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from experiments.designs import Floats
    from experiments.methods.cells import Result

SAME = 1e-9
"""Means that differ by less, relative to the larger one, are ties: the same design has the same mean."""
RESAMPLES = 2000
LEVEL = (0.025, 0.975)


class Improvement(NamedTuple):
    """The probability that a method does better than another, over tasks, and its interval by resampling seeds."""

    mean: float
    low: float
    high: float
    worst: float
    """The least of all tasks."""
    worst_task: str
    n_tasks: int


def means(results: Iterable[Result], task: str, method: str, budget: int) -> Floats:
    """Return the mean returns of a method's designs in the order of their seeds."""
    chosen = [
        (result.seed, result.mean)
        for result in results
        if (result.task, result.method, result.budget) == (task, method, budget) and result.mean is not None
    ]
    return np.array([mean for _, mean in sorted(chosen)], dtype=np.float64)


def better(ones: Floats, others: Floats) -> float:
    """Return the share of all pairs in which the first is the better one; ties count half."""
    return float(_scores(ones, others).mean())


def _scores(ones: Floats, others: Floats) -> Floats:
    """Return 1 where one is better than another, 0.5 where they are the same, 0 elsewhere; (n_ones, n_others)."""
    one, other = ones[:, None], others[None, :]
    ties = np.isclose(one, other, rtol=SAME, atol=SAME)
    scores: Floats = np.where(ties, 0.5, one > other)
    return scores


def improvement(pairs: Mapping[str, tuple[Floats, Floats]]) -> Improvement:
    """Return how probable it is that the first of each pair does better, given the means over seeds by task."""
    scores = {name: _scores(*pair) for name, pair in pairs.items()}
    by_task = {name: float(score.mean()) for name, score in scores.items()}
    generator = np.random.default_rng(0)
    resampled = np.mean([_resampled(score, generator) for score in scores.values()], axis=0)
    low, high = np.quantile(resampled, LEVEL)
    worst = min(by_task, key=lambda name: by_task[name])
    center = float(np.mean(list(by_task.values())))
    return Improvement(center, float(low), float(high), by_task[worst], worst, len(by_task))


def _resampled(scores: Floats, generator: np.random.Generator) -> Floats:
    """Return the mean score of each resample of the seeds of both, (RESAMPLES,)."""
    rows, columns = (generator.integers(0, size, (RESAMPLES, size)) for size in scores.shape)
    means_of: Floats = scores[rows[:, :, None], columns[:, None, :]].mean(axis=(1, 2))
    return means_of


def quantiles(values: Floats) -> list[float]:
    """Return the least, the quartiles and the greatest."""
    return [float(value) for value in np.quantile(values, [0, 0.25, 0.5, 0.75, 1])]


def medians(results: Sequence[Result], task: str, method: str, budget: int) -> tuple[float, float]:
    """Return the median seconds and the median seconds of the processor."""
    chosen = [
        (result.seconds, result.processor)
        for result in results
        if (result.task, result.method, result.budget) == (task, method, budget)
    ]
    seconds, processor = np.median(np.array(chosen), axis=0)
    return float(seconds), float(processor)
