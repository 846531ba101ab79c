"""Several runs on several cores, and how soon a design stops that is interrupted."""

from __future__ import annotations

import signal
import subprocess
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from benchmarks.page import Asked, table
from benchmarks.processes import LIFTING, design_command, environment, spent
from benchmarks.timing import CORES, on_all_cores

if TYPE_CHECKING:
    from collections.abc import Sequence

SHARE, SOON = 0.9, 2.0
INTERRUPTED = 130
LONG = ["--set", "design.coevolution.generations=2000"]
STOPPED = {
    "one run": LONG,
    "four runs, one job": ["--runs", "4", *LONG],
    "four runs, two jobs": ["--runs", "4", "--jobs", "2", *LONG],
    "episodes of 100,000 steps": ["--set", "environment.steps=100000"],
}


def section(*, quick: bool) -> tuple[str, list[Asked]]:
    """The text of the section, and what was asked."""
    with tempfile.TemporaryDirectory() as name, on_all_cores():
        folder = Path(name)
        spent(design_command(LIFTING, folder / "first"), folder / "warm")
        rows, asked = throughput(folder, 1 if quick else 5)
        stopped = {what: slowest(folder, what, 1 if quick else 5) for what in STOPPED}
    asked += [
        Asked(f"interrupt answered, {what}, seconds", seconds, SOON) for what, seconds in stopped.items()
    ]
    return "\n".join(
        [
            "## Several cores, and interrupts",
            "",
            (
                "`specs/object_lifting.yaml`, whole processes by the clock on "
                f"{len(CORES)} cores: one command with four runs and two jobs, and two commands with two runs each at "
                "the same time, in turn. The one command also finds the best of all four."
            ),
            "",
            *table(["", "seconds", "throughput"], rows),
            "",
            (
                "Seconds from SIGINT to the end of a design that has been at work for a while, the longest of several; "
                f"all ended with {INTERRUPTED}. Where a single call of the kernel takes longer, it is not waited for."
            ),
            "",
            *table(["", "seconds"], [[what, f"{seconds:.2f}"] for what, seconds in stopped.items()]),
        ]
    ), asked


def throughput(folder: Path, rounds: int) -> tuple[list[list[str]], list[Asked]]:
    """Lines of the table, and what was asked."""
    if len(CORES) < 2:
        return [["", "", "missing: a second core"]], []
    one, two = [], []
    for turn in range(rounds):
        one.append(clocked(folder, [["--runs", "4", "--jobs", "2"]], f"one-{turn}"))
        two.append(clocked(folder, [["--runs", "2"], ["--runs", "2", "--seed", "1"]], f"two-{turn}"))
    share = float(np.median(np.array(two) / np.array(one)))
    rows = [
        ["two commands, two runs each", f"{np.median(two):.2f}", "1"],
        ["one command, four runs, two jobs", f"{np.median(one):.2f}", f"{share:.2f}"],
    ]
    return rows, [Asked("four runs, --jobs 2: throughput of two processes", share, SHARE, least=True)]


def clocked(folder: Path, commands: Sequence[Sequence[str]], name: str) -> float:
    """Seconds until all of these designs, begun at once, have ended."""
    began = time.perf_counter()
    running = [started(folder, folder / f"{name}-{place}", options) for place, options in enumerate(commands)]
    codes = [process.wait() for process in running]
    if any(codes):
        raise RuntimeError(f"a design failed: {commands}")
    return time.perf_counter() - began


def started(folder: Path, out: Path, options: Sequence[str]) -> subprocess.Popen[bytes]:
    """A design that runs."""
    return subprocess.Popen(
        [*design_command(LIFTING, out), *options],
        env=environment(folder / "warm"),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def slowest(folder: Path, what: str, rounds: int) -> float:
    """The longest time that an interrupt took to be answered."""
    return max(
        answered(folder, folder / f"{what.replace(' ', '-')}-{turn}", STOPPED[what]) for turn in range(rounds)
    )


def answered(folder: Path, out: Path, options: Sequence[str]) -> float:
    """Seconds from an interrupt, in the middle of a generation, to the end of the process."""
    running = started(folder, out, options)
    while not (out / "run.json").exists() and running.poll() is None:
        time.sleep(0.01)
    time.sleep(1.5)
    began = time.perf_counter()
    running.send_signal(signal.SIGINT)
    if running.wait() != INTERRUPTED:
        raise RuntimeError(f"an interrupted design ended with {running.returncode}: {options}")
    return time.perf_counter() - began
