"""Parts of the page: tables, and what was asked beside what came out."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

PACKAGES = ("bbsd", "numpy", "numba", "jax", "deap")


@dataclass(frozen=True, slots=True)
class Asked:
    """A figure and the bound that it is to keep: at most, or at least."""

    what: str
    figure: float
    bound: float
    least: bool = False

    @property
    def met(self) -> bool:
        """Whether it does."""
        return self.figure >= self.bound if self.least else self.figure <= self.bound


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """The lines of a Markdown table, all columns but the first and the last to the right."""
    rule = ["---", *["---:"] * (len(head) - 2), "---"]
    return [f"| {' | '.join(cells)} |" for cells in (head, rule, *rows)]


def asked_section(asked: Sequence[Asked]) -> str:
    """What was asked, and whether it was met."""
    rows = [
        [
            each.what,
            f"{each.figure:.3g}",
            f"{'at least' if each.least else 'at most'} {each.bound:.3g}",
            "yes" if each.met else "**no**",
        ]
        for each in asked
    ]
    return "\n".join(["## What was asked", "", *table(["", "here", "asked", "met"], rows)])


def machine() -> str:
    """On what, with what and when this was measured."""
    load = f", load {os.getloadavg()[0]:.1f} at the start" if hasattr(os, "getloadavg") else ""
    return "\n".join(
        [
            f"- {datetime.now(UTC):%Y-%m-%d}, {_processor()}, {os.cpu_count()} cores{load}",
            f"- {platform.system()}, Python {platform.python_version()}, {_compiler()}, "
            + ", ".join(f"{name} {_version(name)}" for name in PACKAGES),
        ]
    )


def _processor() -> str:
    known = Path("/proc/cpuinfo")
    if not known.exists():
        return platform.processor() or platform.machine()
    lines = dict(line.split(":", 1) for line in known.read_text().splitlines() if ":" in line)
    fields = {name.strip(): value.strip() for name, value in lines.items()}
    flags = fields.get("flags", "").split()
    widest = next((name for name in ("avx512f", "avx2", "avx") if name in flags), "no AVX")
    return f"{fields.get('model name', platform.machine())} ({widest})"


def _compiler() -> str:
    compiler = shutil.which("gcc")
    if compiler is None:
        return "no gcc"
    found = subprocess.run([compiler, "-dumpfullversion"], check=False, capture_output=True, text=True)
    return f"gcc {found.stdout.strip()}"


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "missing"
