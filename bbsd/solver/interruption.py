"""Ctrl-C as a wish that is granted at the next episode.

An exception in the middle of anything can be lost: one that is raised while LLVM's objects are disposed of is only
printed. So the first interrupt is noted and heeded between compiled calls; a second one is Python's own. A thread
watches for it too, since no handler runs before a compiled call is over.
"""

from __future__ import annotations

import signal
import socket
import threading
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

GRACE = 1.3
"""Seconds in which a design should have stopped by itself."""


class Wish:
    """That a design should stop."""

    def __init__(self) -> None:
        self._made = threading.Event()
        self._listeners: list[Callable[[], object]] = []
        self._telling = threading.RLock()  # a handler may come in the middle of it

    def make(self) -> None:
        """Make it, and tell all who want to know; from any thread."""
        with self._telling:
            if not self._made.is_set():
                self._made.set()
                for listener in self._listeners:
                    listener()

    def when_made(self, listener: Callable[[], object]) -> None:
        """Call this once it is made, at once if it was."""
        with self._telling:
            self._listeners.append(listener)
            if self._made.is_set():
                listener()

    @property
    def is_made(self) -> bool:
        """Whether it was made."""
        return self._made.is_set()


_wish: ContextVar[Wish | None] = ContextVar("wish", default=None)


def heed() -> None:
    """Raise KeyboardInterrupt if the design of this context should stop."""
    wish = _wish.get()
    if wish is not None and wish.is_made:
        raise KeyboardInterrupt


def present_wish() -> Wish:
    """The wish that is heeded in this context, which must be one in which interrupts are noted."""
    wish = _wish.get()
    if wish is None:
        raise RuntimeError("nobody notes interrupts here")
    return wish


def own_wish() -> Wish:
    """A wish of its own for a process that does nothing but one design's work."""
    wish = Wish()
    _wish.set(wish)
    return wish


@contextmanager
def interrupts_noted(overdue: Callable[[], object] | None = None) -> Iterator[None]:
    """Note interrupts for `heed` while in here; only the main thread can, others leave things as they are.

    So does a process that ignores them: a shell starts one so in the background, and Ctrl-C is meant for another.

    If one was not heeded within the grace period, `overdue` is called, in another thread.
    """
    wish = Wish()
    token = _wish.set(wish)
    try:
        is_main = threading.current_thread() is threading.main_thread()
        if is_main and signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
            with _handled(wish), _watched(wish, overdue):
                yield
        else:
            yield
    finally:
        _wish.reset(token)


@contextmanager
def _handled(wish: Wish) -> Iterator[None]:
    before = signal.getsignal(signal.SIGINT)

    def note(_number: int, _frame: object) -> None:
        wish.make()
        signal.signal(signal.SIGINT, before)

    signal.signal(signal.SIGINT, note)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def _watched(wish: Wish, overdue: Callable[[], object] | None) -> Iterator[None]:
    reader, writer = socket.socketpair()
    writer.setblocking(False)
    over = threading.Event()
    thread = threading.Thread(target=_watch, args=(reader, wish, over, overdue), daemon=True)
    thread.start()
    before = signal.set_wakeup_fd(writer.fileno(), warn_on_full_buffer=False)
    try:
        yield
    finally:
        signal.set_wakeup_fd(before)
        over.set()
        writer.close()
        thread.join()
        reader.close()


def _watch(
    reader: socket.socket, wish: Wish, over: threading.Event, overdue: Callable[[], object] | None
) -> None:
    """Make the wish as soon as the system has noted the signal, whatever the main thread is doing."""
    while numbers := reader.recv(64):
        if signal.SIGINT in numbers:
            wish.make()
            if not over.wait(GRACE) and overdue is not None:
                overdue()
