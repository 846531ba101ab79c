"""The answers of all runs of a command, made one after another or side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bbsd.architecture import Architecture
    from bbsd.engines.engine import Engine
    from bbsd.runs.command import Command, Listener


def complete_runs(
    command: Command, jobs: int, listener: Listener | None = None, engine: Engine | None = None
) -> list[Architecture]:
    """Complete all runs and return their answers in order.

    With several jobs, unfinished runs go side by side; an engine of other machines does them all.
    """
    answers = {run: command.answer(run) for run in range(command.n_runs)}
    unfinished = [run for run, answer in answers.items() if answer is None]
    is_elsewhere = engine is not None and not engine.shares_machine
    if unfinished and (is_elsewhere or min(len(unfinished), jobs) > 1):
        from bbsd.runs.workers.side_by_side import side_by_side

        answers |= side_by_side(command, unfinished, jobs, listener, engine)
    else:
        answers |= {run: command.complete(run, listener) for run in unfinished}
    return [answer for answer in answers.values() if answer is not None]
