from collections import deque
from contextlib import nullcontext
from dataclasses import replace

import pytest

from bbsd.engines.processes import waiting_processes
from bbsd.errors import UsageError
from bbsd.runs import workers
from bbsd.runs.answers import complete_runs
from bbsd.runs.signals import interrupts_request_stop
from bbsd.runs.workers import WorkerLost, side_by_side
from bbsd.stopping import StopRequest
from tests.unit.runs.commands import WHO, command_of

RUNS = 3


@pytest.fixture
def command(tmp_path):
    def make(name):
        (tmp_path / name).mkdir()
        return command_of(tmp_path / name, RUNS, replace(WHO, runs=RUNS))

    return make


@pytest.fixture(autouse=True)
def noted():
    with interrupts_request_stop():
        yield


def plain(architectures):
    return [([*map(list, each.tables)], each.structure.tolist()) for each in architectures]


@pytest.mark.slow
def test_runs_side_by_side_have_the_answers_and_records_of_runs_one_after_the_other(command):
    alone, together, told = command("alone"), command("together"), []
    found = side_by_side(together, [*range(RUNS)], 2, told.append)
    assert plain(found[run] for run in range(RUNS)) == plain(complete_runs(alone, 1))
    for run in range(RUNS):
        assert together.records(run).lines() == alone.records(run).lines()
        assert [line for line in told if line["run"] == run + 1] == alone.records(run).lines()


@pytest.mark.slow
def test_workers_that_are_ready_are_taken_also_where_they_are_more_than_needed(command):
    alone, together = command("alone"), command("together")
    with waiting_processes(2) as ready:
        found = side_by_side(together, [1, 2], 2, None, ready)
        assert ready.used
    assert plain(found[run] for run in (1, 2)) == plain(complete_runs(alone, 1)[1:])


def test_an_error_of_a_listener_stops_all(command):
    def tell(_line):
        raise OSError("no more")

    with pytest.raises(OSError, match="no more"):
        side_by_side(command("stopped"), [*range(RUNS)], 2, tell)


@pytest.mark.parametrize(
    ("jobs", "expected"), [(2, (1, 1, 1)), (5, (2, 1, 3)), (7, (2, 2, 3)), (3, (2, 1, 1))]
)
def test_jobs_that_are_left_over_are_threads(monkeypatch, command, jobs, expected):
    seen = []

    class Enough(Exception):
        pass

    def at_work(count, of_workers):
        seen.extend([count, of_workers.problem.jobs])
        raise Enough

    monkeypatch.setattr(workers, "waiting_processes", lambda count, _imports: nullcontext(count))
    monkeypatch.setattr(workers, "_working", at_work)
    with pytest.raises(Enough):
        side_by_side(command("jobs"), [*range(RUNS)], jobs, None)
    n_workers, threads, own = expected
    assert seen == [n_workers, threads]
    assert own == jobs - n_workers * threads


def test_a_failure_leaves_no_run_to_take_and_is_wished_to_stop():
    def fail(run):
        raise OSError(f"run {run}")

    left, failed, request = deque([3, 4, 5]), {}, StopRequest()
    workers._take_runs(fail, left, {}, failed, request)
    assert [*failed] == [3]
    assert not left
    assert request.is_made


def test_of_several_failures_the_one_of_the_first_run_is_raised_and_what_was_only_stopped_comes_last():
    failures = {0: KeyboardInterrupt(), 2: OSError("second"), 1: ValueError("first")}
    with pytest.raises(ValueError, match="first"):
        workers._raise_first(failures)
    with pytest.raises(KeyboardInterrupt):
        workers._raise_first({0: KeyboardInterrupt()})
    workers._raise_first({})


def test_a_lost_worker_is_something_to_go_on_from(tmp_path):
    error = WorkerLost(tmp_path)
    assert isinstance(error, UsageError)
    assert str(tmp_path) in str(error)
    assert "--resume" in error.advice
