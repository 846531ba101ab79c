import itertools
from contextlib import nullcontext
from pathlib import Path

import pytest

from bbsd.engines.engine import ATTEMPTS
from bbsd.errors import UsageError
from bbsd.evaluation import RewardNotFinite
from bbsd.runs.signals import interrupts_request_stop
from bbsd.runs.workers import side_by_side as workers
from bbsd.runs.workers.answers import complete_runs
from bbsd.runs.workers.side_by_side import NEEDED, RunsLost, side_by_side
from bbsd.stopping import current_stop_request
from tests.unit.engines.engines import ThreadsEngine
from tests.unit.runs.commands import sent_command

RUNS = 3
BUDGETS = {"paper": (), "random": (5000,)}


@pytest.fixture
def command(tmp_path):
    def make(name, budgets=(), overrides=()):
        (tmp_path / name).mkdir(exist_ok=True)
        return sent_command(tmp_path / name, RUNS, budgets, overrides)

    return make


@pytest.fixture(autouse=True)
def noted():
    with interrupts_request_stop():
        yield


@pytest.fixture
def short_portions(monkeypatch):
    """Give every step back."""
    monkeypatch.setattr("bbsd.runs.workers.remote.PORTION", 0.0)
    monkeypatch.setattr("bbsd.runs.workers.remote.PORTIONS", 1e9)


def plain(architectures):
    return [([*map(list, each.tables)], each.structure.tolist()) for each in architectures]


def files(command):
    """All files of the runs, but for the archives of checkpoints, which hold the time."""
    return {
        path.relative_to(command.folder.path): path.read_bytes()
        for path in command.folder.path.rglob("*")
        if path.is_file() and path.suffix != ".npz"
    }


@pytest.mark.slow
def test_runs_side_by_side_have_the_answers_and_records_of_runs_one_after_the_other(command):
    alone, together, told = command("alone"), command("together"), []
    found = side_by_side(together, [*range(RUNS)], 2, told.append)
    assert plain(found[run] for run in range(RUNS)) == plain(complete_runs(alone, 1))
    assert files(together) == files(alone)
    for run in range(RUNS):
        assert [line for line in told if line["run"] == run + 1] == alone.records(run).lines()


@pytest.mark.parametrize("method", BUDGETS)
@pytest.mark.parametrize("count", [1, 2, 3])
def test_an_engine_elsewhere_gives_the_same_bytes_with_any_number_of_workers(
    command, count, method, short_portions
):
    record = ["design.record=2"]
    alone, away = (command(name, BUDGETS[method], record) for name in ("alone", "away"))
    expected, told = complete_runs(alone, 1), []
    engine = ThreadsEngine(count)
    assert plain(complete_runs(away, 1, told.append, engine)) == plain(expected)
    assert files(away) == files(alone)
    assert {path.suffix for path in files(away)} == {".jsonl", ".csv"}
    for run in range(RUNS):
        assert [line for line in told if line["run"] == run + 1] == alone.records(run).lines()
        assert plain([away.answer(run)]) == plain([expected[run]])
    assert len(engine.units) > RUNS + 2


def test_workers_that_are_lost_cost_nothing_but_what_they_did_since(command, short_portions):
    alone, away, lost = command("alone"), command("away"), itertools.count()
    engine = ThreadsEngine(2, lambda _unit: next(lost) % 3 == 1)
    assert plain(complete_runs(away, 1, engine=engine)) == plain(complete_runs(alone, 1))
    assert files(away) == files(alone)


def test_a_run_that_kills_its_workers_is_told_when_the_others_are_complete_and_resumed(
    command, short_portions
):
    alone, away = command("alone"), command("away")
    expected = complete_runs(alone, 1)
    generations = itertools.count()
    deadly = ThreadsEngine(2, lambda unit: unit.name == "run 2" and next(generations) > 1)
    with pytest.raises(RunsLost, match=f"{ATTEMPTS} processes that did run 2 were killed") as raised:
        complete_runs(away, 1, engine=deadly)
    assert raised.value.runs == (1,)
    assert [away.answer(run) is None for run in range(RUNS)] == [False, True, False]
    assert len(away.records(1).lines()) == 2
    with interrupts_request_stop():
        assert plain(complete_runs(away, 1, engine=ThreadsEngine(1))) == plain(expected)
    assert files(away) == files(alone)


def test_a_stop_request_keeps_what_workers_did(command, short_portions):
    alone, away, request = command("alone"), command("away"), current_stop_request()

    def stop(unit):
        if unit.name == "run 2" and "state" in unit.files:
            request.make()

    engine = ThreadsEngine(1, stop)
    with pytest.raises(KeyboardInterrupt):
        complete_runs(away, 1, engine=engine)
    assert engine.stopped
    assert away.answer(0) is not None
    assert away.answer(1) is None
    assert away.reached(1).state.generation == 2
    assert away.reached(2) is None
    with interrupts_request_stop():
        complete_runs(away, 1)
        complete_runs(alone, 1)
    assert files(away) == files(alone)


def test_what_is_wrong_with_a_run_is_raised_here(command):
    wrong = command("wrong", overrides=["reward.right=1 / (step - 1)"])
    with pytest.raises(RewardNotFinite):
        complete_runs(wrong, 1, engine=ThreadsEngine(2))
    assert current_stop_request().is_made


@pytest.mark.slow
def test_an_engine_that_is_ready_is_taken_also_where_it_has_more_workers_than_needed(command):
    from bbsd.engines.local import processes_engine

    alone, together = command("alone"), command("together")
    with processes_engine(2, NEEDED) as ready:
        found = side_by_side(together, [1, 2], 2, None, ready)
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

    def share(theirs, own, _runs, engine, _listener):
        seen.extend([engine.count, theirs.problem.jobs, own.problem.jobs])
        return {}

    monkeypatch.setattr(
        workers, "processes_engine", lambda count, _imports: nullcontext(ThreadsEngine(count))
    )
    monkeypatch.setattr(workers, "_share_runs", share)
    side_by_side(command("jobs"), [*range(RUNS)], jobs, None)
    n_workers, threads, own = expected
    assert seen == [n_workers, threads, own]
    assert own == jobs - n_workers * threads


def test_lost_runs_are_something_to_go_on_from():
    one, two = RunsLost(Path("folder"), [1]), RunsLost(Path("folder"), [0, 3])
    assert isinstance(one, UsageError)
    assert "did run 2 were killed" in str(one)
    assert "did each of the runs 1, 4 were killed" in str(two)
    assert "folder" in str(one)
    assert "--resume" in one.advice
