"""A request to stop, which long loops check between compiled calls.

It stands below evaluation and the method, so that both can heed it; `runs.signals` makes one of Ctrl-C.
"""

from __future__ import annotations

import threading
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


class StopRequest:
    """A request that the work of a context should stop; once made it cannot be withdrawn."""

    def __init__(self) -> None:
        self._made = threading.Event()
        self._listeners: list[Callable[[], object]] = []
        self._notifying = threading.RLock()  # reentrant: a signal handler may run in the middle of `make`

    def make(self) -> None:
        """Make the request and call all listeners; from any thread."""
        with self._notifying:
            if not self._made.is_set():
                self._made.set()
                for listener in self._listeners:
                    listener()

    def when_made(self, listener: Callable[[], object]) -> None:
        """Call the listener when the request is made, at once if it already was."""
        with self._notifying:
            self._listeners.append(listener)
            if self._made.is_set():
                listener()

    @property
    def is_made(self) -> bool:
        """Whether the request was made."""
        return self._made.is_set()


_current: ContextVar[StopRequest | None] = ContextVar("stop_request", default=None)


def raise_if_stopped() -> None:
    """Raise KeyboardInterrupt if the work of this context was requested to stop."""
    request = _current.get()
    if request is not None and request.is_made:
        raise KeyboardInterrupt


def current_stop_request() -> StopRequest:
    """Return the stop request of this context; raises RuntimeError where there is none."""
    request = _current.get()
    if request is None:
        raise RuntimeError("this context has no stop request")
    return request


def stop_request_of_process() -> StopRequest:
    """Set and return a new request for a process that does nothing but the work of one design."""
    request = StopRequest()
    _current.set(request)
    return request


@contextmanager
def stop_request_of_context() -> Iterator[StopRequest]:
    """Give the current context a request of its own inside a `with` block."""
    request = StopRequest()
    token = _current.set(request)
    try:
        yield request
    finally:
        _current.reset(token)
