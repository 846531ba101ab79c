"""Runs side by side in several processes: this one, and workers that loky starts.

A worker keeps its runs' records itself, so nothing but answers has to come back. It goes on as long as a pipe to its
parent is open: when the parent wants to stop, or is no more, it stops at the next episode, or soon at any place.
"""

from __future__ import annotations

import os
import signal
import threading
import time
from collections import deque
from concurrent.futures import BrokenExecutor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager, suppress
from multiprocessing import Pipe, resource_tracker
from typing import TYPE_CHECKING

from bbsd.errors import UsageError
from bbsd.solver.following import Follower
from bbsd.solver.interruption import Wish, heed, own_wish, present_wish
from bbsd.solver.rehearsal import rehearse

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from multiprocessing.connection import Connection
    from pathlib import Path

    from bbsd.architecture import Architecture
    from bbsd.solver.command import Command, Tell

    Submit = Callable[[int], Future[Architecture]]

GRACE = 0.8
"""Seconds in which a worker should have stopped by itself; fewer than its parent has."""
GLANCE = 0.1
"""Seconds between two looks at how far the workers are."""
STOPPED = 130
ENVIRONMENT = {"PYTHONSAFEPATH": "1", "PYTHONWARNINGS": "ignore:resource_tracker:UserWarning"}
"""They import nothing from the present folder; and one of loky's cleans up after a killed parent without a word."""


class WorkerLost(UsageError):
    """A worker that was ended from outside."""

    advice = "go on with --resume; fewer --jobs need less memory"

    def __init__(self, folder: Path) -> None:
        super().__init__(
            "a process that did one of the runs was killed, maybe by the system for want of memory; "
            f"what was done is kept in {folder}"
        )


def side_by_side(command: Command, runs: list[int], jobs: int, tell: Tell | None) -> dict[int, Architecture]:
    """The answers of these runs, several at a time; jobs that are left over are threads inside them.

    Raises what a run raised, WorkerLost, KeyboardInterrupt; all others are stopped then.
    """
    n_workers = min(len(runs), jobs) - 1
    threads = jobs // (n_workers + 1)
    own = command.with_threads(jobs - n_workers * threads)
    with _workers(n_workers, command.with_threads(threads)) as submit:
        # Everything is compiled once, here, while the workers import what they need.
        rehearse(own.problem, own.settings)
        return _shared(own, runs, submit, n_workers, tell or (lambda _line: None))


def _shared(
    command: Command, runs: list[int], submit: Submit, n_workers: int, tell: Tell
) -> dict[int, Architecture]:
    """Whoever is free takes the next run: this process, and a thread of it for each worker."""
    left, wish = deque(runs), present_wish()
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
            raise (KeyboardInterrupt if wish.is_made else WorkerLost(command.folder.path)) from None

    try:
        with ThreadPoolExecutor(n_workers) as pool, _wished_at_errors(wish):
            busy = [pool.submit(_take_runs, remote, left, found, failed, wish) for _ in range(n_workers)]
            for run in _taken(left):
                found[run] = command.complete(run, glance)
            while wait(busy, GLANCE).not_done:
                heed()
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
    wish: Wish,
) -> None:
    for run in _taken(left):
        try:
            found[run] = do(run)
        except BaseException as error:  # noqa: BLE001 - raised by the thread that waits for all
            failed[run] = error
            left.clear()
            wish.make()


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
def _wished_at_errors(wish: Wish) -> Iterator[None]:
    """Have everything stopped when something goes wrong in here."""
    try:
        yield
    except BaseException:
        wish.make()
        raise


@contextmanager
def _workers(count: int, command: Command) -> Iterator[Submit]:
    """Start so many processes that wait for runs, and end them."""
    from loky import ProcessPoolExecutor

    wish, cutting = present_wish(), threading.RLock()
    reader, lifeline = Pipe(duplex=False)

    def cut() -> None:
        with cutting:
            lifeline.close()

    wish.when_made(cut)
    with _environment():
        executor = ProcessPoolExecutor(count, initializer=_begin, initargs=(command, reader))
        resource_tracker.ensure_running()  # it would unblock interrupts when it is started with the first worker
        try:
            with _wished_at_errors(wish):
                with _no_interrupts():
                    executor.submit(_here)
                yield lambda run: executor.submit(_complete, run)
        finally:
            executor.shutdown(wait=True)
            cut()
            reader.close()


@contextmanager
def _environment() -> Iterator[None]:
    """The environment of processes that are started in here, and what it was again afterwards."""
    before = {name: os.environ.get(name) for name in ENVIRONMENT}
    os.environ.update(ENVIRONMENT)
    try:
        yield
    finally:
        for name, value in before.items():
            os.environ.pop(name)
            os.environ.update({} if value is None else {name: value})


@contextmanager
def _no_interrupts() -> Iterator[None]:
    """Processes that are started in here never notice Ctrl-C; this one does, once it is out of here."""
    if os.name != "posix":
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


_held: list[Command] = []
"""Of a worker: what it works on."""


def _begin(command: Command, lifeline: Connection) -> None:
    """Make a worker of this process."""
    _held.append(command)
    threading.Thread(target=_stop_with_parent, args=(lifeline, own_wish()), daemon=True).start()


def _stop_with_parent(lifeline: Connection, wish: Wish) -> None:
    with suppress(EOFError, OSError):
        lifeline.recv_bytes()
    wish.make()
    time.sleep(GRACE)
    os._exit(STOPPED)  # whatever it does: what it kept is whole


def _here() -> None:
    """Do nothing; the first call of an executor starts its processes."""


def _complete(run: int) -> Architecture:
    return _held[0].complete(run)
