"""Times of calls, taken in alternation, so that other load on the machine affects all calls alike."""

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
"""The cores that this process may use."""

SHORT = 0.1
"""Seconds; a call that takes less is made twice, since the first one after another peer may take twice as long."""


@dataclass(frozen=True, slots=True)
class Spread:
    """A median and the quartiles around it."""

    median: float
    low: float
    high: float


def spread(values: Floats) -> Spread:
    """Return the median and quartiles of measured values (n_rounds,)."""
    low, median, high = np.percentile(values, [25, 50, 75])
    return Spread(float(median), float(low), float(high))


def alternating_times(
    calls: Mapping[str, Callable[[], Any]], rounds: int, clock: Callable[[], float] = time.process_time
) -> dict[str, Floats]:
    """Return the seconds that each call took in each round, (n_rounds,) by name.

    Every other round goes through the calls in reverse order. The default clock is the processor's time, since a busy
    machine interrupts long calls more often than short ones; where several cores work, pass a wall clock.
    """
    names = list(calls)
    times = {name: np.empty(rounds) for name in names}
    for call in calls.values():
        call()
    for turn in range(rounds):
        for name in names if turn % 2 else reversed(names):
            times[name][turn] = _warm_time(calls[name], clock)
    return times


def _warm_time(call: Callable[[], Any], clock: Callable[[], float]) -> float:
    """Return the time of a call; of a second one if it was short, since caches and wide vectors have to wake up."""
    for _ in range(2):
        began = clock()
        call()
        if (seconds := clock() - began) > SHORT:
            break
    return seconds


def pin_to_one_core() -> None:
    """Keep this process and its children on one core where the system allows it, and XLA on one thread."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(CORES)})
    os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"


@contextmanager
def all_cores() -> Iterator[None]:
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
