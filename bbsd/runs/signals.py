"""Ctrl-C as a request to stop, which takes effect before the next episode.

An exception in the middle of anything can be lost: one raised while LLVM's objects are being deleted is only printed.
So the first interrupt is recorded and takes effect between compiled calls; a second one is Python's own. A thread
watches for it too, since no handler runs before a compiled call returns.
"""

from __future__ import annotations

import signal
import socket
import threading
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING

from bbsd.stopping import stop_request_of_context

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from bbsd.stopping import StopRequest

GRACE = 1.3
"""Seconds that a design has to stop by itself."""


@contextmanager
def interrupts_request_stop(overdue: Callable[[], object] | None = None) -> Iterator[None]:
    """Turn interrupts inside into a stop request.

    Only the main thread can do so; in other threads signals stay as they are. They also stay in a process that ignores
    interrupts: a shell starts background jobs that way, and Ctrl-C is meant for another process. If the work has not
    stopped within the grace period, or at a second interrupt, `overdue` is called in another thread.
    """
    with stop_request_of_context() as request:
        is_main = threading.current_thread() is threading.main_thread()
        if is_main and signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
            with _handle_interrupts(request), _watch_in_thread(request, overdue):
                yield
        else:
            yield


@contextmanager
def _handle_interrupts(request: StopRequest) -> Iterator[None]:
    before = signal.getsignal(signal.SIGINT)

    def handle(_number: int, _frame: object) -> None:
        request.make()
        signal.signal(signal.SIGINT, before)

    signal.signal(signal.SIGINT, handle)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def _watch_in_thread(request: StopRequest, overdue: Callable[[], object] | None) -> Iterator[None]:
    reader, writer = socket.socketpair()
    writer.setblocking(False)
    thread = threading.Thread(target=_watch, args=(reader, request, overdue), daemon=True)
    thread.start()
    before = signal.set_wakeup_fd(writer.fileno(), warn_on_full_buffer=False)
    try:
        yield
    finally:
        signal.set_wakeup_fd(before)
        writer.close()
        thread.join()
        reader.close()


def _watch(reader: socket.socket, request: StopRequest, overdue: Callable[[], object] | None) -> None:
    """Make the request as soon as the system has recorded the signal, whatever the main thread is doing."""
    interrupts = 0
    while numbers := reader.recv(64):
        interrupts += numbers.count(signal.SIGINT)
        if interrupts:
            request.make()
            break
    if interrupts and overdue is not None and _again_or_late(reader, interrupts):
        overdue()


def _again_or_late(reader: socket.socket, interrupts: int) -> bool:
    """Wait for a second interrupt, or for the grace period; return whether the work has not ended by then."""
    end = time.monotonic() + GRACE
    while interrupts < 2:
        reader.settimeout(max(end - time.monotonic(), 0.001))
        try:
            numbers = reader.recv(64)
        except TimeoutError:
            return True
        if not numbers:
            return False
        interrupts += numbers.count(signal.SIGINT)
    return True
