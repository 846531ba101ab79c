import json
import os
import platform
import subprocess
import sys

import pytest

from bbsd.runs.storage.watching import is_run, look

LINE = {"run": 1, "mean": 1.0, "structure": ["a"], "episodes": 10, "stage": "search", "measured": 3}
RUN = {"runs": 1, "budgets": [60, 40]}


def write(path, content):
    path.parent.mkdir(exist_ok=True)
    path.write_text(content if isinstance(content, str) else json.dumps(content))


def lines(*entries):
    return "".join(json.dumps(entry) + "\n" for entry in entries)


def held_by(folder, process, host=None):
    write(folder / "lock", {"host": host or platform.node(), "process": process, "since": "now"})


@pytest.fixture
def dead():
    """The number of a process that has ended."""
    with subprocess.Popen([sys.executable, "-c", ""]) as process:
        process.wait()
    return process.pid


def test_an_empty_folder_waits(tmp_path):
    now = look(tmp_path)
    assert (now.state, now.runs, now.result) == ("waiting", (), {})


def test_what_is_there_is_read(tmp_path):
    write(tmp_path / "run.json", RUN)
    write(tmp_path / "metrics.jsonl", lines(LINE, {**LINE, "mean": 2.0}))
    held_by(tmp_path, os.getpid())
    now = look(tmp_path)
    assert (now.state, now.n_runs, now.budget) == ("running", 1, 100)
    (run,) = now.runs
    assert [line["mean"] for line in run.lines] == [1.0, 2.0]


def test_half_a_line_and_damaged_ones_are_left_out(tmp_path):
    write(tmp_path / "run.json", '{"runs": 1, "bud')
    write(tmp_path / "metrics.jsonl", lines(LINE) + "{nonsense\n[1]\n{}\n" + lines(LINE)[:-5])
    (run,) = look(tmp_path).runs
    assert run.lines == (LINE,)


def test_several_runs_and_rivals(tmp_path):
    write(tmp_path / "run.json", {"runs": 2})
    write(tmp_path / "run-2" / "metrics.jsonl", lines(LINE))
    (tmp_path / "rival-hill").mkdir()
    write(tmp_path / "rival-hill" / "run-1" / "metrics.jsonl", lines(LINE))
    assert [(run.run, run.rival) for run in look(tmp_path).runs] == [(2, ""), (1, "hill")]


def test_a_run_that_ended_is_done(tmp_path):
    write(tmp_path / "run.json", {**RUN, "result": {"structure": ["a"]}})
    write(tmp_path / "lock", "")
    assert look(tmp_path).state == "done"
    assert look(tmp_path).result == {"structure": ["a"]}


def test_a_run_with_an_answer_that_goes_on_is_running(tmp_path):
    write(tmp_path / "run.json", {**RUN, "result": {"structure": ["a"]}})
    held_by(tmp_path, os.getpid())
    assert look(tmp_path).state == "running"


def test_a_run_whose_process_has_gone_is_stopped(tmp_path, dead):
    write(tmp_path / "run.json", RUN)
    held_by(tmp_path, dead)
    assert look(tmp_path).state == "stopped"
    write(tmp_path / "lock", "")
    assert look(tmp_path).state == "stopped"


def test_a_process_on_another_machine_is_taken_to_be_there(tmp_path, dead):
    write(tmp_path / "run.json", RUN)
    held_by(tmp_path, dead, "elsewhere")
    assert look(tmp_path).state == "running"


@pytest.mark.parametrize("content", ["{}", "[]", '{"process": "x"}', "\x00\xff"])
def test_a_damaged_lock_is_no_mistake(tmp_path, content):
    write(tmp_path / "run.json", RUN)
    write(tmp_path / "lock", content)
    assert look(tmp_path).state in {"running", "stopped"}


def test_looking_changes_nothing(tmp_path):
    write(tmp_path / "run.json", RUN)
    write(tmp_path / "metrics.jsonl", lines(LINE))
    before = {path.name: (path.stat().st_mtime_ns, path.read_bytes()) for path in tmp_path.iterdir()}
    look(tmp_path)
    assert {path.name: (path.stat().st_mtime_ns, path.read_bytes()) for path in tmp_path.iterdir()} == before


def test_which_folders_are_runs(tmp_path):
    assert is_run(tmp_path)
    assert not is_run(tmp_path / "none")
    write(tmp_path / "other.txt", "")
    assert not is_run(tmp_path)
    write(tmp_path / "spec.yaml", "")
    assert is_run(tmp_path)
