"""Runs side by side in several processes: this one, and workers.

A worker writes its runs' records itself, so it sends back nothing but answers.
"""

from __future__ import annotations

from collections import deque
from concurrent.futures import BrokenExecutor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager, nullcontext, suppress
from typing import TYPE_CHECKING

from bbsd.engines.processes import Processes, waiting_processes
from bbsd.errors import UsageError
from bbsd.runs.rehearsal import rehearse
from bbsd.runs.storage.following import Follower
from bbsd.stopping import StopRequest, current_stop_request, raise_if_stopped

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from bbsd.architecture import Architecture
    from bbsd.runs.command import Command, Listener

    Submit = Callable[[int], Future[Architecture]]

NEEDED = ("bbsd.runs.workers",)
"""What workers import before their first run."""
REPORT_INTERVAL = 0.1
"""Seconds between two looks at the workers' metrics."""


class WorkerLost(UsageError):
    """A worker that was killed from outside."""

    advice = "continue with --resume; fewer --jobs need less memory"

    def __init__(self, folder: Path) -> None:
        super().__init__(
            "a process that did one of the runs was killed, maybe by the system for lack of memory; "
            f"all finished generations are kept in {folder}"
        )


def side_by_side(
    command: Command, runs: list[int], jobs: int, listener: Listener | None, ready: Processes | None = None
) -> dict[int, Architecture]:
    """Complete these runs, several at a time, and return their answers; spare jobs are threads inside them.

    Uses the workers that are `ready`, or starts new ones. Raises what a run raised, WorkerLost, KeyboardInterrupt,
    after all other runs were stopped.
    """
    n_workers = min(len(runs), jobs) - 1
    threads = jobs // (n_workers + 1)
    own = command.with_threads(jobs - n_workers * threads)
    with (
        nullcontext(ready) if ready is not None else waiting_processes(n_workers, NEEDED) as processes,
        _working(processes, command.with_threads(threads)) as submit,
    ):
        # Everything is compiled once, here, while the workers import what they need.
        rehearse(own.problem, own.settings)
        return _share_runs(own, runs, submit, n_workers, listener or (lambda _line: None))


def _share_runs(
    command: Command, runs: list[int], submit: Submit, n_workers: int, listener: Listener
) -> dict[int, Architecture]:
    """Let this process, and a thread of it for each worker, take the next run whenever it is free."""
    remaining, request = deque(runs), current_stop_request()
    answers: dict[int, Architecture] = {}
    failed: dict[int, BaseException] = {}
    followers = [Follower(command.records(run).metrics) for run in runs]

    def report(_line: object = None) -> None:
        for follower in followers:
            for line in follower.new_lines():
                listener(line)

    def remote(run: int) -> Architecture:
        try:
            return submit(run).result()
        except BrokenExecutor:
            raise (KeyboardInterrupt if request.is_made else WorkerLost(command.folder.path)) from None

    try:
        with ThreadPoolExecutor(n_workers) as pool, _stop_at_errors(request):
            busy = [
                pool.submit(_take_runs, remote, remaining, answers, failed, request) for _ in range(n_workers)
            ]
            for run in _taken(remaining):
                answers[run] = command.complete(run, report)
            while wait(busy, REPORT_INTERVAL).not_done:
                raise_if_stopped()
                report()
            report()
    except KeyboardInterrupt:
        _raise_first(failed)
        raise
    _raise_first(failed)
    return answers


def _take_runs(
    complete: Callable[[int], Architecture],
    remaining: deque[int],
    answers: dict[int, Architecture],
    failed: dict[int, BaseException],
    request: StopRequest,
) -> None:
    for run in _taken(remaining):
        try:
            answers[run] = complete(run)
        except BaseException as error:  # noqa: BLE001 - raised by the thread that waits for all
            failed[run] = error
            remaining.clear()
            request.make()


def _taken(remaining: deque[int]) -> Iterator[int]:
    """Yield the runs that nobody has taken yet, and take them."""
    with suppress(IndexError):
        while True:
            yield remaining.popleft()


def _raise_first(failed: dict[int, BaseException]) -> None:
    """Raise the error of the first run that failed by itself; others were only stopped."""
    for _, error in sorted(failed.items()):
        if not isinstance(error, KeyboardInterrupt):
            raise error
    if failed:
        raise KeyboardInterrupt


@contextmanager
def _stop_at_errors(request: StopRequest) -> Iterator[None]:
    """Make the request to stop when something inside raises."""
    try:
        yield
    except BaseException:
        request.make()
        raise


@contextmanager
def _working(processes: Processes, command: Command) -> Iterator[Submit]:
    """Give a function that submits runs of a command to processes, and end these at exit or at a stop request."""
    request = current_stop_request()
    request.when_made(processes.stop)
    with _stop_at_errors(request):
        yield lambda run: processes.submit(_complete, command, run)
    processes.dismiss()


def _complete(command: Command, run: int) -> Architecture:
    return command.complete(run)
