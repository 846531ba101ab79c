"""Runs side by side in several processes, as a shell sees them: the same files, and nobody is left behind."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

SPEC = Path(__file__).parent / "specs" / "thermostat.yaml"
MODULES = (
    "cloudpickle",
    "concurrent",
    "json",
    "llvmlite",
    "loky",
    "multiprocessing",
    "numba",
    "numpy",
    "pickle",
)
LONG = ("--runs", "3", "--set", "design.coevolution.generations=80")

pytestmark = pytest.mark.skipif(os.name != "posix", reason="asks for processes as POSIX has them")


def start(*words, cwd):
    """Run a design in a process of its own, in a session of its own."""
    return subprocess.Popen(
        [sys.executable, "-P", "-m", "bbsd", "design", *map(str, words)],
        cwd=cwd,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        env={key: value for key, value in os.environ.items() if not key.startswith("PYTHON")},
    )


def ended(*words, cwd):
    running = start(*words, cwd=cwd)
    out, err = running.communicate()
    return running.returncode, out, err


def files(folder):
    return [(folder / name).read_bytes() for name in ("architecture.yaml", "metrics.jsonl")]


def members(session):
    """The processes of a session that have not ended, with their command lines."""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            _, _, rest = (folder / "stat").read_text().rpartition(")")
            state, _, _, its_session = rest.split()[:4]
            if int(its_session) == session and state not in "ZX":
                found[int(folder.name)] = (folder / "cmdline").read_text()
    return found


def wait_until(holds):
    """Wait for something that comes sooner or later, or not at all."""
    for _ in range(6000):
        if holds():
            return
        time.sleep(0.01)
    pytest.fail("waited for a minute")


def both_run(folder):
    """Whether two runs have begun, so a worker and its parent are at work."""
    return lambda: len([*folder.glob("run-*/checkpoint.npz")]) > 1


@pytest.fixture(scope="module")
def long(tmp_path_factory):
    """Long runs that nobody stopped, one after the other."""
    folder = tmp_path_factory.mktemp("long")
    code, _, _ = ended(SPEC, *LONG, "--out", "run", cwd=folder)
    assert code == 0
    return files(folder / "run")


@pytest.mark.parametrize("jobs", [2, 3, 7])
def test_any_number_of_jobs_gives_the_same_bytes(jobs, long, tmp_path):
    code, out, err = ended(SPEC, *LONG, "--out", "run", "--jobs", jobs, cwd=tmp_path)
    assert code == 0
    assert files(tmp_path / "run") == long
    assert "run/architecture.yaml, designed in" in out
    told = [line.partition(":")[0] for line in err.splitlines()]
    for run in (1, 2, 3):
        assert [line for line in told if line.startswith(f"run {run}/3")] == [
            f"run {run}/3, generation {g}/80" for g in range(8, 81, 8)
        ]


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="asks /proc who is there")
@pytest.mark.parametrize("to", ["group", "parent"])
def test_an_interrupt_leaves_no_process_behind_and_every_run_to_be_resumed(to, long, tmp_path):
    running = start(SPEC, *LONG, "--jobs", 2, "--out", "run", "-q", cwd=tmp_path)
    wait_until(both_run(tmp_path / "run"))
    (os.killpg if to == "group" else os.kill)(running.pid, signal.SIGINT)
    out, err = running.communicate()
    assert (running.returncode, out) == (130, "")
    assert [line.partition(";")[0] for line in err.splitlines()] == ["stopped"]
    wait_until(lambda: not members(running.pid))
    assert not (tmp_path / "run" / "architecture.yaml").exists()
    code, _, err = ended(SPEC, *LONG, "--jobs", 3, "--out", "run", "-q", "--resume", cwd=tmp_path)
    assert (code, err) == (0, "")
    assert files(tmp_path / "run") == long


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="asks /proc who is there")
def test_workers_do_not_outlive_a_parent_that_is_killed(long, tmp_path):
    running = start(SPEC, *LONG, "--jobs", 2, "--out", "run", "-q", cwd=tmp_path)
    wait_until(both_run(tmp_path / "run"))
    running.kill()
    assert running.communicate() == ("", "")
    wait_until(lambda: not members(running.pid))
    assert ended(SPEC, *LONG, "--out", "run", "-q", "--resume", cwd=tmp_path)[0] == 0
    assert files(tmp_path / "run") == long


class Killer:
    """Kills workers of a session, each of them once."""

    def __init__(self, session):
        self.session, self.killed = session, set()

    def kill(self):
        """Kill one that is there now, or comes soon."""
        wait_until(self._one_is_killed)

    def _one_is_killed(self):
        for number, command in members(self.session).items():
            if "popen_loky" in command and number not in self.killed:
                self.killed.add(number)
                os.kill(number, signal.SIGKILL)
                return True
        return False


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="asks /proc who is there")
def test_a_worker_that_is_killed_twice_costs_nothing_but_time(long, tmp_path):
    running = start(SPEC, *LONG, "--jobs", 2, "--out", "run", "-q", cwd=tmp_path)
    wait_until(both_run(tmp_path / "run"))
    killer = Killer(running.pid)
    killer.kill()
    killer.kill()
    out, err = running.communicate()
    assert (running.returncode, err) == (0, "")
    assert "run/architecture.yaml, designed in" in out
    assert files(tmp_path / "run") == long
    wait_until(lambda: not members(running.pid))


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="asks /proc who is there")
def test_a_run_that_loses_four_workers_is_reported_the_others_completed_and_the_design_resumed(
    long, tmp_path
):
    running = start(SPEC, *LONG, "--jobs", 2, "--out", "run", "-q", cwd=tmp_path)
    wait_until(both_run(tmp_path / "run"))
    killer = Killer(running.pid)
    for _ in range(4):
        killer.kill()
    out, err = running.communicate()
    assert (running.returncode, out) == (2, "")
    told, advice = err.splitlines()
    words = r"bbsd: 4 processes that did run (\d) were killed, one after the other, maybe by the system .*"
    lost = int(re.fullmatch(words, told)[1]) - 1
    assert told.endswith("the other runs were completed, and all finished generations are kept in run")
    assert advice.strip().startswith("continue with --resume; fewer --jobs need less memory")
    wait_until(lambda: not members(running.pid))
    lines = [len((tmp_path / f"run/run-{run}/metrics.jsonl").read_text().splitlines()) for run in (1, 2, 3)]
    assert lines.pop(lost) < 80
    assert lines == [80, 80]
    assert ended(SPEC, *LONG, "--out", "run", "-q", "--resume", cwd=tmp_path)[0] == 0
    assert files(tmp_path / "run") == long


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc").is_dir(), reason="asks /proc who is there")
def test_an_interrupt_of_a_design_on_a_cluster_is_quiet_and_it_can_be_resumed(long, tmp_path):
    cluster = ("--engine", "dask", "--jobs", 2, "--out", "run", "-q")
    running = start(SPEC, *LONG, *cluster, cwd=tmp_path)
    wait_until(both_run(tmp_path / "run"))
    os.killpg(running.pid, signal.SIGINT)
    out, err = running.communicate()
    assert (running.returncode, out) == (130, "")
    assert [line.partition(";")[0] for line in err.splitlines() if line] == ["stopped"]
    wait_until(lambda: not members(running.pid))
    running = start(SPEC, *LONG, *cluster, "--resume", cwd=tmp_path)
    wait_until(lambda: len(members(running.pid)) > 2)
    running.kill()
    assert running.communicate()[0] == ""
    wait_until(lambda: not members(running.pid))
    assert ended(SPEC, *LONG, "--out", "run", "-q", "--resume", cwd=tmp_path)[0] == 0
    assert files(tmp_path / "run") == long


def test_nothing_of_the_present_folder_is_executed(long, tmp_path):
    for name in MODULES:
        (tmp_path / f"{name}.py").write_text(f"open('{tmp_path}/executed-{name}', 'w').close()\n")
    (tmp_path / ".numba_config.yaml").write_text("disable_jit: 1\ndebug: 1\n")
    code, _, err = ended(SPEC, *LONG, "--jobs", 3, "--out", "run", "-q", cwd=tmp_path)
    assert (code, err) == (0, "")
    assert not [*tmp_path.glob("executed-*")]
    assert files(tmp_path / "run") == long


def test_a_reward_that_is_not_finite_is_told_once_at_its_place(tmp_path):
    (tmp_path / "odd.yaml").write_text(
        SPEC.read_text().replace("  gas: -0.25 * heating", "  gas: 1 / (step - 9)")
    )
    code, out, err = ended("odd.yaml", "--runs", 3, "--jobs", 3, "--out", "run", "-q", cwd=tmp_path)
    assert (code, out) == (2, "")
    assert err.startswith("odd.yaml:")
    assert "error[BB045]: the reward term gas was inf in step 9 for robot 0" in err
    assert err.count("error[") == 1
    assert "Traceback" not in err
