"""Cells as units of an engine: each is done by one worker, and its result comes back as a line of JSON."""

from __future__ import annotations

import json
import threading
from dataclasses import asdict
from queue import SimpleQueue
from typing import TYPE_CHECKING

from bbsd.engines import units
from bbsd.engines.carrying import carry_out
from bbsd.errors import UsageError
from bbsd.stopping import stop_request_of_context
from experiments.methods.cells import Cell, Result, result_of
from experiments.methods.trial import run

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.engines.carrying import Carried
    from bbsd.engines.engine import Engine

WORK, RESULT = f"{__name__}:do", "result"


class CellsLost(UsageError):
    """Cells whose workers were killed again and again."""

    advice = "the same command runs what has no result yet"


class CellTask:
    """A cell that a worker does."""

    def __init__(self, cell: Cell, results: SimpleQueue[Result | None]) -> None:
        self.cell, self._results = cell, results
        self._content = b""

    def unit(self) -> units.Unit:
        """Return the cell as a unit."""
        return units.Unit(" ".join(map(str, self.cell)), WORK, self.cell._asdict())

    def take(self, result: units.Result) -> bool:
        """Take over the result."""
        self._content = result.files[RESULT]
        return True

    def write(self) -> None:
        """Give the result to whoever waits for results."""
        self._results.put(result_of(json.loads(self._content)))


def do(unit: units.Unit) -> units.Result:
    """Run the cell of a unit."""
    return units.Result({RESULT: json.dumps(asdict(run(Cell(**unit.order)))).encode()})


def carried_out(cells: Sequence[Cell], engine: Engine) -> Iterator[Result]:
    """Run cells with an engine and yield their results, each as soon as it is there.

    Raises CellsLost, or what a cell raised, after all others.
    """
    results: SimpleQueue[Result | None] = SimpleQueue()
    tasks = [CellTask(cell, results) for cell in cells]
    carried: list[Carried | BaseException] = []
    with stop_request_of_context() as request:
        request.when_made(engine.stop)

        def carry() -> None:
            try:
                carried.append(carry_out(engine, iter(tasks), request))
            except BaseException as error:  # noqa: BLE001 - raised below
                carried.append(error)
            results.put(None)

        thread = threading.Thread(target=carry, daemon=True)
        thread.start()
        try:
            while (result := results.get()) is not None:
                yield result
        finally:
            request.make()
            thread.join()
    _raise(carried[0])


def _raise(carried: Carried | BaseException) -> None:
    if isinstance(carried, BaseException):
        raise carried
    for error in carried.failed.values():
        raise error
    if carried.given_up:
        names = ", ".join(task.unit().name for task in carried.given_up)
        raise CellsLost(f"workers were killed again and again while they did {names}")
