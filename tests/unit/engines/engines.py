"""An engine of threads of this process, whose workers can be lost on demand."""

from concurrent.futures import Future, ThreadPoolExecutor

from bbsd.engines.engine import WorkerLost
from bbsd.engines.units import Result, do


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
