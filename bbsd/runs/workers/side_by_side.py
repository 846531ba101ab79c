"""Runs side by side: this process does some, if the engine is of this machine, and workers do the others.

Whatever a worker gives back is written by this process, which alone knows the folder.
"""

from __future__ import annotations

from collections import deque
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import contextmanager, nullcontext, suppress
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, Any

from bbsd.engines.carrying import Carried, carry_out
from bbsd.engines.engine import ATTEMPTS
from bbsd.engines.local import processes_engine
from bbsd.engines.units import Unit
from bbsd.errors import UsageError
from bbsd.runs.rehearsal import rehearse
from bbsd.runs.workers.portions import PREPARE, order_of
from bbsd.runs.workers.remote import RemoteRun
from bbsd.stopping import StopRequest, current_stop_request, raise_if_stopped

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from bbsd.architecture import Architecture
    from bbsd.engines.carrying import Task
    from bbsd.engines.engine import Engine
    from bbsd.runs.command import Command, Listener

NEEDED = ("bbsd.runs.workers.portions",)
"""What workers import before their first run."""
REPORT_INTERVAL = 0.1
"""Seconds between two looks at what workers gave back."""


class RunsLost(UsageError):
    """Runs that lost their worker again and again."""

    advice = "continue with --resume; fewer --jobs need less memory"

    def __init__(self, folder: Path, runs: Sequence[int]) -> None:
        """Name the runs, which count from 0."""
        self.runs = tuple(runs)
        names = ", ".join(str(run + 1) for run in runs)
        super().__init__(
            f"{ATTEMPTS} processes that did {'run' if len(runs) == 1 else 'each of the runs'} {names} were killed, "
            "one after the other, maybe by the system for lack of memory; the other runs were completed, and all "
            f"finished generations are kept in {folder}"
        )


def side_by_side(
    command: Command, runs: list[int], jobs: int, listener: Listener | None, engine: Engine | None = None
) -> dict[int, Architecture]:
    """Complete these runs, several at a time, and return their answers; spare jobs are threads inside them.

    Uses an engine that is there, or starts processes.

    Raises:
        RunsLost: some lost their worker again and again; all others are complete.
        KeyboardInterrupt: a stop was requested.
        Exception: whatever a run raised, after all others were stopped.
    """
    listener = listener or (lambda _line: None)
    if engine is not None and not engine.shares_machine:
        with _stopping(engine):
            return _share_runs(command.with_threads(1), None, runs, engine, listener)
    n_workers = min(len(runs), jobs) - 1
    threads = jobs // (n_workers + 1)
    own = command.with_threads(jobs - n_workers * threads)
    theirs = command.with_threads(threads)
    with (
        nullcontext(engine) if engine is not None else processes_engine(n_workers, NEEDED) as started,
        _stopping(started),
    ):
        started.prepare(Unit("preparation", PREPARE, order_of(theirs, runs[0])))
        # Everything is compiled once, here, while the workers import what they need and read the spec.
        rehearse(own.problem, own.settings)
        answers = _share_runs(theirs, own, runs, started, listener)
        started.dismiss()
        return answers


def _share_runs(
    command: Command, own: Command | None, runs: list[int], engine: Engine, listener: Listener
) -> dict[int, Architecture]:
    """Let workers take the next run whenever one is free, and this process too if it has a command of its own."""
    remaining, request = deque(runs), current_stop_request()
    lines: SimpleQueue[dict[str, Any]] = SimpleQueue()
    answers: dict[int, Architecture] = {}
    begun: list[RemoteRun] = []

    def tasks() -> Iterator[RemoteRun]:
        for run in _taken(remaining):
            begun.append(RemoteRun(command, run, lines.put, lambda: min(len(runs), engine.capacity())))
            yield begun[-1]

    def carry() -> Carried:
        try:
            return carry_out(engine, tasks(), request)
        except BaseException:
            request.make()
            raise
        finally:
            for run in begun:
                run.close()

    def report(line: dict[str, Any] | None = None) -> None:
        """Report lines in this thread: those of workers, and one of a run of this process."""
        with suppress(Empty):
            while True:
                listener(lines.get_nowait())
        if line is not None:
            listener(line)

    with ThreadPoolExecutor(1) as pool, _stop_at_errors(request):
        carrying = pool.submit(carry)
        try:
            if own is not None:
                answers = {run: own.complete(run, report) for run in _taken(remaining)}
            while not wait([carrying], REPORT_INTERVAL).done:
                raise_if_stopped()
                report()
        except KeyboardInterrupt:
            _raise_first(carrying.result())
            raise
        report()
        carried = carrying.result()
    _raise_first(carried)
    if request.is_made:
        raise KeyboardInterrupt
    if carried.given_up:
        raise RunsLost(command.folder.path, sorted(_number(task) for task in carried.given_up))
    return answers | {run.run: run.answer for run in begun if run.answer is not None}


def _taken(remaining: deque[int]) -> Iterator[int]:
    """Yield the runs that nobody has taken yet, and take them."""
    with suppress(IndexError):
        while True:
            yield remaining.popleft()


def _raise_first(carried: Carried) -> None:
    """Raise the error of the first run that failed."""
    for _, error in sorted((_number(task), error) for task, error in carried.failed.items()):
        raise error


def _number(task: Task) -> int:
    if not isinstance(task, RemoteRun):
        raise TypeError("a task that is no run")
    return task.run


@contextmanager
def _stop_at_errors(request: StopRequest) -> Iterator[None]:
    """Make the request to stop when something inside raises."""
    try:
        yield
    except BaseException:
        request.make()
        raise


@contextmanager
def _stopping(engine: Engine) -> Iterator[None]:
    """Stop an engine when something inside raises, or a stop is requested."""
    request = current_stop_request()
    request.when_made(engine.stop)
    with _stop_at_errors(request):
        yield
