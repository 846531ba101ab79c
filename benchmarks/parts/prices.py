"""What `--dry-run` predicts beside what the design then takes, and memory against the length of a design."""

from __future__ import annotations

import json
import subprocess
import tempfile
from pathlib import Path

from benchmarks.processes import LIFTING, Usage, design_command, environment, measured_python, usage_of
from benchmarks.report import Goal, Section, table
from benchmarks.workloads.specs import SPECS

PRICED = ("paper/object_lifting", "paper/abstract", "mobile_robot")
MOST_OFF = 2.0
"""The factor by which a prediction may be off."""
AS_IT_IS = "as it is"
LENGTHS = {
    AS_IT_IS: [],
    "twice the generations": ["--set", "design.coevolution.generations=100"],
    "twice the episodes": ["--set", "design.learning.episodes=50"],
}
MOST_GROWTH = 1.05
"""The factor by which memory may grow with the length of a design: what the system gives varies."""
MEGABYTE = 1 << 20


def section(*, quick: bool) -> Section:
    """Compare prices with designs, and the memory of longer designs with that of the usual one."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        design(LIFTING, folder / "first", folder)  # caches all bytecode
        priced, goals = prices(folder, PRICED[:1] if quick else PRICED)
        memory = {
            length: design(LIFTING, folder / length.replace(" ", "-"), folder, *options).memory
            for length, options in LENGTHS.items()
        }
    usual = memory[AS_IT_IS]
    goals += [
        Goal(f"memory, {length}, times {AS_IT_IS}", megabytes / usual, MOST_GROWTH)
        for length, megabytes in memory.items()
        if length != AS_IT_IS
    ]
    return Section(
        "Prices and memory",
        [
            (
                "What `bbsd design SPEC --dry-run` predicts beside what the design then takes: the processor's seconds "
                "of the whole process, and MB at its peak; kernels cached."
            ),
            table(["", "seconds, predicted", "measured", "MB, predicted", "measured"], priced),
            "`specs/paper/object_lifting.yaml`, made longer:",
            table(
                ["", "MB at the peak", f"times {AS_IT_IS}"],
                [
                    [length, f"{megabytes:.0f}", f"{megabytes / usual:.3f}"]
                    for length, megabytes in memory.items()
                ],
            ),
        ],
        goals,
    )


def prices(folder: Path, names: tuple[str, ...]) -> tuple[list[list[str]], list[Goal]]:
    """Return the rows of the table, and the goals for the factors between price and measurement."""
    rows, goals = [], []
    for name in names:
        spec = str(SPECS / f"{name}.yaml")
        price(spec, folder)  # compiles what it needs
        predicted, usage = price(spec, folder), design(spec, folder / name.replace("/", "-"), folder)
        seconds, megabytes = predicted["seconds"], predicted["bytes"] / MEGABYTE
        rows.append(
            [name, f"{seconds:.2f}", f"{usage.processor:.2f}", f"{megabytes:.0f}", f"{usage.memory:.0f}"]
        )
        goals += [
            Goal(f"--dry-run, {name}: time, factor", factor(seconds, usage.processor), MOST_OFF),
            Goal(f"--dry-run, {name}: memory, factor", factor(megabytes, usage.memory), MOST_OFF),
        ]
    return rows, goals


def factor(one: float, other: float) -> float:
    """Return the factor between two figures, at least 1."""
    return max(one / other, other / one)


def price(spec: str, folder: Path) -> dict[str, float]:
    """Return what the command predicts."""
    (folder / "warm").mkdir(mode=0o700, exist_ok=True)
    done = subprocess.run(
        [measured_python(), "-m", "bbsd", "design", spec, "--dry-run", "--json"],
        check=True,
        stdout=subprocess.PIPE,
        text=True,
        env=environment(folder / "warm"),
    )
    predicted: dict[str, float] = json.loads(done.stdout)
    return predicted


def design(spec: str, out: Path, folder: Path, *options: str) -> Usage:
    """Design a spec and return what the process used."""
    return usage_of(design_command(spec, out, *options), folder / "warm")
