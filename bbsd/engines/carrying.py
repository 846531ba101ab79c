"""Carries out tasks with an engine: unit after unit of each, several tasks at a time."""

from __future__ import annotations

from collections import deque
from concurrent.futures import CancelledError
from contextlib import suppress
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, NamedTuple, Protocol

from bbsd.engines.engine import ATTEMPTS, WorkerLost

if TYPE_CHECKING:
    from collections.abc import Iterator
    from concurrent.futures import Future

    from bbsd.engines.engine import Engine
    from bbsd.engines.units import Result, Unit
    from bbsd.stopping import StopRequest

PATIENCE = 0.1
"""Seconds between two looks at whether there are more workers, or a stop was requested."""


class Task(Protocol):
    """Work of several units, one after another."""

    def unit(self) -> Unit:
        """Return what is to be done next."""

    def take(self, result: Result) -> bool:
        """Take over what came of the last unit, and return whether there is no other one; nothing is written yet."""

    def write(self) -> None:
        """Write what was taken."""


class Carried(NamedTuple):
    """What became of tasks that were not done."""

    given_up: list[Task]
    """Those that lost four workers in a row without getting any further."""
    failed: dict[Task, BaseException]
    """Those that raised an error, or whose result could not be written."""


def carry_out(engine: Engine, tasks: Iterator[Task], request: StopRequest) -> Carried:
    """Do tasks, as many at a time as the engine has workers for.

    A unit whose worker was lost is done again, until the task has lost four workers in a row without getting any
    further; the others go on. The first error of a task makes the request to stop. Once that is made, nothing new is
    begun, and what workers still give back is written.
    """
    return _Carrying(engine, tasks, request).run()


class _Carrying:
    """Tasks that are going on."""

    def __init__(self, engine: Engine, tasks: Iterator[Task], request: StopRequest) -> None:
        self._engine, self._tasks, self._request = engine, tasks, request
        self._done: SimpleQueue[tuple[Task, Future[Result]]] = SimpleQueue()
        self._going = 0
        self._again: deque[Task] = deque()
        self._lost: dict[Task, int] = {}
        self._carried = Carried([], {})

    def run(self) -> Carried:
        """Do all tasks."""
        waiting = True
        while True:
            room = self._engine.capacity()
            while waiting and not self._request.is_made and self._going < room:
                task = self._again.popleft() if self._again else next(self._tasks, None)
                waiting = task is not None
                if task is not None:
                    self._submit(task)
            if not self._going and (not waiting or self._request.is_made):
                return self._carried
            with suppress(Empty):
                self._receive(*self._done.get(timeout=PATIENCE))
            waiting = waiting or bool(self._again)

    def _submit(self, task: Task) -> None:
        self._going += 1
        self._engine.submit(task.unit()).add_done_callback(lambda future: self._done.put((task, future)))

    def _receive(self, task: Task, future: Future[Result]) -> None:
        self._going -= 1
        if task in self._carried.failed:
            return  # what was not written before leaves a gap that nothing may be written behind
        try:
            finished = task.take(future.result())
            self._lost.pop(task, None)
            if not finished and not self._request.is_made:
                self._submit(task)  # the worker goes on while what it did is written
            task.write()
        except WorkerLost:
            self._try_again(task)
        except (KeyboardInterrupt, CancelledError):
            self._request.make()
        except BaseException as error:  # noqa: BLE001 - raised by whoever wanted the tasks
            self._carried.failed[task] = error
            self._request.make()

    def _try_again(self, task: Task) -> None:
        if self._request.is_made:
            return
        self._lost[task] = self._lost.get(task, 0) + 1
        if self._lost[task] < ATTEMPTS:
            self._again.append(task)
        else:
            self._carried.given_up.append(task)
