"""Processes that wait for work. They may start before this one imports what the work needs, since that takes long.

Each works as long as a pipe to its parent is open. When the parent wants to stop, or has ended, a worker stops before
the next episode, or shortly after at any place.
"""

from __future__ import annotations

import atexit
import gc
import os
import signal
import threading
import time
from contextlib import contextmanager, suppress
from importlib import import_module
from multiprocessing import Pipe, resource_tracker
from typing import TYPE_CHECKING, Any

from bbsd.kernel.cache import cache_folder
from bbsd.stopping import stop_request_of_process

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from concurrent.futures import Executor, Future
    from multiprocessing.connection import Connection

    from bbsd.stopping import StopRequest

GRACE = 0.8
"""Seconds that a worker has to stop by itself; fewer than its parent has."""
STOPPED = 130
NEEDED = "bbsd.runs.workers"
ENVIRONMENT = {"PYTHONSAFEPATH": "1", "PYTHONWARNINGS": "ignore:resource_tracker:UserWarning"}
"""Workers import nothing from the current folder, and loky's tracker cleans up silently after a killed parent."""


class Processes:
    """Processes that wait for work."""

    def __init__(self, executor: Executor, lifeline: Connection) -> None:
        self.used = False
        self._executor = executor
        self._lifeline = lifeline
        self._stopping = threading.RLock()  # a signal handler may run in the middle of it

    def submit(self, function: Callable[..., Any], *arguments: object) -> Future[Any]:
        """Call the function in one of them, as soon as one is free."""
        self.used = True
        return self._executor.submit(function, *arguments)

    def dismiss(self) -> None:
        """Let them end once they have done what was submitted."""
        self._executor.shutdown(wait=False)

    def stop(self) -> None:
        """Make them stop; from any thread."""
        with self._stopping:
            self._lifeline.close()


@contextmanager
def waiting_processes(count: int) -> Iterator[Processes]:
    """Start so many processes, and end them at exit."""
    from loky import ProcessPoolExecutor

    cache_folder("compiled")  # a temporary one is then shared, and reported once
    reader, lifeline = Pipe(duplex=False)
    with _environment():
        executor = ProcessPoolExecutor(count, initializer=_prepare_worker, initargs=(reader,))
        processes = Processes(executor, lifeline)
        resource_tracker.ensure_running()  # it would unblock interrupts when it is started with the first worker
        try:
            with _no_interrupts():
                executor.submit(_do_nothing)
            yield processes
        finally:
            executor.shutdown(wait=True, kill_workers=not processes.used)
            processes.stop()
            reader.close()


@contextmanager
def _environment() -> Iterator[None]:
    """Set the environment of processes that are started inside, and restore it at exit."""
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
    """Hide Ctrl-C from processes that are started inside; this one gets it at exit."""
    if os.name != "posix":
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _prepare_worker(lifeline: Connection) -> None:
    """Make this process a worker, which stops when the lifeline is cut."""
    atexit.register(gc.freeze)  # as in the parent
    threading.Thread(
        target=_stop_with_parent, args=(lifeline, stop_request_of_process()), daemon=True
    ).start()
    import_module(NEEDED)


def _stop_with_parent(lifeline: Connection, request: StopRequest) -> None:
    with suppress(EOFError, OSError):
        lifeline.recv_bytes()
    request.make()
    time.sleep(GRACE)
    os._exit(STOPPED)  # at any place: what was written is whole


def _do_nothing() -> None:
    """Do nothing; the first call of an executor starts its processes."""
