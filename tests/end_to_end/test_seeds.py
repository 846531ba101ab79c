"""Designs of several seeds, one after another and side by side, as a shell sees them: the same files and texts."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from bbsd.runs.storage.lock import only_writer
from tests.end_to_end.commands import bbsd
from tests.end_to_end.test_environments import made

SPEC = Path(__file__).parent / "specs" / "thermostat.yaml"
QUICK = ("--set", "design.method=random", "--budget", "5000")
FILES = ("architecture.yaml", "metrics.jsonl", "visits.json", "curves.png")

pytestmark = pytest.mark.slow


def files(folder):
    """What was written for each seed that came to a result."""
    return {
        (part.name, name): (part / name).read_bytes()
        for part in sorted(folder.iterdir())
        for name in FILES
        if (part / name).exists()
    }


def test_the_same_is_written_and_said_with_any_number_of_jobs(tmp_path):
    results = []
    for jobs in (1, 2):
        out = tmp_path / f"jobs-{jobs}"
        code, *texts = bbsd("design", SPEC, "--seeds", "3-5", *QUICK, "--out", out, "--plot", "--jobs", jobs)
        assert code == 0, texts[1]
        results.append(([text.replace(out.name, "") for text in texts], files(out)))
    assert results[0] == results[1]
    assert len(results[0][1]) == 3 * len(FILES)
    (out, err), _ = results[0]
    assert out.index("\n   3 ") < out.index("\n   4 ") < out.index("\n   5 ")
    assert err.count("episodes: best so far") >= 3


def test_a_world_in_python_is_stepped_side_by_side_and_announced_once(tmp_path):
    spec, allowed = made(tmp_path)
    results = []
    for jobs in (1, 2):
        out = tmp_path / f"jobs-{jobs}"
        words = ("--seeds", "1-2", "--out", out, "--jobs", jobs, "-q", *allowed)
        code, printed, err = bbsd("design", spec, *words)
        assert code == 0, err
        assert err.count("importing") == 1
        results.append((printed.replace(out.name, ""), files(out)))
    assert results[0] == results[1]


def test_a_design_that_cannot_be_begun_ends_all_with_its_reason(tmp_path):
    (tmp_path / "seed-2").mkdir()
    with only_writer(tmp_path / "seed-2"):
        code, _, err = bbsd("design", SPEC, "--seeds", "1-3", *QUICK, "--out", tmp_path, "--jobs", 2, "-q")
    assert code == 2
    assert f"{tmp_path / 'seed-2'} is being written by process {os.getpid()}" in err
    assert "wait until it has ended" in err
    assert (tmp_path / "seed-1" / "architecture.yaml").exists()
    code, _, err = bbsd(
        "design", SPEC, "--seeds", "1-3", *QUICK, "--out", tmp_path, "--jobs", 2, "-q", "--resume"
    )
    assert code == 0, err
    assert {part for part, _ in files(tmp_path)} == {"seed-1", "seed-2", "seed-3"}


def started(out, *more):
    long = ("--set", "design.method=random", "--set", "environment.steps=1000", "--budget", "1_600_000")
    return subprocess.Popen(
        [sys.executable, "-m", "bbsd", "design", SPEC, "--seeds", "1-3", *long, "--out", out, *more],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def begun(out, count):
    """Wait until so many designs have kept a state."""
    deadline = time.monotonic() + 60
    while len([*out.glob("*/checkpoint.npz")]) < count and time.monotonic() < deadline:
        time.sleep(0.02)


def workers_of(process):
    """The processes that do designs for another one."""
    found = []
    for path in Path("/proc").glob("[0-9]*"):
        try:
            parent = int((path / "stat").read_text().rpartition(")")[2].split()[1])
            if parent == process.pid and b"popen_loky" in (path / "cmdline").read_bytes():
                found.append(int(path.name))
        except OSError:
            continue
    return found


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="asks for processes as Linux has them")
def test_what_is_interrupted_or_loses_a_process_comes_to_the_same(tmp_path):
    with started(tmp_path / "alone", "--jobs", "1") as running:
        expected, _ = running.communicate()
    with started(tmp_path / "stopped", "--jobs", "2") as running:
        begun(tmp_path / "stopped", 2)
        os.killpg(running.pid, signal.SIGINT)
        out, err = running.communicate()
    assert (running.returncode, out) == (130, "")
    assert f"what was done is kept in {tmp_path / 'stopped'}. To continue: bbsd design " in err
    assert "Traceback" not in err
    assert len(files(tmp_path / "stopped")) < 3 * 3
    with started(tmp_path / "stopped", "--jobs", "2", "--resume") as running:
        time.sleep(2)
        for worker in workers_of(running)[:1]:
            os.kill(worker, signal.SIGKILL)
        out, err = running.communicate()
    assert running.returncode == 0, err
    assert out.replace("stopped", "alone") == expected
    assert files(tmp_path / "stopped") == files(tmp_path / "alone")
