import json
import os
import platform
from hashlib import sha256
from math import isnan

import pytest

from bbsd.runs.storage.listing import listed, listed_below
from bbsd.version import REVISION, __version__

LINE = {
    "run": 1,
    "method": "auto",
    "stage": "search",
    "episodes": 10,
    "mean": 1.0,
    "measured": 3,
    "structure": ["a"],
}
GENERATION = {
    "run": 1,
    "generation": 4,
    "mean": 1.0,
    "best": 2.5,
    "sd": 0.5,
    "lifetime": 0.9,
    "diversity": {"a": 0.5},
    "structure": ["a"],
}
RUN = {
    "format": 3,
    "bbsd": __version__,
    "revision": REVISION,
    "seed": 7,
    "runs": 1,
    "set": [],
    "budgets": [60, 40],
}
STATE = b"arrays"
WHOLE = sha256(STATE).digest() + STATE
DESIGN = "bbsd: 1\n"
RESULT = {
    "structure": ["a"],
    "return": {"mean": 3.0, "sd": 1.0, "low": 2.5, "high": 3.5, "count": 9},
    "architecture_sha256": sha256(DESIGN.encode()).hexdigest(),
}


def write(path, content):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())


def run(folder, lines=(LINE,), **changed):
    """Write the folder of a run that was stopped, or has ended where it has a result."""
    write(folder / "spec.yaml", DESIGN)
    write(folder / "lock", "")
    write(folder / "run.json", json.dumps({**RUN, **changed}))
    if lines:
        write(folder / "metrics.jsonl", "".join(json.dumps(line) + "\n" for line in lines))
        write(folder / "checkpoint.npz", WHOLE)
    if "result" in changed:
        write(folder / "architecture.yaml", DESIGN)
    return folder


def test_a_run_that_was_stopped(tmp_path):
    found = listed(run(tmp_path / "a", [LINE, {**LINE, "episodes": 30, "mean": 1.5}]))
    assert (found.state, found.detail, found.version) == ("stopped", "", "")
    assert (found.method, found.seed, found.runs) == ("auto", 7, 1)
    assert (found.done, found.budget, found.has_generations) == (30, 100, False)
    assert (found.best, isnan(found.mean)) == (1.5, True)
    assert found.written == (tmp_path / "a" / "checkpoint.npz").stat().st_mtime


def test_a_run_that_has_ended(tmp_path):
    found = listed(run(tmp_path, result=RESULT))
    assert (found.state, found.detail) == ("finished", "")
    assert (found.mean, found.low, found.high) == (3.0, 2.5, 3.5)


def test_a_run_that_is_written(tmp_path):
    write(
        run(tmp_path) / "lock",
        json.dumps({"host": platform.node(), "process": os.getpid(), "since": "2026-01-01T00:00:00Z"}),
    )
    found = listed(tmp_path)
    assert found.state == "running"
    assert found.detail == f"by process {os.getpid()} on {platform.node()}, since 2026-01-01T00:00:00Z"


def test_a_run_before_its_first_record(tmp_path):
    assert listed(run(tmp_path / "a", [])).state == "not begun"
    write(tmp_path / "b" / "lock", "")
    assert listed(tmp_path / "b").state == "not begun"


def test_several_runs_of_the_paper_count_their_generations(tmp_path):
    run(tmp_path, [], runs=3, budgets=[])
    for number, generation in ((1, 9), (2, 4)):
        line = {**GENERATION, "run": number, "generation": generation, "best": number / 2}
        write(tmp_path / f"run-{number}" / "metrics.jsonl", json.dumps(line) + "\n")
        write(tmp_path / f"run-{number}" / "checkpoint.npz", WHOLE)
    found = listed(tmp_path)
    assert (found.state, found.method, found.runs) == ("stopped", "paper", 3)
    assert (found.done, found.has_generations, found.best) == (13, True, 1.0)


def test_another_version_is_named(tmp_path):
    assert listed(run(tmp_path, revision=1)).version == f"bbsd {__version__}, revision 1"
    assert listed(run(tmp_path, bbsd="9.0.0", result=RESULT)).state == "finished"
    assert listed(tmp_path).version == f"bbsd 9.0.0, revision {REVISION}"


def test_a_design_that_was_edited_is_not_damaged(tmp_path):
    write(run(tmp_path, result=RESULT) / "architecture.yaml", "bbsd: 1\nname: mine\n")
    found = listed(tmp_path)
    assert (found.state, found.detail) == ("finished", "architecture.yaml was changed since")


def cut_run_file(folder):
    write(folder / "run.json", '{"format": 3, "se')


def list_for_run_file(folder):
    write(folder / "run.json", "[1, 2]")


def no_run_file(folder):
    (folder / "run.json").unlink()


def no_seed(folder):
    write(folder / "run.json", json.dumps({key: value for key, value in RUN.items() if key != "seed"}))


def other_lines(folder):
    write(folder / "metrics.jsonl", json.dumps(LINE) + '\n{"run": [1]}\n')


def flipped_checkpoint(folder):
    write(folder / "checkpoint.npz", bytes([WHOLE[0] ^ 1]) + WHOLE[1:])


def empty_design(folder):
    write(run(folder, result=RESULT) / "architecture.yaml", "")


def no_design(folder):
    (run(folder, result=RESULT) / "architecture.yaml").unlink()


@pytest.mark.parametrize(
    ("damage", "told"),
    [
        (cut_run_file, "run.json cannot be read"),
        (list_for_run_file, "run.json cannot be read"),
        (no_run_file, "run.json is missing, metrics.jsonl is there"),
        (no_seed, "run.json does not say seed"),
        (other_lines, "metrics.jsonl has lines that are no records"),
        (flipped_checkpoint, "checkpoint.npz is damaged"),
        (empty_design, "architecture.yaml is missing or empty; --resume writes it again"),
        (no_design, "architecture.yaml is missing or empty; --resume writes it again"),
    ],
)
def test_what_is_damaged_is_named(tmp_path, damage, told):
    damage(run(tmp_path))
    found = listed(tmp_path)
    assert (found.state, found.detail) == ("damaged", told)


def test_a_damaged_checkpoint_before_which_is_a_whole_one_is_none(tmp_path):
    flipped_checkpoint(run(tmp_path))
    write(tmp_path / "checkpoint.previous.npz", WHOLE)
    assert listed(tmp_path).state == "stopped"


def test_half_a_line_is_none(tmp_path):
    write(run(tmp_path) / "metrics.jsonl", json.dumps(LINE) + '\n{"run": 1, "mea')
    assert listed(tmp_path).state == "stopped"


ODD = (
    b"",
    b"\x00\xff",
    b"[" * 100_000,
    b"null",
    b'"x"',
    b"[]",
    b"\xff\xfe{\x00}\x00",
    b'{"mean": NaN}\n',
    b"1e999",
)


@pytest.mark.parametrize("content", ODD)
@pytest.mark.parametrize("name", ["run.json", "metrics.jsonl", "lock", "checkpoint.npz", "architecture.yaml"])
def test_whatever_is_in_a_file_the_run_is_listed(tmp_path, name, content):
    write(run(tmp_path, result=RESULT) / name, content)
    assert listed(tmp_path).state in {"finished", "damaged", "running"}


@pytest.mark.parametrize(
    "value", [None, [], {}, "x", True, -1, 0, 10**400, 1e308, float("nan"), [[1]], {"mean": {}}]
)
@pytest.mark.parametrize("key", [*RUN, "result", "environment"])
def test_whatever_a_record_says_the_run_is_listed(tmp_path, key, value):
    run(tmp_path, **{key: value})
    assert listed(tmp_path).folder == tmp_path


@pytest.mark.parametrize("value", [None, [], {}, "x", True, -1, 10**400, float("nan"), float("-inf")])
@pytest.mark.parametrize("key", [*LINE, "generation", "best"])
def test_whatever_a_line_says_the_run_is_listed(tmp_path, key, value):
    found = listed(run(tmp_path, [{**LINE, key: value}]))
    assert found.state in {"stopped", "damaged"}


@pytest.mark.parametrize("name", ["run.json", "metrics.jsonl", "lock", "checkpoint.npz", "architecture.yaml"])
def test_a_folder_or_a_pipe_for_a_file_is_no_hindrance(tmp_path, name):
    for number, make in enumerate((os.mkdir, os.mkfifo)):
        folder = run(tmp_path / str(number), result=RESULT)
        (folder / name).unlink()
        make(folder / name)
        assert listed(folder).folder == folder


def test_runs_are_found_two_levels_down_in_the_order_of_their_numbers(tmp_path):
    for name in ("b-10", "b-9", "a/seed-0", "a/b/c/too-deep"):
        run(tmp_path / name)
    (tmp_path / "other").mkdir()
    write(tmp_path / "file", "")
    found = [each.folder.relative_to(tmp_path).as_posix() for each in listed_below(tmp_path)]
    assert found == ["a/seed-0", "b-9", "b-10"]
    assert [each.folder for each in listed_below(tmp_path / "b-9")] == [tmp_path / "b-9"]


def test_listing_changes_nothing(tmp_path):
    run(tmp_path / "a", result=RESULT)
    before = {path: (path.stat().st_mtime_ns, path.stat().st_size) for path in tmp_path.rglob("*")}
    listed_below(tmp_path)
    assert {path: (path.stat().st_mtime_ns, path.stat().st_size) for path in tmp_path.rglob("*")} == before
