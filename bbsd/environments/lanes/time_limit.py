"""A limit to how long one call of an environment may take, at no cost for each call.

A timer looks from time to time whether the same call still runs. In the main thread it is a signal, which also ends
a call that waits or sleeps; in other threads, and where there are no such signals, an exception is raised in the thread
as soon as it runs Python code again. Compiled code that does not return to Python ends by neither.
"""

from __future__ import annotations

import ctypes
import signal
import threading
import time
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from types import TracebackType

LOOKS = 4
"""Looks in the time of the limit; a call that hangs ends after at most one look more."""
DEFAULT_LIMIT = 30.0
"""Seconds that a step or a reset may take."""


class CallTooLongError(BaseException):
    """A call that took longer than its limit; no `except Exception` of an environment swallows it."""


class CallWatch:
    """Raises CallTooLongError in the middle of a call that takes longer than some seconds.

    Calls are made inside `with watch:`, and each is begun by counting it in `calls`.
    """

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds
        self.calls = 0
        self._seen, self._unchanged = -1, 0
        self._watched: int | None = None
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._handler: Any = None
        self._by_signal = False

    def __enter__(self) -> None:
        self._seen, self._unchanged = -1, 0
        self._by_signal = hasattr(signal, "setitimer") and (
            threading.current_thread() is threading.main_thread()
        )
        if self._by_signal:
            self._handler = signal.signal(signal.SIGALRM, self._tick)
            signal.setitimer(signal.ITIMER_REAL, self.seconds / LOOKS, self.seconds / LOOKS)
        else:
            self._watched = threading.get_ident()
            self._watch_by_thread()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._by_signal:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, self._handler)
        else:
            with self._lock:
                self._watched = None

    def _looks_stuck(self) -> bool:
        """Look once, and say whether the same call was running for the whole limit."""
        self._unchanged = self._unchanged + 1 if self.calls == self._seen else 0
        self._seen = self.calls
        return self._unchanged >= LOOKS

    def _tick(self, _number: int, _frame: object) -> None:
        if self._looks_stuck():
            self._unchanged = 0
            raise CallTooLongError

    def _watch_by_thread(self) -> None:
        if self._thread is None or not self._thread.is_alive():
            self._thread = threading.Thread(target=self._look_by_thread, daemon=True)
            self._thread.start()

    def _look_by_thread(self) -> None:
        """Look as long as there are calls, and a while longer."""
        idle = 0
        while idle < LOOKS:
            time.sleep(self.seconds / LOOKS)
            with self._lock:
                idle = idle + 1 if self._watched is None else 0
                if self._watched is not None and self._looks_stuck():
                    self._unchanged = 0
                    _raise_in(self._watched)


def _raise_in(thread: int) -> None:
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(CallTooLongError))
