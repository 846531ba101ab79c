"""What a command runs and where it is kept; how one of its runs is completed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from bbsd.runs.run import generations, start

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.runs.folder import Folder
    from bbsd.runs.records import Records
    from bbsd.solver.settings import Settings

    Listener = Callable[[dict[str, Any]], None]
    """Called with the metrics of each generation."""


@dataclass(frozen=True, slots=True, eq=False)
class Command:
    """Several runs of one problem, and the folder that keeps them."""

    problem: Problem
    settings: Settings
    seed: int
    n_runs: int
    folder: Folder

    def with_threads(self, jobs: int) -> Command:
        """Return the same command with this number of threads in each run."""
        return replace(self, problem=replace(self.problem, jobs=jobs))

    def records(self, run: int) -> Records:
        """Return the records of a run, which counts from 0."""
        return self.folder.records(run, self.n_runs)

    def answer(self, run: int) -> Architecture | None:
        """Return the answer of a run, or None if it is not complete. Raises FolderError for damaged files."""
        reached = self.records(run).load()
        return None if reached is None else reached.answer

    def complete(self, run: int, listener: Listener | None = None) -> Architecture:
        """Start or resume a run and return its answer; each generation is saved before it is reported."""
        records = self.records(run)
        reached = records.load() or start(self.problem, self.settings, self.seed, run)
        for reached, line in generations(reached, self.problem, self.settings, self.seed):  # noqa: B020
            records.save(reached, line)
            if listener is not None and line is not None:
                listener(line)
        if reached.answer is None:
            raise RuntimeError("a run ended without an answer")
        return reached.answer
