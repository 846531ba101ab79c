"""Ctrl-C as a wish that is granted at the next episode.

An exception in the middle of anything can be lost: one that is raised while LLVM's objects are disposed of is only
printed. So the first interrupt is noted and heeded between compiled calls; a second one is Python's own.
"""

from __future__ import annotations

import signal
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

_wished = threading.Event()


@contextmanager
def interrupts_noted() -> Iterator[None]:
    """Note interrupts for `heed` while in here; only the main thread can, others leave things as they are."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.getsignal(signal.SIGINT)

    def note(_number: int, _frame: object) -> None:
        _wished.set()
        signal.signal(signal.SIGINT, before)

    signal.signal(signal.SIGINT, note)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        _wished.clear()


def heed() -> None:
    """Raise KeyboardInterrupt if there was one."""
    if _wished.is_set():
        raise KeyboardInterrupt
