"""A run that workers do, as the process sees it that keeps the run's files."""

from __future__ import annotations

import json
import time
from functools import partial
from typing import TYPE_CHECKING, Any

from bbsd.engines.units import Unit
from bbsd.runs.storage import checkpoint
from bbsd.runs.storage.records import INTERVAL, METRICS, Journal
from bbsd.runs.storage.state import run_arrays
from bbsd.runs.workers.portions import BEGUN, STATE, WORK, Begun, order_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.architecture import Architecture
    from bbsd.engines.units import Result
    from bbsd.runs.command import Command, Listener
    from bbsd.runs.storage.checkpoint import Arrays

FIRST, PORTION = 0.25, 1.0
"""Seconds of the first portion of a run, and of later ones."""
PORTIONS, SAVED = 100, 20
"""Portions that come back in a second, and states that are saved in it, at most: a thousand workers wait for one."""


class RemoteRun:
    """A run whose portions are done by workers, and whose files are written here."""

    def __init__(
        self, command: Command, run: int, listener: Listener, side_by_side: Callable[[], int]
    ) -> None:
        """Begin or resume a run.

        Args:
            command: What it is a run of.
            run: Its number, from 0.
            listener: Called with each line of metrics that was written.
            side_by_side: Returns how many runs are done at the same time.
        """
        self.run = run
        self.answer: Architecture | None = None
        self._command, self._listener, self._side_by_side = command, listener, side_by_side
        self._order = order_of(command, run)
        reached = command.reached(run)
        self._journal = Journal(command.records(run), command.who)
        self._state = None if reached is None else checkpoint.packed(command.who, run_arrays(reached))
        self._deadline: float | None = None
        self._portions = 0
        self._texts: dict[str, bytes] = {}
        self._sizes, self._lines = self._journal.sizes(), self._journal.lines

    @property
    def name(self) -> str:
        """What people call it."""
        return f"run {self.run + 1}"

    def unit(self) -> Unit:
        """Return the next portion."""
        begun = Begun(self._lines, [name for name, size in self._sizes.items() if size], self._seconds_left())
        state = {} if self._state is None else {STATE: self._state}
        portion = max(PORTION, self._side_by_side() / PORTIONS)
        seconds = min(portion, FIRST * 2**self._portions)
        return Unit(self.name, WORK, self._order, {BEGUN: begun.to_bytes(), **state}, seconds)

    def take(self, result: Result) -> bool:
        """Take over what a portion came to, and return whether the run is complete."""
        self._portions = min(self._portions + 1, 30)
        self._texts = dict(result.files)
        self._state = self._texts.pop(STATE, self._state)
        for name, text in self._texts.items():
            self._sizes[name] = self._sizes.get(name, 0) + len(text)
        self._lines += self._texts.get(METRICS, b"").count(b"\n")
        if result.finished:
            self.answer = self._command.restored(self.run, self._arrays(self._state)).answer
        return result.finished

    def write(self) -> None:
        """Write what was taken, then report the lines of metrics."""
        if not self._texts and self.answer is None:
            return
        interval = 0.0 if self.answer else max(INTERVAL, self._side_by_side() / SAVED)
        # The next portion's state comes before what it adds to the files: what is saved is the one of now.
        self._journal.add_texts(self._texts, partial(self._arrays, self._state), interval)
        for line in self._texts.get(METRICS, b"").splitlines():
            self._listener(json.loads(line))

    def close(self) -> None:
        """Save the last state, where it is not saved already."""
        self._journal.save()

    def _arrays(self, state: bytes | None) -> Arrays:
        return checkpoint.unpacked(state or b"", self._command.who, self.name)

    def _seconds_left(self) -> float | None:
        """Return what is left of the time of the run's rounds, which begins when it is first asked for."""
        seconds: Any = self._command.seconds_of_search
        if seconds is None:
            return None
        if self._deadline is None:
            self._deadline = time.monotonic() + seconds
        return max(0.0, self._deadline - time.monotonic())
