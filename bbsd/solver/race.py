"""The race: which of several designs is best, by paired comparison on common fresh episodes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation import agents_of, returns_of
from bbsd.evaluation.sums import deviation, row_means
from bbsd.kernel.keys import keys
from bbsd.stopping import raise_if_stopped

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem

FIRST_ROUND = 100
DOUBT = 4.0
"""How many standard errors behind the leader a design is out of the race.

One chance in 30 000, for many looks at many.
"""


@dataclass(frozen=True, slots=True)
class Finish:
    """The winner's place among the entrants, the episodes it took, and how many were still in doubt at the end."""

    winner: int
    episodes: int
    in_doubt: int


def race(problem: Problem, entrants: Sequence[Architecture], key: int, cap: int) -> Finish:
    """Let designs run on the same episodes, in rounds that double, until the best is known or the cap is reached.

    Designs that earn the same in every episode of a round count as one, the first. What is left in doubt at
    the cap is decided by the mean.
    """
    generation = problem.meaning.spec.design.coevolution.generations
    running = np.arange(len(entrants))
    earned = np.empty((len(entrants), 0))
    while earned.shape[1] < cap and len(running) > 1:
        raise_if_stopped()
        done = earned.shape[1]
        count = min(max(done, FIRST_ROUND), cap - done)
        agents = agents_of([entrants[int(index)] for index in running])
        earned = np.hstack([earned, returns_of(problem, agents, keys(key, done, count), generation)])
        kept = still_running(earned)
        running, earned = running[kept], earned[kept]
    best = int(np.argmax(row_means(earned))) if earned.shape[1] else 0
    return Finish(int(running[best]), earned.shape[1], len(running))


def still_running(earned: NDArray[np.float64]) -> NDArray[np.int64]:
    """Who may still be the best, given the returns (n_designs, n_episodes) so far; always the leader."""
    leader = int(np.argmax(row_means(earned)))
    behind = earned[leader] - earned
    errors = np.array([deviation(each) for each in behind]) / np.sqrt(earned.shape[1])
    beaten = row_means(behind) > DOUBT * errors
    beaten |= _repeats(earned)
    beaten[leader] = False
    return np.flatnonzero(~beaten)


def _repeats(earned: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Designs whose returns are, to the bit, those of one before them."""
    seen: set[bytes] = set()
    repeated = np.zeros(len(earned), np.bool_)
    for index, returns in enumerate(earned):
        repeated[index] = returns.tobytes() in seen
        seen.add(returns.tobytes())
    return repeated
