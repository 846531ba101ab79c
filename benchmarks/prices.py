"""What `--dry-run` says beside what the design then takes, and memory beside the length of a design."""

from __future__ import annotations

import json
import subprocess
import tempfile
from pathlib import Path

from benchmarks.lifting import SPECS
from benchmarks.page import Asked, table
from benchmarks.processes import LIFTING, Spent, design_command, environment, python, spent

PRICED = ("object_lifting", "abstract", "mobile_robot")
FACTOR = 2.0
LONGER = {
    "as it is": [],
    "twice the generations": ["design.coevolution.generations=100"],
    "twice the episodes": ["design.learning.episodes=50"],
}
FLAT = 1.05
"""How much more memory a longer design may need: what the system gives varies."""
MEGABYTE = 1 << 20


def section(*, quick: bool) -> tuple[str, list[Asked]]:
    """The text of the section, and what was asked."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        design(LIFTING, folder / "first", folder)  # after it all bytecode is cached
        priced, asked = prices(folder, PRICED[:1] if quick else PRICED)
        longer = {what: memory(folder, what, settings) for what, settings in LONGER.items()}
    usual = longer["as it is"]
    asked += [
        Asked(f"memory, {what}, times as it is", megabytes / usual, FLAT)
        for what, megabytes in longer.items()
        if what != "as it is"
    ]
    return "\n".join(
        [
            "## Prices and memory",
            "",
            (
                "What `bbsd design SPEC --dry-run` says beside what the design then takes: the processor's seconds of "
                "the whole process, and MB at its peak; kernels cached."
            ),
            "",
            *table(["", "seconds, priced", "measured", "MB, priced", "measured"], priced),
            "",
            "`specs/object_lifting.yaml`, made longer:",
            "",
            *table(
                ["", "MB at the peak", "times as it is"],
                [[what, f"{found:.0f}", f"{found / usual:.3f}"] for what, found in longer.items()],
            ),
        ]
    ), asked


def prices(folder: Path, names: tuple[str, ...]) -> tuple[list[list[str]], list[Asked]]:
    """Lines of the table, and the factors between price and truth."""
    rows, asked = [], []
    for name in names:
        spec = str(SPECS / f"{name}.yaml")
        price(spec, folder)  # compiles what it needs
        said, taken = price(spec, folder), design(spec, folder / name, folder)
        seconds, megabytes = said["seconds"], said["bytes"] / MEGABYTE
        rows.append(
            [name, f"{seconds:.2f}", f"{taken.processor:.2f}", f"{megabytes:.0f}", f"{taken.memory:.0f}"]
        )
        asked.append(Asked(f"--dry-run, {name}: time, factor", apart(seconds, taken.processor), FACTOR))
        asked.append(Asked(f"--dry-run, {name}: memory, factor", apart(megabytes, taken.memory), FACTOR))
    return rows, asked


def apart(one: float, other: float) -> float:
    """By which factor two figures differ, whichever is greater."""
    return max(one / other, other / one)


def price(spec: str, folder: Path) -> dict[str, float]:
    """What the command says."""
    (folder / "warm").mkdir(mode=0o700, exist_ok=True)
    done = subprocess.run(
        [python(), "-m", "bbsd", "design", spec, "--dry-run", "--json"],
        check=True,
        stdout=subprocess.PIPE,
        text=True,
        env=environment(folder / "warm"),
    )
    said: dict[str, float] = json.loads(done.stdout)
    return said


def design(spec: str, out: Path, folder: Path, *options: str) -> Spent:
    """What the design takes."""
    return spent([*design_command(spec, out), *options], folder / "warm")


def memory(folder: Path, what: str, settings: list[str]) -> float:
    """MB at the peak of a longer design."""
    options = [word for setting in settings for word in ("--set", setting)]
    return design(LIFTING, folder / what.replace(" ", "-"), folder, *options).memory
