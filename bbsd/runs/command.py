"""All runs of a command: each goes on from where it stood, one after the other or side by side."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from bbsd.runs.run import generations, start

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.runs.folder import Folder
    from bbsd.runs.processes import Processes
    from bbsd.runs.records import Records
    from bbsd.solver.settings import Settings

    Tell = Callable[[dict[str, Any]], None]
    """Is given the metrics of each generation."""


@dataclass(frozen=True, slots=True, eq=False)
class Command:
    """What is to be run, and where it is kept."""

    problem: Problem
    settings: Settings
    seed: int
    n_runs: int
    folder: Folder

    def with_threads(self, jobs: int) -> Command:
        """The same with so many threads in each run."""
        return replace(self, problem=replace(self.problem, jobs=jobs))

    def records(self, run: int) -> Records:
        """What is kept of a run, which counts from 0."""
        return self.folder.records(run, self.n_runs)

    def answer(self, run: int) -> Architecture | None:
        """A run's answer, None where it has not come to its end. Raises FolderError for damaged files."""
        progress = self.records(run).progress()
        return None if progress is None else progress.answer

    def complete(self, run: int, tell: Tell | None = None) -> Architecture:
        """Go on with a run to its answer; each generation is kept before it is told."""
        records = self.records(run)
        progress = records.progress() or start(self.problem, self.settings, self.seed, run)
        for reached, line in generations(progress, self.problem, self.settings, self.seed):
            progress = reached
            records.save(progress, line)
            if tell is not None and line is not None:
                tell(line)
        if progress.answer is None:
            raise RuntimeError("a run ended without an answer")
        return progress.answer


def answers(
    command: Command, jobs: int, tell: Tell | None = None, ready: Processes | None = None
) -> list[Architecture]:
    """The answers of all runs, in their order; with several jobs the runs that are left go side by side."""
    found = {run: command.answer(run) for run in range(command.n_runs)}
    left = [run for run, answer in found.items() if answer is None]
    if min(len(left), jobs) > 1:
        from bbsd.runs.workers import side_by_side

        found |= side_by_side(command, left, jobs, tell, ready)
    else:
        found |= {run: command.complete(run, tell) for run in left}
    return [answer for answer in found.values() if answer is not None]
