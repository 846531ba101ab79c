"""The engine `processes`: other processes of this machine."""

from __future__ import annotations

from concurrent.futures import BrokenExecutor, Future
from contextlib import contextmanager
from typing import TYPE_CHECKING

from bbsd.engines.engine import WorkerLost
from bbsd.engines.processes import waiting_processes
from bbsd.engines.units import Result, do

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.engines.processes import Processes
    from bbsd.engines.units import Unit


class ProcessesEngine:
    """Processes of this machine that do units."""

    shares_machine = True

    def __init__(self, processes: Processes) -> None:
        self._processes = processes

    def capacity(self) -> int:
        """Return the number of processes."""
        return self._processes.count

    def submit(self, unit: Unit) -> Future[Result]:
        """Let a process do a unit."""
        result: Future[Result] = Future()
        self._processes.submit(do, unit.to_bytes()).add_done_callback(lambda done: _pass_on(done, result))
        return result

    def prepare(self, unit: Unit) -> None:
        """Let all processes get ready for units such as this one, while this process does something else."""
        for _ in range(self._processes.count):
            self._processes.submit(do, unit.to_bytes())

    def dismiss(self) -> None:
        """Let the processes end: nothing more will be submitted."""
        self._processes.dismiss()

    def stop(self) -> None:
        """Make the processes stop."""
        self._processes.stop()


def _pass_on(done: Future[bytes], result: Future[Result]) -> None:
    try:
        result.set_result(Result.from_bytes(done.result()))
    except BrokenExecutor:
        result.set_exception(WorkerLost())
    except BaseException as error:  # noqa: BLE001 - raised where the result is wanted
        result.set_exception(error)


@contextmanager
def processes_engine(count: int, imports: Sequence[str]) -> Iterator[ProcessesEngine]:
    """Start so many processes, which import these modules first, and end them at exit."""
    with waiting_processes(count, imports) as processes:
        yield ProcessesEngine(processes)
