"""The metrics of a generation: one line of `metrics.jsonl`, which depends on no clock and no path."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.evaluation.sums import deviation, mean
from bbsd.solver.early import ENDINGS

if TYPE_CHECKING:
    from bbsd.compiler import Pool, Problem
    from bbsd.solver.paper.generation import Census, State


def line(run: int, state: State, census: Census, problem: Problem) -> dict[str, Any]:
    """Return the metrics of a generation: agents' fitness, diversity of the pools, the fittest agent's structure."""
    best = int(np.argmax(census.fitness))
    structure = [problem.names[behavior] for behavior in reversed(census.structures[best])]
    return {
        "run": run + 1,
        "generation": state.generation,
        "mean": mean(census.fitness),
        "best": float(census.fitness[best]),
        "sd": deviation(census.fitness) if len(census.fitness) > 1 else 0.0,
        "lifetime": mean(census.lifetime_fitness),
        "diversity": {name: diversity(pool) for name, pool in zip(problem.names, state.pools, strict=True)},
        "structure": structure,
        **({"ended_by": ENDINGS[state.ended]} if state.ended else {}),
    }


def diversity(pool: Pool) -> float:
    """Return the probability that two individuals, drawn with replacement, differ in a cell, averaged over cells."""
    different = np.ones(pool.shape[1])
    for value in range(int(pool.max(initial=0)) + 1):
        different -= (np.count_nonzero(pool == value, axis=0) / len(pool)) ** 2
    return mean(different)
