"""Several runs on several cores, and how soon an interrupted design stops."""

from __future__ import annotations

import signal
import subprocess
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from benchmarks.processes import LIFTING, design_command, environment, usage_of
from benchmarks.report import Goal, Section, table
from benchmarks.timing import CORES, all_cores

if TYPE_CHECKING:
    from collections.abc import Sequence

LEAST_THROUGHPUT = 0.9
"""Of one command with two jobs, where two commands side by side have 1."""
MOST_SECONDS = 2.0
"""From an interrupt to the end of the process."""
INTERRUPTED = 130
MANY_GENERATIONS = ["--set", "design.coevolution.generations=2000"]
DESIGNS = {
    "one run": MANY_GENERATIONS,
    "four runs, one job": ["--runs", "4", *MANY_GENERATIONS],
    "four runs, two jobs": ["--runs", "4", "--jobs", "2", *MANY_GENERATIONS],
    "episodes of 100,000 steps": ["--set", "environment.steps=100000"],
}
"""Designs that are interrupted, by what is special about them: options of the command."""


def section(*, quick: bool) -> Section:
    """Measure the throughput of two jobs, and interrupt designs."""
    rounds = 1 if quick else 5
    with tempfile.TemporaryDirectory() as name, all_cores():
        folder = Path(name)
        usage_of(design_command(LIFTING, folder / "first"), folder / "warm")
        rows, goals = throughput(folder, rounds)
        delays = {design: longest_delay(folder, design, rounds) for design in DESIGNS}
    goals += [
        Goal(f"stopped after an interrupt, {design}, seconds", seconds, MOST_SECONDS)
        for design, seconds in delays.items()
    ]
    return Section(
        "Several cores, and interrupts",
        [
            (
                "`specs/paper/object_lifting.yaml`, whole processes by the wall clock on "
                f"{len(CORES)} cores: one command with four runs and two jobs, and two commands with two runs each at "
                "the same time, in turn. The one command also finds the best of all four."
            ),
            table(["", "seconds", "throughput"], rows),
            (
                "Seconds from SIGINT to the end of a design in the middle of its work, the longest of several; all "
                f"ended with exit code {INTERRUPTED}. The process does not wait for a single long call of the kernel."
            ),
            table(["", "seconds"], [[design, f"{seconds:.2f}"] for design, seconds in delays.items()]),
        ],
        goals,
    )


def throughput(folder: Path, rounds: int) -> tuple[list[list[str]], list[Goal]]:
    """Return the rows of the table, and the goal; no goal where there is one core only."""
    if len(CORES) < 2:
        return [["", "", "missing: a second core"]], []
    one, two = [], []
    for turn in range(rounds):
        one.append(seconds_of(folder, [["--runs", "4", "--jobs", "2"]], f"one-{turn}"))
        two.append(seconds_of(folder, [["--runs", "2"], ["--runs", "2", "--seed", "1"]], f"two-{turn}"))
    share = float(np.median(np.array(two) / np.array(one)))
    rows = [
        ["two commands, two runs each", f"{np.median(two):.2f}", "1"],
        ["one command, four runs, two jobs", f"{np.median(one):.2f}", f"{share:.2f}"],
    ]
    goal = Goal("four runs, --jobs 2: throughput of two processes", share, LEAST_THROUGHPUT, at_least=True)
    return rows, [goal]


def seconds_of(folder: Path, commands: Sequence[Sequence[str]], name: str) -> float:
    """Return the seconds until all of these designs, started at once, have ended."""
    began = time.perf_counter()
    designs = [start(folder, folder / f"{name}-{index}", options) for index, options in enumerate(commands)]
    codes = [design.wait() for design in designs]
    if any(codes):
        raise RuntimeError(f"a design failed: {commands}")
    return time.perf_counter() - began


def start(folder: Path, out: Path, options: Sequence[str]) -> subprocess.Popen[bytes]:
    """Start a design in a process of its own."""
    return subprocess.Popen(
        design_command(LIFTING, out, *options),
        env=environment(folder / "warm"),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def longest_delay(folder: Path, design: str, rounds: int) -> float:
    """Return the longest time from an interrupt to the end of the design."""
    outs = [folder / f"{design.replace(' ', '-')}-{turn}" for turn in range(rounds)]
    return max(interrupt_delay(folder, out, DESIGNS[design]) for out in outs)


def interrupt_delay(folder: Path, out: Path, options: Sequence[str]) -> float:
    """Return the seconds from an interrupt, in the middle of a generation, to the end of the process."""
    design = start(folder, out, options)
    while not (out / "run.json").exists() and design.poll() is None:
        time.sleep(0.01)
    time.sleep(1.5)
    began = time.perf_counter()
    design.send_signal(signal.SIGINT)
    if design.wait() != INTERRUPTED:
        raise RuntimeError(f"an interrupted design ended with {design.returncode}: {options}")
    return time.perf_counter() - began
