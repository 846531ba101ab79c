"""A race between designs: paired comparison on common fresh episodes."""

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
"""Episodes of the first round."""
MARGIN = 4.0
"""Standard errors behind the leader at which a design is out of the race.

One chance in 30,000 for each comparison, since many designs are compared in many rounds.
"""


@dataclass(frozen=True, slots=True)
class Finish:
    """The index of the winner, the episodes it took, and how many designs might still be the best at the end."""

    winner: int
    episodes: int
    undecided: int


def race(problem: Problem, entrants: Sequence[Architecture], key: int, cap: int) -> Finish:
    """Run designs on the same episodes, in rounds that double, until the best is known or the cap is reached.

    Designs that earn the same in every episode of a round count as one, the first. Where several are left at
    the cap, the mean decides.
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
    """Return the indices of designs that may still be the best by their returns (n_designs, n_episodes) so far."""
    leader = int(np.argmax(row_means(earned)))
    behind = earned[leader] - earned
    errors = np.array([deviation(differences) for differences in behind]) / np.sqrt(earned.shape[1])
    beaten = row_means(behind) > MARGIN * errors
    beaten |= _repeats(earned)
    beaten[leader] = False
    return np.flatnonzero(~beaten)


def _repeats(earned: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell which designs have, to the bit, the returns of one before them, (n_designs,)."""
    seen: set[bytes] = set()
    repeated = np.zeros(len(earned), np.bool_)
    for index, returns in enumerate(earned):
        repeated[index] = returns.tobytes() in seen
        seen.add(returns.tobytes())
    return repeated
