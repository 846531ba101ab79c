"""A paired climb: single changes of one design, tried in the same episodes as the design itself until none helps.

All changes get the same few episodes; those that change nothing or are clearly worse are dropped, and the others get
twice as many, until one is clearly better or the last round is over. A changed cell need only be tried in the episodes
in which the design asks the cell, since the others are the same to the bit. A climb is a plain value that can be
written down between two rounds.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import fsum
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation.sums import mean as mean_of
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.changes import changes_of
from bbsd.solver.space import uniforms

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.solver.arena import Arena
    from bbsd.solver.changes import Changes
    from bbsd.solver.space import Designs

PAIRED, TOGETHER, SOME = (name_word(name) for name in ("paired episodes", "changes together", "some changes"))

FIRST_EPISODES, MOST_EPISODES = 50, 4000
"""Common episodes of a design and its changes in the first round, and after the last."""
FEWEST_EPISODES = 20
"""With fewer, differences that happen to be all alike would look certain."""
BETTER = 3.5
"""Standard errors above the design at which a change is accepted: one chance in 4,000 for each that is no better."""
BETTER_AT_LAST = 2.5
"""The same after the last round, when the only other choice is to leave things as they are."""
WORSE = 2.5
"""Standard errors below the design at which a change is dropped."""
MOST_TOGETHER = 16
"""Accepted changes that are tried together."""
SILENT = 20
"""Episodes with the cell asked after which a change that never changed a return is dropped."""
MOST_BYTES, MOST_EPISODES_AT_ONCE = 1 << 24, 40_000
"""Tables of changed designs that are in memory at once, and episodes between two looks at a request to stop."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Climb:
    """A climb between two rounds.

    It goes in passes: each begins with all changes of the design that was reached.
    """

    design: Designs
    """The one design that was reached."""
    mean: float
    """Its mean return in the latest episodes, NaN before the first round."""
    running: NDArray[np.int64]
    """The changes that may still be better, by their numbers in `changes_of` the design, (n,)."""
    gains: NDArray[np.float64]
    """The mean of what each earned more than the design in the same episodes, (n,)."""
    squares: NDArray[np.float64]
    """The sum of the squared deviations from that mean, (n,)."""
    tried: NDArray[np.int64]
    """The episodes in which each was tried, since the design asked the cell, (n,)."""
    episodes: int = 0
    """Episodes of the design in which these gains were earned; 0 where a pass begins."""
    whole: bool = True
    """Whether no change was left out of the pass because the budget was short."""
    passes: int = 0
    """Passes that are over; the number names the random streams of the next one."""
    spent: int = 0
    """Episodes so far, of the design and all changes."""
    at_optimum: bool = False
    """Whether no single change is known to help: the climb is over."""


def begin_climb(design: Designs) -> Climb:
    """Return the climb from one design before its first round."""
    none, nothing = np.empty(0, np.int64), np.empty(0)
    return Climb(design=design, mean=float("nan"), running=none, gains=nothing, squares=nothing, tried=none)


def advance_climb(
    climb: Climb, arena: Arena, key: int, budget: int, most_episodes: int = MOST_EPISODES
) -> Climb:
    """Return the climb after one more round, which spends at least one episode and at most what is left.

    Nothing is spent where the climb is over or the design has no changes at all.

    Args:
        climb: a climb of which less than the budget is spent.
        arena: where episodes run.
        key: names the random streams of the whole climb.
        budget: episodes of the whole climb.
        most_episodes: common episodes after which changes that are still in doubt are given up.
    """
    changes = changes_of(arena.space, climb.design)
    if climb.at_optimum or not len(changes):
        return replace(climb, at_optimum=True)
    if not climb.episodes:
        climb = _with_changes(climb, np.arange(len(changes)))
    stream = fold(key, word_of(climb.passes))
    climb = _compared(climb, changes, arena, stream, budget, most_episodes)
    scores, last = _scores(climb), climb.episodes >= most_episodes
    better = np.flatnonzero(scores > (BETTER_AT_LAST if last else BETTER))
    if len(better) and climb.episodes >= FEWEST_EPISODES:
        return _changed(climb, changes, better, arena, fold(stream, TOGETHER), budget)
    silent = (climb.tried >= SILENT) & (climb.gains == 0) & (climb.squares == 0)
    climb = _with_running(climb, np.flatnonzero((scores >= -WORSE) & ~silent))
    if last or not len(climb.running):
        return _after_pass(climb, at_optimum=climb.whole)
    return climb


def _compared(
    climb: Climb, changes: Changes, arena: Arena, stream: int, budget: int, most_episodes: int
) -> Climb:
    """Return the climb after more episodes of the design and of as many changes as the budget pays for."""
    left, paired = budget - climb.spent, fold(stream, PAIRED)
    count = min(max(climb.episodes, FIRST_EPISODES), most_episodes - climb.episodes, max(1, left // 2))
    own, asked = arena.asked(climb.design, paired, count, first=climb.episodes)
    mean = (
        (climb.mean * climb.episodes + mean_of(own) * count) / (climb.episodes + count)
        if climb.episodes
        else mean_of(own)
    )
    in_all = np.concatenate([asked.sum(axis=0)[changes.cells], np.full(len(changes.orders), count)])
    climb = _affordable(climb, in_all[climb.running], stream, left - count)
    gains, squares = np.zeros(len(climb.running)), np.zeros(len(climb.running))
    together = max(1, min(MOST_BYTES // climb.design.tables.size, MOST_EPISODES_AT_ONCE // count))
    for first in range(0, len(climb.running), together):
        part = climb.running[first : first + together]
        rows, episodes = np.nonzero(_tried(changes, part, asked))
        returns = arena.paired_returns(changes.applied(part), rows, paired, climb.episodes + episodes)
        ends = np.cumsum(in_all[part])[:-1]
        for row, differences in enumerate(np.split(returns - own[episodes], ends), first):
            if differences.any():
                gains[row] = fsum(differences.tolist()) / count
                apart = fsum(((differences - gains[row]) ** 2).tolist())
                squares[row] = apart + (count - len(differences)) * gains[row] ** 2
    tried = in_all[climb.running]
    gains, squares = _merged(climb, gains, squares, count)
    return replace(
        climb,
        mean=mean,
        gains=gains,
        squares=squares,
        tried=climb.tried + tried,
        episodes=climb.episodes + count,
        spent=climb.spent + count + int(tried.sum()),
    )


def _tried(changes: Changes, which: NDArray[np.int64], asked: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return in which episodes some changes are to be tried, (n_changes, n_episodes), given the cells asked in each."""
    tried = np.ones((len(which), len(asked)), np.bool_)
    of_cells = which < len(changes.cells)
    tried[of_cells] = asked.T[changes.cells[which[of_cells]]]
    return tried


def _affordable(climb: Climb, costs: NDArray[np.int64], stream: int, left: int) -> Climb:
    """Return the climb with the most promising changes that so many episodes pay for, given what each costs."""
    if costs.sum() <= left:
        return climb
    promise = _scores(climb) if climb.episodes else uniforms(fold(stream, SOME), climb.running.shape)
    order = np.argsort(-promise, kind="stable")
    paid = order[np.cumsum(costs[order]) <= left]
    return replace(_with_running(climb, np.sort(paid)), whole=False)


def _merged(
    climb: Climb, gains: NDArray[np.float64], squares: NDArray[np.float64], count: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return gains and squares of a climb and of more episodes together (Chan, Golub and LeVeque 1979)."""
    before, apart = climb.episodes, gains - climb.gains
    squares = climb.squares + squares + apart**2 * (before * count / (before + count))
    return climb.gains + apart * (count / (before + count)), squares


def _scores(climb: Climb) -> NDArray[np.float64]:
    """Return how many standard errors each change is above the design, infinitely many where it is certain."""
    n = climb.episodes
    errors = np.sqrt(climb.squares / max(1, n - 1) / max(1, n))
    certain = np.where(climb.gains == 0, 0.0, np.copysign(np.inf, climb.gains))
    return np.where(errors > 0, climb.gains / np.where(errors > 0, errors, 1), certain)


def _changed(
    climb: Climb, changes: Changes, better: NDArray[np.int64], arena: Arena, stream: int, budget: int
) -> Climb:
    """Return the climb after the best of some better changes was made, and others with it if that is better still.

    Changes that help by themselves need not help together: the best, the best two and so on are run in fresh
    episodes.
    """
    best = better[np.argsort(-climb.gains[better], kind="stable")]
    count = climb.episodes
    affordable = (budget - climb.spent) // count
    made = changes.compatible(climb.running[best])[: min(MOST_TOGETHER, affordable)]
    if len(made) < 2:
        design, mean = changes.applied(climb.running[best[:1]]), climb.mean + float(climb.gains[best[0]])
    else:
        designs = changes.applied_together(made)
        means = arena.means(designs, stream, count)
        most = int(np.argmax(means))
        design, mean = designs[most : most + 1], float(means[most])
        climb = replace(climb, spent=climb.spent + count * len(made))
    return _after_pass(replace(climb, design=design, mean=mean), at_optimum=False)


def _after_pass(climb: Climb, *, at_optimum: bool) -> Climb:
    """Return the climb at the end of a pass."""
    nothing = _with_changes(climb, np.empty(0, np.int64))
    return replace(nothing, episodes=0, passes=climb.passes + 1, at_optimum=at_optimum)


def _with_changes(climb: Climb, running: NDArray[np.int64]) -> Climb:
    """Return the climb with changes of which nothing is known yet."""
    zeros, n = np.zeros(len(running)), np.zeros(len(running), np.int64)
    return replace(climb, running=running, gains=zeros, squares=zeros, tried=n, whole=True)


def _with_running(climb: Climb, kept: NDArray[np.int64]) -> Climb:
    """Return the climb with some of its running changes only, by their indices among these."""
    return replace(
        climb,
        running=climb.running[kept],
        gains=climb.gains[kept],
        squares=climb.squares[kept],
        tried=climb.tried[kept],
    )
