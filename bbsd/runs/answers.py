"""The answers of all runs of a command, made one after another or side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bbsd.architecture import Architecture
    from bbsd.engines.processes import Processes
    from bbsd.runs.command import Command, Listener


def complete_runs(
    command: Command, jobs: int, listener: Listener | None = None, ready: Processes | None = None
) -> list[Architecture]:
    """Complete all runs and return their answers in order; with several jobs, unfinished runs go side by side."""
    answers = {run: command.answer(run) for run in range(command.n_runs)}
    unfinished = [run for run, answer in answers.items() if answer is None]
    if min(len(unfinished), jobs) > 1:
        from bbsd.runs.workers import side_by_side

        answers |= side_by_side(command, unfinished, jobs, listener, ready)
    else:
        answers |= {run: command.complete(run, listener) for run in unfinished}
    return [answer for answer in answers.values() if answer is not None]
