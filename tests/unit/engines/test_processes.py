import os
import signal
import subprocess
import sys
import time
from concurrent.futures import BrokenExecutor
from pathlib import Path

import pytest

from bbsd.engines.processes import ENVIRONMENT, STOPPED, waiting_processes

SOON = 20
"""Seconds, on a machine that has much else to do."""


def is_there(process):
    """Whether a process exists and is no zombie."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def assert_gone(process):
    end = time.monotonic() + SOON
    while is_there(process):
        assert time.monotonic() < end
        time.sleep(0.05)


@pytest.mark.slow
def test_what_is_submitted_is_done_in_another_process():
    with waiting_processes(1) as processes:
        worker = processes.submit(os.getpid).result()
        assert worker != os.getpid()
        assert processes.submit(max, 3, 5).result() == 5
    assert_gone(worker)


SHARING = """
import os
from bbsd.engines.processes import waiting_processes

with waiting_processes(1) as processes:
    print(processes.submit(os.getenv, "BBSD_CACHE_DIR").result() == os.environ["BBSD_CACHE_DIR"])
    print(os.environ["BBSD_CACHE_DIR"])
"""


@pytest.mark.slow
def test_a_temporary_cache_is_reported_once_and_is_the_workers_too(tmp_path):
    (tmp_path / "file").touch()
    environment = {**os.environ, "BBSD_CACHE_DIR": str(tmp_path / "file")}
    done = subprocess.run(
        [sys.executable, "-c", SHARING], env=environment, capture_output=True, text=True, check=True
    )
    same, folder = done.stdout.split()
    assert same == "True"
    assert folder != str(tmp_path / "file")
    assert done.stderr.count("cannot keep compiled code") == 1


@pytest.mark.slow
def test_a_worker_ignores_interrupts():
    with waiting_processes(1) as processes:
        worker = processes.submit(os.getpid).result()
        os.kill(worker, signal.SIGINT)
        assert processes.submit(os.getpid).result() == worker


def test_without_a_parent_that_wants_it_a_worker_stops_wherever_it_is():
    with waiting_processes(1) as processes:
        forever = processes.submit(time.sleep, 1000)
        processes.stop()
        with pytest.raises(BrokenExecutor, match=f"EXIT\\({STOPPED}\\)"):
            forever.result()


@pytest.mark.slow
def test_what_was_dismissed_does_what_was_submitted_before():
    with waiting_processes(1) as processes:
        answer = processes.submit(pow, 2, 10)
        processes.dismiss()
        assert answer.result() == 1024


@pytest.mark.slow
def test_a_process_that_is_lost_takes_no_other_with_it_and_gets_a_successor():
    with waiting_processes(2) as processes:
        long, dead = processes.submit(time.sleep, 1), processes.submit(os._exit, 1)
        with pytest.raises(BrokenExecutor):
            dead.result()
        first, second = (processes.submit(os.getpid) for _ in range(2))
        assert long.result() is None
        assert first.result() != second.result()
        assert processes.submit(os.getpid).result() in {first.result(), second.result()}
    for worker in (first.result(), second.result()):
        assert_gone(worker)


@pytest.mark.slow
def test_modules_are_imported_before_the_first_call():
    with waiting_processes(1, ["colorsys"]) as processes:
        assert processes.submit(eval, "'colorsys' in __import__('sys').modules").result()


def test_nobody_waits_for_workers_that_nothing_was_submitted_to():
    began = time.monotonic()
    with pytest.raises(OSError, match="no more"), waiting_processes(2):
        raise OSError("no more")
    assert time.monotonic() - began < SOON
    assert not any(name in os.environ for name in ENVIRONMENT)
