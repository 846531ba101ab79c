"""Times taken in alternation, so that whatever else the machine does meets all alike."""

from __future__ import annotations

import os
import time
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

Floats = npt.NDArray[np.float64]

CORES = os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else set(range(os.cpu_count() or 1))
"""Those that this process may use."""


SHORT = 0.1
"""Seconds of a call that is made twice."""


@dataclass(frozen=True, slots=True)
class Spread:
    """A median and the quartiles around it."""

    median: float
    low: float
    high: float


def spread(values: Floats) -> Spread:
    """The spread of measured values, (n_rounds,)."""
    low, median, high = np.percentile(values, [25, 50, 75])
    return Spread(float(median), float(low), float(high))


def alternated(
    calls: Mapping[str, Callable[[], Any]], rounds: int, clock: Callable[[], float] = time.process_time
) -> dict[str, Floats]:
    """Seconds that each call took in each round, (rounds,); the order turns round by round.

    Of the processor's time and not the clock's, but where several cores work: a busy machine interrupts long calls more
    often than short ones.
    """
    names = list(calls)
    times = {name: np.empty(rounds) for name in names}
    for call in calls.values():
        call()
    for turn in range(rounds):
        for name in names if turn % 2 else reversed(names):
            times[name][turn] = _warm(calls[name], clock)
    return times


def _warm(call: Callable[[], Any], clock: Callable[[], float]) -> float:
    """The time of a call; of a second one if it was short, since memory and wide vectors have to wake up first."""
    for _ in range(2):
        began = clock()
        call()
        if (taken := clock() - began) > SHORT:
            break
    return taken


def on_one_core() -> None:
    """Keep this process and its children on one core, where the system can; and XLA to one thread."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(CORES)})
    os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"


@contextmanager
def on_all_cores() -> Iterator[None]:
    """Let this process and its children use every core that it had when it began."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, CORES)
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)
