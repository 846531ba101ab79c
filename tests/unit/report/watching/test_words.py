from io import StringIO
from pathlib import Path

from rich.console import Console

from bbsd.report.watching.words import change_lines, state_line, watched_view
from bbsd.runs.storage.watching import Watched, WatchedRun
from tests.unit.report.watching.test_events import GENERATION, SEARCH

RESULT = {"return": {"mean": 1.5, "low": 1.25, "high": 1.75}, "structure": ["a", "b"]}


def watched(*runs, state="running", n_runs=1, budget=400, result=None):
    return Watched(Path("runs/x"), state, n_runs, budget, tuple(runs), result or {})


def shown(now, generations=0, width=80):
    console = Console(file=StringIO(), width=width, color_system=None)
    console.print(watched_view(now, generations))
    return console.file.getvalue()


def test_a_first_look_says_what_each_run_has_reached():
    now = watched(WatchedRun(1, "", tuple(SEARCH)))
    assert list(change_lines(None, now)) == [
        "400 of 400 episodes: answer -2.2500 in 44 new episodes",
        "runs/x is running",
    ]


def test_each_further_line_is_a_change():
    before = watched(WatchedRun(1, "", tuple(SEARCH[:1])))
    now = watched(WatchedRun(1, "", tuple(SEARCH)), state="done", result=RESULT)
    assert list(change_lines(before, now)) == [
        "400 of 400 episodes: answer -2.2500 in 44 new episodes",
        "runs/x is done: mean return 1.5000 (1.2500 to 1.7500), structure a b",
    ]
    assert list(change_lines(now, now)) == []


def test_a_run_that_was_taken_back_says_nothing_twice():
    before, now = watched(WatchedRun(1, "", tuple(SEARCH))), watched(WatchedRun(1, "", tuple(SEARCH[:1])))
    assert list(change_lines(before, now)) == []


def test_runs_and_rivals_are_named():
    now = watched(WatchedRun(2, "", (GENERATION,)), WatchedRun(1, "hill", tuple(SEARCH[:1])), n_runs=2)
    assert list(change_lines(None, now, generations=10))[:2] == [
        "run 2/2, generation 3/10: mean 0.5000, best 1.0000, lifetime 0.1250",
        "rival hill, run 1/2, 200 of 400 episodes: best so far 1.5000 in 22 new episodes",
    ]


def test_a_damaged_result_is_left_out():
    assert state_line(watched(state="done", result={"return": {"mean": "x"}})) == "runs/x is done"
    assert state_line(watched(state="done", result={"return": 3})) == "runs/x is done"


def test_a_picture_has_a_bar_a_curve_and_the_structure_of_each_run():
    text = shown(watched(WatchedRun(1, "", tuple(SEARCH[:1])), WatchedRun(2, "", (GENERATION,)), n_runs=2), 6)
    lines = text.splitlines()
    assert lines[0].rstrip() == "runs/x is running"
    assert [line.count("█") for line in lines if "run " in line] == [10, 10]
    assert "  best so far 1.5000 in 22 new episodes  ▅" in text
    assert max(map(len, lines)) <= 80


def test_names_cannot_steer_a_terminal():
    line = {**SEARCH[0], "structure": ["a\x1b[2J"]}
    assert "\x1b" not in shown(watched(WatchedRun(1, "hi\x1bll", (line,))))
