"""Processes that wait for work. They may be started before this one imports what the work needs, as that takes long.

Each goes on as long as a pipe to its parent is open: when the parent wants to stop, or is no more, a worker stops at
the next episode, or soon at any place.
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
"""Seconds in which a worker should have stopped by itself; fewer than its parent has."""
STOPPED = 130
NEEDED = "bbsd.runs.workers"
ENVIRONMENT = {"PYTHONSAFEPATH": "1", "PYTHONWARNINGS": "ignore:resource_tracker:UserWarning"}
"""They import nothing from the present folder; and one of loky's cleans up after a killed parent without a word."""


class Processes:
    """Processes that wait for work."""

    def __init__(self, executor: Executor, lifeline: Connection) -> None:
        self.used = False
        self._executor = executor
        self._lifeline = lifeline
        self._cutting = threading.RLock()  # a handler may come in the middle of it

    def submit(self, function: Callable[..., Any], *arguments: object) -> Future[Any]:
        """Have one of them do it, as soon as one is free."""
        self.used = True
        return self._executor.submit(function, *arguments)

    def dismiss(self) -> None:
        """Have them end once they have done what was submitted."""
        self._executor.shutdown(wait=False)

    def cut(self) -> None:
        """Have them stop; from any thread."""
        with self._cutting:
            self._lifeline.close()


@contextmanager
def waiting(count: int) -> Iterator[Processes]:
    """Start so many processes, and end them."""
    from loky import ProcessPoolExecutor

    cache_folder("compiled")  # if it is a temporary one it is theirs too, and is told of once
    reader, lifeline = Pipe(duplex=False)
    with _environment():
        executor = ProcessPoolExecutor(count, initializer=_begin, initargs=(reader,))
        processes = Processes(executor, lifeline)
        resource_tracker.ensure_running()  # it would unblock interrupts when it is started with the first worker
        try:
            with _no_interrupts():
                executor.submit(_here)
            yield processes
        finally:
            executor.shutdown(wait=True, kill_workers=not processes.used)
            processes.cut()
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


def _begin(lifeline: Connection) -> None:
    """Make a worker of this process."""
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
    os._exit(STOPPED)  # whatever it does: what it kept is whole


def _here() -> None:
    """Do nothing; the first call of an executor starts its processes."""
