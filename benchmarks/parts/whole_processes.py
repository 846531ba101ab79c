"""Whole processes: how long a command takes to start, a design warm and cold, and how much memory it needs."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from benchmarks.processes import ABSTRACT, LIFTING, Usage, design_command, measured_python, usage_of
from benchmarks.report import Goal, Section, table

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

PASS, HELP, CHECK = "python -c pass", "bbsd --help", "bbsd check specs/paper/object_lifting.yaml"
EXPLAIN = "bbsd explain RUN, of that design"
DESIGN_LIFTING = "bbsd design specs/paper/object_lifting.yaml"
DESIGN_ABSTRACT = "bbsd design specs/paper/abstract.yaml"
NEW, COLD = "a new spec, library cached, to its first generation", "the same, everything cold"

BOUNDS = {HELP: 8, CHECK: 16, EXPLAIN: 2, DESIGN_LIFTING: 1.5, DESIGN_ABSTRACT: 8, NEW: 2, COLD: 15}
AGAINST_PASS = (HELP, CHECK)
"""The commands whose bound is a multiple of `python -c pass`; the others are bounded in seconds."""
AGAINST_CHECK = (EXPLAIN,)
"""The commands whose bound is a multiple of `bbsd check`."""
TWICE_ONLY = (COLD, DESIGN_ABSTRACT)
"""Long commands, which run in two rounds only."""


def section(*, quick: bool) -> Section:
    """Measure each command once in each round."""
    with tempfile.TemporaryDirectory() as name:
        usages = measured(Path(name), quick=quick)
    medians = {
        command: Usage(*np.median([(one.clock, one.processor, one.memory) for one in runs], axis=0))
        for command, runs in usages.items()
    }
    shares = _times(usages, PASS)
    goals = [
        *_goals(usages, AGAINST_PASS, PASS),
        *_goals(usages, AGAINST_CHECK, CHECK),
        *(
            Goal(f"{command}, seconds", medians[command].clock, BOUNDS[command])
            for command in usages
            if command in BOUNDS and command not in (*AGAINST_PASS, *AGAINST_CHECK)
        ),
    ]
    rows = [
        [command, f"{one.clock:.3g}", f"{one.processor:.3g}", f"{shares[command]:.3g}", f"{one.memory:.0f}"]
        for command, one in medians.items()
    ]
    text = (
        "Medians of rounds in which each command ran once, seed 0, Python's bytecode and the kernels cached unless it "
        "says otherwise, of an installation without the peers. The first generation is done when its line is in "
        "`metrics.jsonl`; the process is stopped then."
    )
    head = ["", "seconds", "seconds of the processor", "python -c pass = 1", "MB at the peak"]
    return Section("Whole processes", [text, table(head, rows)], goals)


def _times(usages: Mapping[str, Sequence[Usage]], other: str) -> dict[str, float]:
    """Return how many times as long as another command each one takes, as the median over rounds."""
    return {
        command: float(
            np.median([run.clock / base.clock for run, base in zip(runs, usages[other], strict=False)])
        )
        for command, runs in usages.items()
    }


def _goals(usages: Mapping[str, Sequence[Usage]], commands: Sequence[str], other: str) -> list[Goal]:
    times = _times(usages, other)
    return [Goal(f"{command}, times {other}", times[command], BOUNDS[command]) for command in commands]


def measured(folder: Path, *, quick: bool) -> dict[str, list[Usage]]:
    """Return what each command used in each of its rounds."""
    bbsd, warm = [measured_python(), "-m", "bbsd"], folder / "warm"
    commands: dict[str, Callable[[int], Usage]] = {
        PASS: lambda _: usage_of([measured_python(), "-c", "pass"], warm),
        HELP: lambda _: usage_of([*bbsd, "--help"], warm),
        CHECK: lambda _: usage_of([*bbsd, "check", LIFTING], warm),
        DESIGN_LIFTING: lambda turn: usage_of(design_command(LIFTING, folder / f"lifting-{turn}"), warm),
        EXPLAIN: lambda _: usage_of([*bbsd, "explain", str(folder / "lifting--1")], warm),
        NEW: lambda turn: to_first_generation(folder / f"new-{turn}", warm, steps=301 + turn),
        COLD: lambda turn: to_first_generation(folder / f"cold-{turn}", folder / f"cache-{turn}", steps=300),
    }
    if not quick:
        commands[DESIGN_ABSTRACT] = lambda turn: usage_of(
            design_command(ABSTRACT, folder / f"abstract-{turn}"), warm
        )
    for name, run in commands.items():
        if name not in (NEW, COLD):
            run(-1)
    usages: dict[str, list[Usage]] = {name: [] for name in commands}
    for turn in range(2 if quick else 5):
        for name, run in commands.items():
            if turn < 2 or name not in TWICE_ONLY:
                usages[name].append(run(turn))
    return usages


def to_first_generation(out: Path, cache: Path, steps: int) -> Usage:
    """Measure a design of episodes with so many steps, stopped when its first generation is recorded."""
    command = design_command(LIFTING, out, "--set", f"environment.steps={steps}")
    return usage_of(command, cache, until=out / "metrics.jsonl")
