"""What the process that keeps the records spends on each unit, with a thousand workers: `python -m experiments.scale`.

The workers are simulated: each unit comes back after the seconds that a worker would have worked, with what a real
portion of a real run gave, recorded before. Everything else is what a cluster would meet: units and results are packed
to bytes and read again, runs are begun, metrics are written and reported, states are saved.
"""

from __future__ import annotations

import argparse
import resource
import shutil
import sys
import tempfile
import threading
import time
from concurrent.futures import Future
from dataclasses import replace
from heapq import heappop, heappush
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import bbsd
from bbsd.compiler import compile_meaning
from bbsd.engines.units import Result, Unit
from bbsd.runs.command import Command
from bbsd.runs.origin import origin_of
from bbsd.runs.storage import checkpoint
from bbsd.runs.storage.folder import Folder
from bbsd.runs.storage.identity import identity
from bbsd.runs.storage.state import RUN
from bbsd.runs.workers.portions import STATE, advance
from bbsd.runs.workers.remote import RemoteRun
from bbsd.runs.workers.side_by_side import side_by_side
from bbsd.solver.paper.settings import settings_of
from bbsd.stopping import stop_request_of_context
from experiments.designs import SPECS

if TYPE_CHECKING:
    from collections.abc import Sequence


def recorded_run(command: Command, seconds: float) -> list[Result]:
    """Return what the portions of a run give, one after another, each of so many seconds."""
    run, results, finished = RemoteRun(command, 0, lambda _line: None, lambda: 1), list[Result](), False
    while not finished:
        results.append(advance(replace(run.unit(), seconds=seconds)))
        finished = run.take(results[-1])
    return results


def last_of(command: Command, run: int, last: Result) -> bytes:
    """Return the last result of another run, which has its number in its state."""
    arrays = checkpoint.unpacked(last.files[STATE], command.who, "recorded")
    state = checkpoint.packed(command.who, {**arrays, RUN: np.array(run)})
    return Result({**last.files, STATE: state}).to_bytes()


class Simulated:
    """Workers that give back what was recorded, a while after they were asked."""

    shares_machine = False

    def __init__(
        self, n_workers: int, recorded: Sequence[Result], lasts: Sequence[bytes], seconds: float
    ) -> None:
        self.units, self.bytes = 0, 0
        self._n_workers, self._lasts, self._seconds = n_workers, lasts, seconds
        self._recorded = [result.to_bytes() for result in recorded[:-1]]
        self._next: dict[str, int] = {}
        self._due: list[tuple[float, int, Future[Result], bytes]] = []
        self._numbers = count()
        self._changed = threading.Condition()
        threading.Thread(target=self._give_back, daemon=True).start()

    def capacity(self) -> int:
        """Return the number of workers."""
        return self._n_workers

    def submit(self, unit: Unit) -> Future[Result]:
        """Take a unit as bytes, and give it back when its time has come."""
        content, portion = unit.to_bytes(), self._next.get(unit.name, 0)
        self._next[unit.name] = portion + 1
        result: Future[Result] = Future()
        is_last = portion == len(self._recorded)
        answer = self._lasts[unit.order["run"]] if is_last else self._recorded[portion]
        self.units, self.bytes = self.units + 1, self.bytes + len(content) + len(answer)
        with self._changed:
            due = time.monotonic() + self._seconds
            heappush(self._due, (due, next(self._numbers), result, answer))
            self._changed.notify()
        return result

    def prepare(self, unit: Unit) -> None:
        """Do nothing."""

    def dismiss(self) -> None:
        """Do nothing."""

    def stop(self) -> None:
        """Do nothing."""

    def _give_back(self) -> None:
        while True:
            with self._changed:
                while not self._due or self._due[0][0] > time.monotonic():
                    self._changed.wait(max(0.0, self._due[0][0] - time.monotonic()) if self._due else None)
                _, _, result, answer = heappop(self._due)
            result.set_result(Result.from_bytes(answer))


def command_of(folder: Path, runs: int, budget: int) -> Command:
    """Return the command of so many runs of object lifting."""
    loaded = bbsd.load(SPECS / "object_lifting.yaml", seed=1)
    problem, settings = compile_meaning(loaded.meaning), settings_of(loaded.meaning)
    who = identity(loaded, 1, runs)
    return Command(problem, settings, 1, runs, Folder(folder), who, (budget,), origin=origin_of(loaded))


def main(texts: Sequence[str] | None = None) -> int:
    """Record a run, simulate many, and print what they cost."""
    parser = argparse.ArgumentParser(prog="python -m experiments.scale", description=__doc__)
    parser.add_argument("--workers", type=int, default=1000, metavar="N")
    parser.add_argument("--runs", type=int, metavar="N", help="by default as many as workers")
    parser.add_argument("--budget", type=int, default=60_000, metavar="EPISODES")
    parser.add_argument(
        "--seconds", type=float, default=10.0, metavar="S", help="that a simulated worker works on a portion"
    )
    parser.add_argument(
        "--recorded", type=float, default=0.3, metavar="S", help="of the real portions that are recorded"
    )
    options = parser.parse_args(texts)
    runs = options.runs or options.workers
    with tempfile.TemporaryDirectory() as name, stop_request_of_context():
        command = command_of(Path(name), runs, options.budget)
        recorded = recorded_run(command, options.recorded)
        shutil.rmtree(command.records(0).path)
        lasts = [last_of(command, run, recorded[-1]) for run in range(runs)]
        workers = Simulated(options.workers, recorded, lasts, options.seconds)
        began, before = time.perf_counter(), time.process_time()
        lines: list[object] = []
        side_by_side(command, [*range(runs)], 1, lines.append, workers)
        wall, processor = time.perf_counter() - began, time.process_time() - before
    least = -(-runs // options.workers) * len(recorded) * options.seconds
    print(f"workers {options.workers:,}, runs {runs:,}, portions {workers.units:,}, lines {len(lines):,}")
    print(f"bytes of a unit and its result  {workers.bytes / workers.units:10,.0f}")
    print(f"processor for each unit, ms     {1000 * processor / workers.units:10.2f}")
    print(f"seconds, and if nothing were kept {wall:8.1f} {least:8.1f}")
    print(f"share of the workers' time used {least / wall:10.3f}")
    print(
        f"memory, MB                      {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:10.0f}"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
