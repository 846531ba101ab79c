"""The engine `dask`: workers of a Dask cluster, on any number of machines."""

from __future__ import annotations

import logging
import math
import os
import signal
import threading
import time
from asyncio import CancelledError as AsyncCancelled
from concurrent.futures import CancelledError, Future
from contextlib import ExitStack, contextmanager, suppress
from multiprocessing import resource_tracker
from typing import TYPE_CHECKING, Any, NamedTuple

from bbsd.engines.engine import WorkerLost
from bbsd.engines.processes import no_interrupts, workers_environment
from bbsd.engines.units import Result, do
from bbsd.errors import UsageError, escape

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from bbsd.engines.units import Unit

LOOK = 0.5
"""Seconds between two questions to the scheduler for its workers."""
CONNECTING, CLOSING, RETURNING = 10.0, 5.0, 30.0
"""Seconds in which a scheduler has to answer, a cluster of this machine to end, and to start a worker again."""
LARGE = "100 GiB"
"""The size of a unit from which on Dask would warn of it: a state is as large as it is."""
GONE = "tcp://127.0.0.1:0"
"""The address of no worker; what is sent there is told to be lost at the next look."""
KILL = getattr(signal, "SIGKILL", signal.SIGTERM)
SETTINGS = {
    "distributed.admin.large-graph-warning-threshold": LARGE,
    "distributed.comm.timeouts.connect": f"{CONNECTING}s",
}


class NoDask(UsageError):
    """Dask is wanted and not installed."""

    advice = "install it: pip install 'bbsd[dask]'; or leave out --engine dask"

    def __init__(self) -> None:
        super().__init__("the engine dask needs the package distributed, which is not installed")


class NoScheduler(UsageError):
    """A scheduler that does not answer, or answers no more."""

    advice = "see whether it runs and can be reached from here; what was done can be continued with --resume"


class NoWorkers(UsageError):
    """A cluster of this machine whose workers have all ended, and which starts no others."""

    advice = "continue with --resume; fewer --jobs need less memory"

    def __init__(self) -> None:
        super().__init__("all workers of the cluster on this machine have ended")


class NoBbsd(UsageError):
    """Workers that cannot import what a unit needs."""

    advice = "install the same bbsd, with the same extras, where the scheduler and the workers run"


class _Going(NamedTuple):
    """A unit that is going on: Dask's future, and the address of the worker."""

    future: Any
    worker: str


class DaskEngine:
    """Workers of a Dask cluster that do units, each of them one at a time.

    Each unit is sent to one worker that has nothing else to do. So of a worker that is lost it is known which unit it
    did; Dask's own trying again would also blame units that only waited there.
    """

    shares_machine = False

    def __init__(self, client: Any, address: str, patience: float = math.inf) -> None:  # noqa: ANN401 - heavy
        """Use a client of the cluster, and wait so many seconds for its first worker, or for new ones."""
        self._client, self._address, self._patience = client, address, patience
        self._workers: dict[str, int] = {}
        self._looked, self._seen = -LOOK, time.monotonic()
        self._going: dict[Future[Result], _Going] = {}
        self._last: dict[str, str] = {}
        self._lock = threading.RLock()  # a signal handler may run in the middle of it

    def capacity(self) -> int:
        """Return the number of workers, which come and go. Raises NoScheduler, NoWorkers."""
        now = time.monotonic()
        if now - self._looked >= LOOK:
            self._look()
            self._looked, self._seen = now, now if self._workers else self._seen
        if now - self._seen > self._patience:
            raise NoWorkers
        return len(self._workers)

    def _look(self) -> None:
        """Ask for the workers, and tell the units of those that are gone."""
        try:
            self._workers = self._client.nthreads()
        except (OSError, TimeoutError, RuntimeError) as error:
            raise self._lost() from error
        with self._lock:
            lost = {
                result: going for result, going in self._going.items() if going.worker not in self._workers
            }
        self._take_back(lost, WorkerLost())

    def submit(self, unit: Unit) -> Future[Result]:
        """Let a worker do a unit, the one that did the last of the same name if it is free."""
        result: Future[Result] = Future()
        with self._lock:
            worker = self._last[unit.name] = self._free_worker(unit.name)
            going = self._client.submit(
                do, unit.to_bytes(), pure=False, workers=[worker], allow_other_workers=False
            )
            self._going[result] = _Going(going, worker)
        going.add_done_callback(lambda done: self._pass_on(done, result))
        return result

    def _free_worker(self, name: str) -> str:
        """Return the address of a worker with nothing to do, or, where there is none any more, of one that is lost."""
        busy = {going.worker for going in self._going.values()}
        last = self._last.get(name, "")
        if last in self._workers and last not in busy:
            return last
        return next((worker for worker in self._workers if worker not in busy), GONE)

    def prepare(self, unit: Unit) -> None:
        """Do nothing: workers get ready with their first unit."""

    def dismiss(self) -> None:
        """Do nothing: others may need the workers."""

    def stop(self) -> None:
        """Take back what was submitted; what a worker has begun it ends soon, since a unit takes a few seconds."""
        with self._lock:
            going = dict(self._going)
        self._take_back(going, CancelledError())

    def _take_back(self, units: Mapping[Future[Result], _Going], why: BaseException) -> None:
        """Let units have ended, and cancel them without waiting for the scheduler."""
        for result in units:
            self._settle(result, why)
        if units:
            futures = [going.future for going in units.values()]
            threading.Thread(target=self._client.cancel, args=(futures,), daemon=True).start()

    def _pass_on(self, done: Any, result: Future[Result]) -> None:  # noqa: ANN401 - heavy
        try:
            outcome: Result | BaseException = Result.from_bytes(done.result())
        except BaseException as error:  # noqa: BLE001 - raised where the result is wanted
            outcome = self._meant(error)
        self._settle(result, outcome)

    def _settle(self, result: Future[Result], outcome: Result | BaseException) -> None:
        """Give a unit its outcome, once."""
        with self._lock:
            if self._going.pop(result, None) is None:
                return
        if isinstance(outcome, BaseException):
            result.set_exception(outcome)
        else:
            result.set_result(outcome)

    def _meant(self, error: BaseException) -> BaseException:
        """Return what an error of Dask means for bbsd."""
        from distributed import KilledWorker

        if isinstance(error, KilledWorker):
            self._looked = -LOOK
            return WorkerLost()
        if isinstance(error, CancelledError | AsyncCancelled):
            return self._lost()
        missing = _missing(error)
        return error if missing is None else NoBbsd(f"a worker of {self._address} cannot import {missing}")

    def _lost(self) -> NoScheduler:
        return NoScheduler(f"the scheduler at {self._address} does not answer any more")


def _missing(error: BaseException) -> str | None:
    """Return the module that a worker, or the scheduler, could not import, and None where that is not what is wrong."""
    cause: BaseException | None = error
    while cause is not None:
        if isinstance(cause, ModuleNotFoundError | AttributeError) and "bbsd" in str(cause):
            return escape(getattr(cause, "name", None) or str(cause))
        cause = cause.__cause__
    if isinstance(error, RuntimeError) and "deserializ" in str(error):
        return "what was sent"
    return None


@contextmanager
def dask_engine(scheduler: str | None, count: int) -> Iterator[DaskEngine]:
    """Connect with a scheduler, or start so many workers on this machine where none is named; let go of it at exit.

    Raises NoDask, NoScheduler.
    """
    try:
        import dask
        from distributed import Client
    except ImportError:
        raise NoDask from None
    connect: Any = Client  # distributed has no types
    with ExitStack() as stack:
        stack.enter_context(dask.config.set(SETTINGS))
        address = scheduler or stack.enter_context(_local_cluster(count)).scheduler_address
        try:
            client = stack.enter_context(
                connect(address, timeout=CONNECTING, set_as_default=False, name="bbsd")
            )
        except (OSError, TimeoutError, ValueError) as error:
            raise NoScheduler(f"no scheduler answers at {escape(address)}: {escape(str(error))}") from None
        engine = DaskEngine(client, escape(address), math.inf if scheduler else RETURNING)
        try:
            yield engine
        finally:
            engine.stop()


@contextmanager
def _local_cluster(count: int) -> Iterator[Any]:
    """Start so many workers with one thread each, which only this machine can reach."""
    from distributed import LocalCluster, Status

    start: Any = LocalCluster  # distributed has no types
    logging.getLogger("distributed.batched").setLevel(logging.CRITICAL)  # it speaks after the end
    resource_tracker.ensure_running()  # it would unblock interrupts when it is started with the first worker
    with workers_environment(), no_interrupts():
        cluster = start(
            n_workers=count,
            threads_per_worker=1,
            host="127.0.0.1",
            dashboard_address=None,
            memory_limit=None,
            silence_logs=logging.CRITICAL,
        )
    try:
        yield cluster
    finally:
        for nanny in cluster.workers.values():
            if nanny.status is Status.running and nanny.pid is not None:
                nanny.close_gracefully()  # or it would start another one
                os.kill(nanny.pid, KILL)  # closing would wait for a unit that nobody wants any more
        with suppress(TimeoutError):
            cluster.close(timeout=CLOSING)
