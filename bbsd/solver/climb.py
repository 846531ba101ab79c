"""A paired climb: single changes of one design, tried in the same episodes as the design itself until none helps.

All changes get the same few episodes; those that change nothing or are clearly worse are dropped, and the others get
twice as many, until one is clearly better or the last round is over. A climb is a plain value that can be written down
between two rounds.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation.sums import mean as mean_of
from bbsd.evaluation.sums import row_means
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
MOST_BYTES = 1 << 24
"""Tables of changed designs that are in memory at once."""


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
    episodes: int = 0
    """Common episodes of the design and each of these changes; 0 where a pass begins."""
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
    nothing = np.empty(0)
    return Climb(
        design=design, mean=float("nan"), running=np.empty(0, np.int64), gains=nothing, squares=nothing
    )


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
    stream = fold(key, word_of(climb.passes))
    if not climb.episodes:
        zeros = np.zeros(len(changes))
        climb = replace(climb, running=np.arange(len(changes)), gains=zeros, squares=zeros, whole=True)
    climb, count = _affordable(climb, stream, budget, most_episodes)
    climb = _compared(climb, changes, arena, fold(stream, PAIRED), count)
    scores, last = _scores(climb), climb.episodes >= most_episodes
    better = np.flatnonzero(scores > (BETTER_AT_LAST if last else BETTER))
    if len(better) and climb.episodes >= FEWEST_EPISODES:
        return _changed(climb, changes, better, arena, fold(stream, TOGETHER), budget)
    climb = _with_running(climb, np.flatnonzero(scores >= -WORSE))
    if last or not len(climb.running):
        return _after_pass(climb, at_optimum=climb.whole)
    return climb


def _affordable(climb: Climb, stream: int, budget: int, most_episodes: int) -> tuple[Climb, int]:
    """Return the climb with as many changes as the rest of the budget pays for, and the round's episodes."""
    left = budget - climb.spent
    count = min(max(climb.episodes, FIRST_EPISODES), most_episodes - climb.episodes, max(1, left // 2))
    few = left // count - 1
    if few >= len(climb.running):
        return climb, count
    promise = _scores(climb) if climb.episodes else uniforms(fold(stream, SOME), climb.running.shape)
    best = np.sort(np.argsort(-promise, kind="stable")[:few])
    return replace(_with_running(climb, best), whole=False), count


def _compared(climb: Climb, changes: Changes, arena: Arena, stream: int, count: int) -> Climb:
    """Return the climb after more common episodes; what changes nothing in the first of them is dropped."""
    together = max(1, MOST_BYTES // climb.design.tables.size)
    own = arena.returns(climb.design, stream, count, first=climb.episodes)[0]
    differences = [
        arena.returns(changes.applied(climb.running[first : first + together]), stream, count, climb.episodes)
        - own
        for first in range(0, len(climb.running), together)
    ]
    spent = climb.spent + count * (1 + len(climb.running))
    more = np.concatenate([np.empty((0, count)), *differences])
    if not climb.episodes:
        own_mean, kept = mean_of(own), np.flatnonzero(more.any(axis=1))
    else:
        own_mean = (climb.mean * climb.episodes + mean_of(own) * count) / (climb.episodes + count)
        kept = np.arange(len(more))
    climb, more = _with_running(climb, kept), more[kept]
    gains, squares = _merged(climb, more)
    return replace(
        climb, mean=own_mean, gains=gains, squares=squares, episodes=climb.episodes + count, spent=spent
    )


def _merged(climb: Climb, more: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return gains and squares after more differences, (n_running, count) (Chan, Golub and LeVeque 1979)."""
    count, before = more.shape[1], climb.episodes
    means = row_means(more)
    squares = row_means((more - means[:, np.newaxis]) ** 2) * count
    apart = means - climb.gains
    gains = climb.gains + apart * count / (before + count)
    return gains, climb.squares + squares + apart**2 * before * count / (before + count)


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
    nothing = _with_running(climb, np.empty(0, np.int64))
    return replace(nothing, episodes=0, passes=climb.passes + 1, at_optimum=at_optimum)


def _with_running(climb: Climb, kept: NDArray[np.int64]) -> Climb:
    """Return the climb with some of its running changes only, by their indices among these."""
    return replace(climb, running=climb.running[kept], gains=climb.gains[kept], squares=climb.squares[kept])
