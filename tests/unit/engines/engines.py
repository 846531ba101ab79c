"""Work that kills workers, and an engine of threads of this process, whose workers can be lost on demand."""

import os
import signal
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

from bbsd.engines.engine import WorkerLost
from bbsd.engines.units import Result, Unit, do

WORK = f"{__name__}:add"


class ThreadsEngine:
    """Does units in threads, as bytes; `losing` says for each unit whether its worker is lost."""

    shares_machine = False

    def __init__(self, count=2, losing=lambda _unit: False):
        self.count, self.losing = count, losing
        self.units, self.stopped = [], False
        self._threads = ThreadPoolExecutor(max(1, count))

    def capacity(self):
        return self.count

    def submit(self, unit):
        self.units.append(unit)
        if self.losing(unit):
            lost = Future()
            lost.set_exception(WorkerLost())
            return lost
        return self._threads.submit(lambda: Result.from_bytes(do(unit.to_bytes())))

    def prepare(self, unit):
        pass

    def dismiss(self):
        pass

    def stop(self):
        self.stopped = True


def add(unit):
    """Add a letter; but end the process where no deaths are named, or for each that left no mark yet."""
    deaths = unit.order["deaths"]
    if deaths is None:
        os.kill(os.getpid(), signal.SIGKILL)
    for mark in map(Path, deaths["marks"]):
        if not mark.exists():
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
    return Result({"x": unit.files.get("x", b"") + unit.order["letter"].encode()})


class Adding:
    """A task of three such units."""

    def __init__(self, letter, deaths):
        self.order, self.files = {"letter": letter, "deaths": deaths}, {}

    def unit(self):
        return Unit("adding", WORK, self.order, self.files)

    def take(self, result):
        self.files = result.files
        return len(result.files["x"]) == 3

    def write(self):
        pass
