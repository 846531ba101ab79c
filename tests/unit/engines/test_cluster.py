"""The engine dask, on a cluster of three workers that all tests of this file share."""

import os
import re
import signal
import threading
import time
from concurrent.futures import CancelledError
from contextlib import suppress
from pathlib import Path

import pytest

from bbsd.api import design
from bbsd.engines import cluster
from bbsd.engines.carrying import carry_out
from bbsd.engines.cluster import DaskEngine, NoBbsd, NoDask, NoScheduler, NoWorkers, dask_engine
from bbsd.engines.engine import ATTEMPTS, WorkerLost
from bbsd.engines.units import OtherVersion, Result, Unit
from bbsd.runs.workers.remote import RemoteRun
from bbsd.runs.workers.side_by_side import RunsLost
from bbsd.stopping import StopRequest
from tests.unit.engines.engines import WORK, Adding

SPEC = Path(__file__).parents[2] / "end_to_end" / "specs" / "thermostat.yaml"
SMALL = ["design.coevolution.generations=12"]
WORKERS = 3

needs_proc = pytest.mark.skipif(not Path("/proc").is_dir(), reason="asks /proc who is there")


@pytest.fixture(scope="module")
def engine():
    with dask_engine(None, WORKERS) as engine:
        yield engine


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """The bytes of three runs, one after the other."""
    return designed(tmp_path_factory.mktemp("alone") / "run")


def designed(folder, **options):
    design(SPEC, runs=3, out=folder, set=SMALL, **options)
    return {
        path.relative_to(folder): path.read_bytes()
        for path in folder.rglob("*")
        if path.name in ("architecture.yaml", "metrics.jsonl", "visits.json")
    }


def workers():
    """The processes of the cluster."""
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
            if parent == os.getpid() and "spawn_main" in (folder / "cmdline").read_text():
                yield int(folder.name)


@pytest.mark.slow
@pytest.mark.parametrize("count", [1, 2, 3])
def test_any_number_of_workers_gives_the_same_bytes(engine, alone, tmp_path, monkeypatch, count):
    all_workers = engine.capacity
    monkeypatch.setattr(engine, "capacity", lambda: min(count, all_workers()))
    told = []
    assert designed(tmp_path / "run", engine=engine, progress=told.append) == alone
    assert sorted((line.run, line.generation) for line in told) == [
        (run, generation) for run in (1, 2, 3) for generation in range(1, 13)
    ]


@pytest.mark.slow
@needs_proc
def test_a_worker_that_is_killed_in_the_middle_twice_costs_nothing_but_time(
    engine, alone, tmp_path, monkeypatch
):
    monkeypatch.setattr("bbsd.runs.workers.remote.FIRST", 0.0)  # a portion for each generation
    killed = []

    def kill(line):
        if len(killed) < 2 and line.generation > 3 * (1 + len(killed)):
            worker = next(worker for worker in workers() if worker not in killed)
            os.kill(worker, signal.SIGKILL)
            killed.append(worker)

    assert designed(tmp_path / "run", engine=engine, progress=kill) == alone
    assert len(killed) == 2


@pytest.mark.slow
def test_a_run_that_kills_its_workers_is_told_and_can_be_resumed(engine, alone, tmp_path):
    unit = RemoteRun.unit

    def deadly(self):
        sent = unit(self)
        return Unit(sent.name, WORK, {"deaths": None}) if self.run == 1 else sent

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(RemoteRun, "unit", deadly)
        with pytest.raises(RunsLost, match=f"{ATTEMPTS} processes that did run 2 were killed"):
            designed(tmp_path / "run", engine=engine)
    lines = [len((tmp_path / f"run/run-{run}/metrics.jsonl").read_bytes().splitlines()) for run in (1, 2, 3)]
    assert lines == [12, 0, 12]
    assert designed(tmp_path / "run", resume=True) == alone


@pytest.mark.slow
def test_tasks_whose_workers_die_are_done_again_and_one_that_kills_all_is_given_up(engine, tmp_path):
    marks = {"marks": [str(tmp_path / "first"), str(tmp_path / "second")]}
    tasks = [Adding("a", marks), Adding("b", None), Adding("c", {"marks": []})]
    assert carry_out(engine, iter(tasks), StopRequest()) == ([tasks[1]], {})
    assert [task.files for task in tasks] == [{"x": b"aaa"}, {}, {"x": b"ccc"}]


def outcome(engine, unit):
    """What a unit comes to once there is a worker for it, while somebody looks for workers."""
    while engine.capacity() < 1:
        time.sleep(0.05)
    future = engine.submit(unit)
    while not future.done():
        engine.capacity()
        time.sleep(0.05)
    return future.exception() or future.result()


@pytest.mark.slow
def test_what_a_worker_raises_is_raised_here(engine):
    other = outcome(engine, Unit("old", WORK, {}, version="bbsd 0.0.1, revision 1"))
    assert isinstance(other, OtherVersion)
    assert re.fullmatch(r"a worker has bbsd .*, and this is bbsd 0\.0\.1, revision 1", str(other))
    assert isinstance(outcome(engine, Unit("wrong", WORK, {})), KeyError)
    missing = outcome(engine, Unit("wrong", "bbsd.no_such_module:work", {}))
    assert isinstance(missing, NoBbsd)
    assert str(missing).endswith("cannot import bbsd.no_such_module")
    assert isinstance(outcome(engine, Unit("deadly", WORK, {"deaths": None})), WorkerLost)
    assert outcome(engine, Unit("fine", WORK, {"letter": "x", "deaths": {"marks": []}})).files == {"x": b"x"}


def test_a_scheduler_that_is_not_there_is_told(monkeypatch):
    monkeypatch.setattr(cluster, "CONNECTING", 0.3)
    with (
        pytest.raises(NoScheduler, match="no scheduler answers at tcp://127") as raised,
        dask_engine("tcp://127.0.0.1:9", 1),
    ):
        pass
    assert "--resume" in raised.value.advice


def test_without_dask_it_is_said_how_to_get_it(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    with pytest.raises(NoDask, match="package distributed") as raised, dask_engine(None, 1):
        pass
    assert "pip install 'bbsd[dask]'" in raised.value.advice


class Waiting:
    """A client whose units never end, until they are cancelled."""

    def __init__(self):
        self.cancelled = threading.Event()
        self.callbacks, self.sent = [], []
        self.workers = {"one": 1, "two": 1}

    def nthreads(self):
        return self.workers

    def submit(self, *_arguments, workers, **_options):
        self.sent.append(*workers)
        return self

    def add_done_callback(self, callback):
        self.callbacks.append(callback)

    def result(self):
        raise CancelledError

    def cancel(self, futures):
        self.cancelled.set()
        for callback in self.callbacks:
            callback(self)


def test_when_it_is_stopped_units_are_taken_back_at_once_and_later_ones_can_be_sent():
    client = Waiting()
    engine = DaskEngine(client, "here")
    future = engine.submit(Unit("long", WORK, {}))
    engine.stop()
    engine.stop()
    with pytest.raises(CancelledError):
        future.result(0)
    assert client.cancelled.wait(5)
    assert not engine.submit(Unit("late", WORK, {})).done()


def test_a_unit_that_is_cancelled_by_nobody_has_lost_its_scheduler():
    client = Waiting()
    future = DaskEngine(client, "here").submit(Unit("long", WORK, {}))
    client.cancel([])
    with pytest.raises(NoScheduler, match="the scheduler at here does not answer any more"):
        future.result(5)


def test_a_cluster_without_workers_is_waited_for_if_others_may_start_some():
    client = Waiting()
    client.workers = {}
    assert DaskEngine(client, "here").capacity() == 0
    with pytest.raises(NoWorkers, match="all workers of the cluster on this machine have ended"):
        DaskEngine(client, "here", patience=-1.0).capacity()


def test_a_scheduler_that_was_lost_is_told_when_workers_are_counted():
    client = Waiting()

    def lost():
        raise OSError("gone")

    client.nthreads = lost
    with pytest.raises(NoScheduler, match="does not answer any more"):
        DaskEngine(client, "here").capacity()


def test_a_unit_goes_to_a_worker_that_is_free_if_possible_to_that_which_began_it():
    client = Waiting()
    client.result = lambda: Result({}).to_bytes()
    engine = DaskEngine(client, "here")
    assert engine.capacity() == 2
    for names in ("ab", "ba"):
        futures = [engine.submit(Unit(name, WORK, {})) for name in names]
        client.cancel([])
        assert [future.result(5) for future in futures] == [Result({})] * 2
    assert client.sent == ["one", "two", "two", "one"]


def test_the_unit_of_a_worker_that_is_gone_is_lost(monkeypatch):
    monkeypatch.setattr(cluster, "LOOK", 0.0)
    client = Waiting()
    engine = DaskEngine(client, "here")
    engine.capacity()
    one, two = (engine.submit(Unit(name, WORK, {})) for name in "ab")
    third = engine.submit(Unit("c", WORK, {}))
    client.cancel = lambda _futures: None
    client.workers = {"two": 1}
    assert engine.capacity() == 1
    for future in (one, third):
        with pytest.raises(WorkerLost):
            future.result(5)
    assert not two.done()


def test_a_result_that_was_changed_on_the_way_is_not_taken():
    client = Waiting()
    client.result = lambda: Result({"a": b"b"}).to_bytes()[:-1] + b"c"
    future = DaskEngine(client, "here").submit(Unit("long", WORK, {}))
    client.cancel([])
    assert "digest" in str(future.exception(5))
