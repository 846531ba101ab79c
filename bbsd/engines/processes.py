"""Processes that wait for work. They may start before this one imports what the work needs, since that takes long.

Each works as long as a pipe to its parent is open. When the parent wants to stop, or has ended, a worker stops before
the next episode, or shortly after at any place. Each has an executor of its own, so that one that is lost takes no
other one with it; the next call starts another process in its place.
"""

from __future__ import annotations

import atexit
import gc
import os
import signal
import threading
import time
from concurrent.futures import BrokenExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from importlib import import_module
from multiprocessing import Pipe, resource_tracker
from typing import TYPE_CHECKING, Any, TypeVar

from bbsd.kernel.cache import cache_folder
from bbsd.stopping import stop_request_of_process

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from concurrent.futures import Future
    from multiprocessing.connection import Connection

    from bbsd.stopping import StopRequest

T = TypeVar("T")

GRACE = 0.8
"""Seconds that a worker has to stop by itself; fewer than its parent has."""
STOPPED = 130
ENVIRONMENT = {"PYTHONSAFEPATH": "1", "PYTHONWARNINGS": "ignore:resource_tracker:UserWarning"}
"""Workers import nothing from the current folder, and loky's tracker cleans up silently after a killed parent."""


_setting = threading.RLock()


class Processes:
    """Processes that wait for work; what a module of theirs keeps is still there at the next call."""

    def __init__(self, count: int, imports: Sequence[str]) -> None:
        self.used = False
        self._imports = tuple(imports)
        self._reader, self._lifeline = Pipe(duplex=False)
        self._stopping = threading.RLock()  # a signal handler may run in the middle of it
        self._choosing = threading.Lock()
        self._places = [_Place(self._new_executor()) for _ in range(count)]

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self._places)

    def submit(self, function: Callable[..., T], *arguments: object) -> Future[T]:
        """Call the function in one of them, in the one that has the least to do.

        The future raises BrokenExecutor where the process was lost; what is called later gets another one.
        """
        self.used = True
        with self._choosing:
            place = min(self._places, key=lambda place: place.waiting)
            future: Future[T]
            try:
                future = place.executor.submit(function, *arguments)
            except BrokenExecutor:
                place.executor.shutdown(wait=False)
                place.executor = self._new_executor()
                with workers_environment(), no_interrupts():
                    future = place.executor.submit(function, *arguments)
            place.waiting += 1
        future.add_done_callback(lambda _future: self._count_down(place))
        return future

    def start(self) -> None:
        """Start them all, without waiting until they are there."""
        with workers_environment(), no_interrupts():
            for place in self._places:
                place.executor.submit(_do_nothing)

    def dismiss(self) -> None:
        """Let them end once they have done what was submitted."""
        for place in self._places:
            place.executor.shutdown(wait=False)

    def stop(self) -> None:
        """Make them stop; from any thread."""
        with self._stopping:
            self._lifeline.close()

    def end(self) -> None:
        """Wait for what was submitted, and end them all."""
        for place in self._places:
            place.executor.shutdown(wait=True, kill_workers=not self.used)
        self.stop()
        self._reader.close()

    def _new_executor(self) -> Any:  # noqa: ANN401 - loky has no types
        from loky import ProcessPoolExecutor

        with workers_environment():  # loky's tracker is started with the first executor
            return ProcessPoolExecutor(1, initializer=_prepare_worker, initargs=(self._reader, self._imports))

    def _count_down(self, place: _Place) -> None:
        with self._choosing:
            place.waiting -= 1


@dataclass(slots=True)
class _Place:
    """One process, or the one that took its place, and how many calls it has still to do."""

    executor: Any
    waiting: int = 0


def started_processes(count: int, imports: Sequence[str] = ()) -> Processes:
    """Start so many processes, which import these modules first; somebody must end them."""
    cache_folder("compiled")  # a temporary one is then shared, and reported once
    resource_tracker.ensure_running()  # it would unblock interrupts when it is started with the first worker
    processes = Processes(count, imports)
    try:
        processes.start()
    except BaseException:
        processes.end()
        raise
    return processes


@contextmanager
def waiting_processes(count: int, imports: Sequence[str] = ()) -> Iterator[Processes]:
    """Start so many processes, which import these modules first, and end them at exit."""
    processes = started_processes(count, imports)
    try:
        yield processes
    finally:
        processes.end()


@contextmanager
def workers_environment() -> Iterator[None]:
    """Set the environment of processes that are started inside, and restore it at exit."""
    with _setting:
        before = {name: os.environ.get(name) for name in ENVIRONMENT}
        os.environ.update(ENVIRONMENT)
        try:
            yield
        finally:
            for name, value in before.items():
                os.environ.pop(name)
                os.environ.update({} if value is None else {name: value})


@contextmanager
def no_interrupts() -> Iterator[None]:
    """Hide Ctrl-C from processes that are started inside; this one gets it at exit."""
    if os.name != "posix":
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _prepare_worker(lifeline: Connection, imports: Sequence[str]) -> None:
    """Make this process a worker, which stops when the lifeline is cut."""
    atexit.register(gc.freeze)  # as in the parent
    threading.Thread(
        target=_stop_with_parent, args=(lifeline, stop_request_of_process()), daemon=True
    ).start()
    for module in imports:
        import_module(module)


def _stop_with_parent(lifeline: Connection, request: StopRequest) -> None:
    with suppress(EOFError, OSError):
        lifeline.recv_bytes()
    request.make()
    time.sleep(GRACE)
    os._exit(STOPPED)  # at any place: what was written is whole


def _do_nothing() -> None:
    """Do nothing; the first call of an executor starts its processes."""
