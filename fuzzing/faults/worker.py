"""A worker that is forked, not started anew, since there are thousands of trials.

Where processes are killed from outside, or race, workers are the real ones.
"""

from __future__ import annotations

import os
import signal
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from multiprocessing import Pipe
from typing import TYPE_CHECKING

from bbsd.engines.engine import WorkerLost
from bbsd.engines.units import Result, do
from fuzzing.faults.commands import put_in_place

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from concurrent.futures import Future
    from multiprocessing.connection import Connection

    from bbsd.engines.units import Unit


class ForkedWorker:
    """An engine of one process, which is a copy of this one and ends with it."""

    shares_machine = True

    def __init__(self) -> None:
        """Fork the process; no thread may be running."""
        self._pipe, theirs = Pipe()
        self._pid = os.fork()
        if self._pid == 0:
            self._pipe.close()
            _serve(theirs)
        theirs.close()
        self._asking = ThreadPoolExecutor(1)

    def install(self) -> None:
        """Take the place of the processes that this one would start to do runs."""
        from bbsd.engines import local

        put_in_place(local, "processes_engine", self._engine)

    @contextmanager
    def _engine(self, count: int, _imports: Sequence[str]) -> Iterator[ForkedWorker]:
        if count != 1:
            raise ValueError(f"{count} workers, where there is one")
        try:
            yield self
        finally:
            self._asking.shutdown()
            self._pipe.close()
            os.waitpid(self._pid, 0)

    def capacity(self) -> int:
        """Return that it does one unit at a time."""
        return 1

    def submit(self, unit: Unit) -> Future[Result]:
        """Let it do a unit."""
        return self._asking.submit(self._result, unit.to_bytes())

    def prepare(self, unit: Unit) -> None:
        """Let it get ready for units such as this one."""
        self._asking.submit(self._result, unit.to_bytes())

    def dismiss(self) -> None:
        """Do nothing: it ends with the run."""

    def stop(self) -> None:
        """End it at once."""
        with suppress(ProcessLookupError):
            os.kill(self._pid, signal.SIGKILL)

    def _result(self, unit: bytes) -> Result:
        try:
            self._pipe.send_bytes(unit)
            done = self._pipe.recv()
        except (EOFError, OSError):
            raise WorkerLost from None
        if isinstance(done, BaseException):
            raise done
        return Result.from_bytes(done)


def _serve(pipe: Connection) -> None:
    """Do units in this process until its parent is gone."""
    try:
        while True:
            unit = pipe.recv_bytes()
            try:
                pipe.send(do(unit))
            except Exception as error:  # noqa: BLE001 - raised where the result is wanted
                pipe.send(error)
    except (EOFError, OSError):
        pass
    finally:
        os._exit(0)
