"""Runs side by side in several processes: this one, and workers.

A worker keeps its runs' records itself, so nothing but answers has to come back.
"""

from __future__ import annotations

from collections import deque
from concurrent.futures import BrokenExecutor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager, nullcontext, suppress
from typing import TYPE_CHECKING

from bbsd.errors import UsageError
from bbsd.runs.following import Follower
from bbsd.runs.processes import Processes, waiting
from bbsd.runs.rehearsal import rehearse
from bbsd.stopping import StopRequest, current_stop_request, raise_if_stopped

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from bbsd.architecture import Architecture
    from bbsd.runs.command import Command, Listener

    Submit = Callable[[int], Future[Architecture]]

GLANCE = 0.1
"""Seconds between two looks at how far the workers are."""


class WorkerLost(UsageError):
    """A worker that was ended from outside."""

    advice = "go on with --resume; fewer --jobs need less memory"

    def __init__(self, folder: Path) -> None:
        super().__init__(
            "a process that did one of the runs was killed, maybe by the system for want of memory; "
            f"what was done is kept in {folder}"
        )


def side_by_side(
    command: Command, runs: list[int], jobs: int, tell: Listener | None, ready: Processes | None = None
) -> dict[int, Architecture]:
    """The answers of these runs, several at a time; jobs that are left over are threads inside them.

    Workers that are `ready` are taken, others are started. Raises what a run raised, WorkerLost, KeyboardInterrupt; all
    others are stopped then.
    """
    n_workers = min(len(runs), jobs) - 1
    threads = jobs // (n_workers + 1)
    own = command.with_threads(jobs - n_workers * threads)
    with (
        nullcontext(ready) if ready is not None else waiting(n_workers) as processes,
        _at_work(processes, command.with_threads(threads)) as submit,
    ):
        # Everything is compiled once, here, while the workers import what they need.
        rehearse(own.problem, own.settings)
        return _shared(own, runs, submit, n_workers, tell or (lambda _line: None))


def _shared(
    command: Command, runs: list[int], submit: Submit, n_workers: int, tell: Listener
) -> dict[int, Architecture]:
    """Whoever is free takes the next run: this process, and a thread of it for each worker."""
    left, request = deque(runs), current_stop_request()
    found: dict[int, Architecture] = {}
    failed: dict[int, BaseException] = {}
    followers = [Follower(command.records(run).metrics) for run in runs]

    def glance(_line: object = None) -> None:
        for follower in followers:
            for line in follower.new_lines():
                tell(line)

    def remote(run: int) -> Architecture:
        try:
            return submit(run).result()
        except BrokenExecutor:
            raise (KeyboardInterrupt if request.is_made else WorkerLost(command.folder.path)) from None

    try:
        with ThreadPoolExecutor(n_workers) as pool, _stopped_at_errors(request):
            busy = [pool.submit(_take_runs, remote, left, found, failed, request) for _ in range(n_workers)]
            for run in _taken(left):
                found[run] = command.complete(run, glance)
            while wait(busy, GLANCE).not_done:
                raise_if_stopped()
                glance()
            glance()
    except KeyboardInterrupt:
        _raise_first(failed)
        raise
    _raise_first(failed)
    return found


def _take_runs(
    do: Callable[[int], Architecture],
    left: deque[int],
    found: dict[int, Architecture],
    failed: dict[int, BaseException],
    request: StopRequest,
) -> None:
    for run in _taken(left):
        try:
            found[run] = do(run)
        except BaseException as error:  # noqa: BLE001 - raised by the thread that waits for all
            failed[run] = error
            left.clear()
            request.make()


def _taken(left: deque[int]) -> Iterator[int]:
    """The runs that nobody took before, one by one."""
    with suppress(IndexError):
        while True:
            yield left.popleft()


def _raise_first(failed: dict[int, BaseException]) -> None:
    """Raise what went wrong in the first run in which something did; others were only stopped."""
    for _, error in sorted(failed.items()):
        if not isinstance(error, KeyboardInterrupt):
            raise error
    if failed:
        raise KeyboardInterrupt


@contextmanager
def _stopped_at_errors(request: StopRequest) -> Iterator[None]:
    """Have everything stopped when something goes wrong in here."""
    try:
        yield
    except BaseException:
        request.make()
        raise


@contextmanager
def _at_work(processes: Processes, command: Command) -> Iterator[Submit]:
    """Have processes do runs of a command until they are done or are to stop."""
    request = current_stop_request()
    request.when_made(processes.cut)
    with _stopped_at_errors(request):
        yield lambda run: processes.submit(_complete, command, run)
    processes.dismiss()


def _complete(command: Command, run: int) -> Architecture:
    return command.complete(run)
