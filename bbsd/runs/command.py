"""What a command runs and where it is kept; how one of its runs is completed."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

from bbsd.runs.run import generations, run_key, start
from bbsd.runs.searching import Course
from bbsd.runs.storage import census
from bbsd.runs.storage.records import Journal
from bbsd.runs.storage.state import RunState, Searching, restored_run, run_arrays
from bbsd.solver.search import RACE_SHARE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.runs.origin import Origin
    from bbsd.runs.storage.census import Table
    from bbsd.runs.storage.checkpoint import Arrays
    from bbsd.runs.storage.folder import Folder
    from bbsd.runs.storage.identity import Identity
    from bbsd.runs.storage.records import Records
    from bbsd.solver.paper.settings import Settings

    Listener = Callable[[dict[str, Any]], None]
    """Called with each line of metrics."""


@dataclass(frozen=True, slots=True, eq=False)
class Command:
    """Several runs of one problem, and the folder that keeps them."""

    problem: Problem
    settings: Settings
    seed: int
    n_runs: int
    folder: Folder
    who: Identity
    budgets: tuple[int, ...] = ()
    """The budgets of each run, one after another; none for the paper's loop, which has generations."""
    seconds: float | None = None
    """The time of each run, at the end of the search's part of which its rounds end."""
    is_limited: bool = False
    """Whether that time is a limit beside the budget, rather than what the budget was worked out from."""
    origin: Origin | None = None
    """What the command is made of, so that a worker can make it too."""

    def with_threads(self, jobs: int) -> Command:
        """Return the same command with this number of threads in each run."""
        return replace(self, problem=replace(self.problem, jobs=jobs))

    def records(self, run: int) -> Records:
        """Return the records of a run, which counts from 0."""
        return self.folder.records(run, self.n_runs)

    def reached(self, run: int) -> RunState | None:
        """Return how far a run is, or None if it has not begun. Raises FolderError for damaged files."""
        return self.records(run).load(self.who, partial(self.restored, run))

    def restored(self, run: int, arrays: Arrays) -> RunState:
        """Return a run of which these are the arrays. Raises CheckpointError where they cannot be."""
        return restored_run(arrays, self.fresh(run), self.problem)

    def answer(self, run: int) -> Architecture | None:
        """Return the answer of a run, or None if it is not complete. Raises FolderError for damaged files."""
        reached = self.reached(run)
        return reached.answer if reached is not None and self.is_complete(reached) else None

    def complete(self, run: int, listener: Listener | None = None) -> Architecture:
        """Start or resume a run and return its answer; each line is written before it is reported."""
        reached = self.reached(run) or self.fresh(run)
        deadline = None if self.seconds_of_search is None else time.monotonic() + self.seconds_of_search
        with Journal(self.records(run), self.who) as journal:
            for reached, line in self.steps(reached, deadline):  # noqa: B020
                journal.add(partial(run_arrays, reached), line, self.tables(reached, line, journal.lines + 1))
                if listener is not None and line is not None:
                    listener(line)
        if reached.answer is None:
            raise RuntimeError("a run ended without an answer")
        return reached.answer

    def tables(self, reached: RunState, line: dict[str, Any] | None, number: int) -> Iterator[Table]:
        """Return what a step adds to the run's tables, given the number of its line of metrics."""
        return (
            iter(())
            if line is None
            else census.tables(reached, line.get("episodes", 0), self.problem, number)
        )

    def _course(self, run: int) -> Course:
        return Course(self.problem, self.settings, run_key(self.seed, run), run)

    def fresh(self, run: int) -> RunState:
        """Return a run before its beginning."""
        if self.settings.method == "paper":
            return start(self.problem, self.settings, self.seed, run)
        return self._course(run).start(self.budgets[0])

    @property
    def seconds_of_search(self) -> float | None:
        """The time of a run's rounds, where a run has a time."""
        return None if self.seconds is None else self.seconds * (1 - RACE_SHARE)

    def steps(
        self, reached: RunState, deadline: float | None = None
    ) -> Iterator[tuple[RunState, dict[str, Any] | None]]:
        """Continue a run from the state it has reached; yield its state after every step, and its line of metrics.

        Rounds and generations end at the deadline, on the monotonic clock, where there is one.
        """
        if self.settings.method == "paper":
            return generations(reached, self.problem, self.settings, self.seed, deadline)
        return self._course(reached.run).steps(reached, self.budgets, deadline)

    def is_complete(self, reached: RunState) -> bool:
        """Return whether a run is at its end."""
        if isinstance(reached.state, Searching):
            return reached.state.finished >= len(self.budgets)
        return reached.answer is not None
