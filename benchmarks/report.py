"""The page that the benchmarks write: its sections, tables and goals, and the machine that it was measured on."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
from dataclasses import dataclass, field
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

PACKAGES = ("bbsd", "numpy", "numba", "jax", "deap")


@dataclass(frozen=True, slots=True)
class Goal:
    """A measured figure and its bound: an upper one, or a lower one where `at_least`.

    A missed goal is shown on the page; one that is `required` makes the command fail.
    """

    name: str
    figure: float
    bound: float
    at_least: bool = False
    required: bool = False

    @property
    def met(self) -> bool:
        """Whether the figure keeps the bound."""
        return self.figure >= self.bound if self.at_least else self.figure <= self.bound


@dataclass(frozen=True, slots=True)
class Section:
    """A section of the page: paragraphs and tables under a title, and the goals that it measured."""

    title: str
    blocks: Sequence[str]
    goals: Sequence[Goal] = field(default_factory=list)

    def text(self) -> str:
        """Return the section as Markdown."""
        return "\n\n".join([f"## {self.title}", *self.blocks])


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a Markdown table, with all columns but the first and the last aligned to the right."""
    rule = ["---", *["---:"] * (len(head) - 2), "---"]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in (head, rule, *rows))


def goals_section(goals: Sequence[Goal]) -> Section:
    """Return the section that lists all goals and whether they were met."""
    rows = [
        [
            goal.name,
            f"{goal.figure:.3g}",
            f"{'at least' if goal.at_least else 'at most'} {goal.bound:.3g}",
            "yes" if goal.met else "**no**",
        ]
        for goal in goals
    ]
    return Section("Goals", [table(["", "measured", "goal", "met"], rows)])


def machine() -> str:
    """Return the date, the machine and the versions of this measurement, as a Markdown list."""
    load = f", load {os.getloadavg()[0]:.1f} at the start" if hasattr(os, "getloadavg") else ""
    return "\n".join(
        [
            f"- {datetime.now(UTC):%Y-%m-%d}, {_processor()}, {os.cpu_count()} cores{load}",
            f"- {platform.system()}, Python {platform.python_version()}, {_compiler()}, "
            + ", ".join(f"{name} {_version(name)}" for name in PACKAGES),
        ]
    )


def _processor() -> str:
    path = Path("/proc/cpuinfo")
    if not path.exists():
        return platform.processor() or platform.machine()
    lines = dict(line.split(":", 1) for line in path.read_text().splitlines() if ":" in line)
    fields = {name.strip(): value.strip() for name, value in lines.items()}
    flags = fields.get("flags", "").split()
    widest = next((name for name in ("avx512f", "avx2", "avx") if name in flags), "no AVX")
    return f"{fields.get('model name', platform.machine())} ({widest})"


def _compiler() -> str:
    compiler = shutil.which("gcc")
    if compiler is None:
        return "no gcc"
    answer = subprocess.run([compiler, "-dumpfullversion"], check=False, capture_output=True, text=True)
    return f"gcc {answer.stdout.strip()}"


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "missing"
