import json

import pytest

from bbsd.runs.command import Command
from bbsd.runs.searching import ANSWER, SEARCH
from bbsd.runs.storage.state import Searching
from bbsd.solver.methods.registry import METHODS
from tests.unit.runs.commands import search_of

pytestmark = pytest.mark.slow

BUDGETS = (6000, 5000)


def written(command, run=0):
    return command.records(run).metrics.read_bytes()


def plain(architecture):
    return [*map(list, architecture.tables)], architecture.structure.tolist()


def test_a_budget_is_never_exceeded_and_counts_everything(tmp_path):
    command = search_of(tmp_path, 6000)
    command.complete(0)
    lines = command.records(0).lines()
    assert [line["stage"] for line in lines] == [SEARCH] * (len(lines) - 1) + [ANSWER]
    spent = [line["episodes"] for line in lines]
    assert spent == sorted(spent)
    assert 4800 <= spent[-2] < spent[-1] <= 6000
    state = command.reached(0).state
    assert isinstance(state, Searching)
    assert state.search.spent == 4800


def test_the_best_so_far_is_measured_in_episodes_that_did_not_choose_it(tmp_path):
    command = search_of(tmp_path, 20_000)
    command.complete(0)
    lines = command.records(0).lines()
    assert len(lines) > 5
    assert set(lines[0]) == {"run", "method", "stage", "episodes", "mean", "measured", "structure"}
    assert all(line["measured"] > 0 for line in lines)
    assert sorted(lines[-1]["structure"]) == ["even", "odd", "reckless"]
    assert lines[-1]["mean"] > 0.9  # of 2


@pytest.mark.parametrize("method", sorted(METHODS))
def test_a_search_that_is_stopped_after_any_record_and_resumed_writes_the_same_bytes(tmp_path, method):
    for name in ("whole", "stopped"):
        (tmp_path / name).mkdir()
    whole = search_of(tmp_path / "whole", *BUDGETS, method=method)
    stopped = search_of(tmp_path / "stopped", *BUDGETS, method=method, lanes=3)
    expected = plain(whole.complete(0))
    while stopped.answer(0) is None:
        resume_for_a_line(stopped)
    assert plain(stopped.answer(0)) == expected
    assert written(stopped) == written(whole)


def resume_for_a_line(command: Command):
    def stop(_line):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        command.complete(0, stop)


def test_a_further_budget_goes_on_from_the_end_of_the_former(tmp_path):
    for name in ("at once", "one after the other"):
        (tmp_path / name).mkdir()
    at_once = search_of(tmp_path / "at once", *BUDGETS)
    first = search_of(tmp_path / "one after the other", BUDGETS[0])
    further = search_of(tmp_path / "one after the other", *BUDGETS)
    first.complete(0)
    assert further.answer(0) is None
    assert plain(further.complete(0)) == plain(at_once.complete(0))
    assert written(further) == written(at_once)
    assert [json.loads(line)["stage"] for line in written(further).splitlines()].count(ANSWER) == 2


def test_a_deadline_ends_the_rounds_and_the_race_follows(tmp_path):
    command = search_of(tmp_path, 1_000_000)
    early = Command(
        command.problem, command.settings, 11, 2, command.folder, command.who, command.budgets, seconds=0.0
    )
    early.complete(0)
    lines = early.records(0).lines()
    assert lines[-1]["stage"] == ANSWER
    assert lines[-1]["episodes"] < 100_000


def test_runs_differ(tmp_path):
    command = search_of(tmp_path, 5000)
    for run in (0, 1):
        command.complete(run)
    assert written(command, 0) != written(command, 1)
