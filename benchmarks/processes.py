"""Whole processes: how long a command takes to start, a design warm and cold, and how much memory it needs."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.cache import CACHE_VARIABLE
from benchmarks.lifting import SPECS
from benchmarks.page import Asked, table

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

LIFTING, ABSTRACT = str(SPECS / "object_lifting.yaml"), str(SPECS / "abstract.yaml")
PASS, HELP, CHECK = "python -c pass", "bbsd --help", "bbsd check specs/object_lifting.yaml"
DESIGN_LIFTING, DESIGN_ABSTRACT = "bbsd design specs/object_lifting.yaml", "bbsd design specs/abstract.yaml"
NEW, COLD = "a new spec, library cached, to its first generation", "the same, everything cold"

PYTHON_VARIABLE = "BENCHMARKED_PYTHON"

BOUNDS = {HELP: 8, CHECK: 16, DESIGN_LIFTING: 1.5, DESIGN_ABSTRACT: 8, NEW: 2, COLD: 15}
AGAINST_PASS = (HELP, CHECK)


@dataclass(frozen=True, slots=True)
class Spent:
    """What a process took: seconds by the clock, seconds of the processor, MB at its peak."""

    clock: float
    processor: float
    memory: float


def section(*, quick: bool) -> tuple[str, list[Asked]]:
    """The text of the section, and the bounds."""
    with tempfile.TemporaryDirectory() as name:
        found = measured(Path(name), quick=quick)
    medians = {
        what: Spent(*np.median([_figures(one) for one in runs], axis=0)) for what, runs in found.items()
    }
    shares = {
        what: float(
            np.median([run.clock / bare.clock for run, bare in zip(found[what], found[PASS], strict=False)])
        )
        for what in found
    }
    rows = [
        [what, f"{one.clock:.3g}", f"{one.processor:.3g}", f"{shares[what]:.3g}", f"{one.memory:.0f}"]
        for what, one in medians.items()
    ]
    asked = [
        Asked(
            f"{what}, {'times python -c pass' if what in AGAINST_PASS else 'seconds'}", figure, BOUNDS[what]
        )
        for what, figure in (
            (w, shares[w] if w in AGAINST_PASS else medians[w].clock) for w in found if w in BOUNDS
        )
    ]
    return "\n".join(
        [
            "## Whole processes",
            "",
            (
                "Medians of rounds in which each command ran once, seed 0, Python's bytecode and the kernels "
                "cached unless it says otherwise, of an installation without the peers. "
                "The first generation is there when its line of `metrics.jsonl` is; the process is stopped then."
            ),
            "",
            *table(["", "seconds", "processor's", "python -c pass = 1", "MB at the peak"], rows),
        ]
    ), asked


def _figures(spent: Spent) -> tuple[float, float, float]:
    return spent.clock, spent.processor, spent.memory


def measured(folder: Path, *, quick: bool) -> dict[str, list[Spent]]:
    """What each command took in each round."""
    rounds = 2 if quick else 5
    bbsd = [python(), "-m", "bbsd"]
    warm = folder / "warm"
    commands: dict[str, Callable[[int], Spent]] = {
        PASS: lambda _: spent([python(), "-c", "pass"], warm),
        HELP: lambda _: spent([*bbsd, "--help"], warm),
        CHECK: lambda _: spent([*bbsd, "check", LIFTING], warm),
        DESIGN_LIFTING: lambda turn: spent(design_command(LIFTING, folder / f"lifting-{turn}"), warm),
        NEW: lambda turn: to_first_generation(folder / f"new-{turn}", warm, steps=301 + turn),
        COLD: lambda turn: to_first_generation(folder / f"cold-{turn}", folder / f"cache-{turn}", steps=300),
    }
    if not quick:
        commands[DESIGN_ABSTRACT] = lambda turn: spent(
            design_command(ABSTRACT, folder / f"abstract-{turn}"), warm
        )
    for what in commands.keys() - {NEW, COLD}:
        commands[what](-1)
    found: dict[str, list[Spent]] = {what: [] for what in commands}
    for turn in range(rounds):
        for what, run in commands.items():
            if what in (COLD, DESIGN_ABSTRACT) and turn >= 2:
                continue
            found[what].append(run(turn))
    return found


def python() -> str:
    """The Python whose processes are measured: this one's would load what peers need."""
    return os.environ.get(PYTHON_VARIABLE, sys.executable)


def design_command(spec: str, out: Path) -> list[str]:
    return [python(), "-m", "bbsd", "design", spec, "--quiet", "--out", str(out)]


def to_first_generation(out: Path, cache: Path, steps: int) -> Spent:
    """A design with so many steps, stopped when its first generation is written down."""
    command = [*design_command(LIFTING, out), "--set", f"environment.steps={steps}"]
    return spent(command, cache, until=str(out / "metrics.jsonl"))


def spent(command: Sequence[str], cache: Path, until: str = "-") -> Spent:
    """Run a command to its end, or until a file holds something."""
    cache.mkdir(parents=True, exist_ok=True, mode=0o700)
    done = subprocess.run(
        [sys.executable, str(Path(__file__).with_name("launcher.py")), until, *command],
        check=True,
        stdout=subprocess.PIPE,
        text=True,
        env=environment(cache),
    )
    clock, processor, memory, status = map(float, done.stdout.split())
    if status and not (until != "-" and status == -signal.SIGKILL):
        raise RuntimeError(f"{' '.join(command)} failed")
    return Spent(clock, processor, memory)


def environment(cache: Path) -> dict[str, str]:
    """The present one with that cache; bytecode is kept, as it is where a package was installed."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return {**kept, CACHE_VARIABLE: str(cache), "PYTHONPYCACHEPREFIX": str(cache.parent / "bytecode")}
