"""Commands measured as whole processes: their time, their memory, their caches."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.kernel.cache import CACHE_VARIABLE
from benchmarks.workloads.specs import SPECS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

LIFTING, ABSTRACT = str(SPECS / "paper" / "object_lifting.yaml"), str(SPECS / "paper" / "abstract.yaml")
PYTHON_VARIABLE = "BENCHMARKED_PYTHON"
"""Names the Python whose processes are measured: the running one has the peers' packages installed."""


@dataclass(frozen=True, slots=True)
class Usage:
    """What a process used: seconds by the wall clock, seconds of the processor, MB at its peak."""

    clock: float
    processor: float
    memory: float


def measured_python() -> str:
    """Return the path of the Python whose processes are measured."""
    return os.environ.get(PYTHON_VARIABLE, sys.executable)


def design_command(spec: str, out: Path, *options: str) -> list[str]:
    """Return the command that designs a spec into a folder."""
    return [measured_python(), "-m", "bbsd", "design", spec, "--quiet", "--out", str(out), *options]


def usage_of(command: Sequence[str], cache: Path, until: Path | None = None) -> Usage:
    """Run a command to its end, or until a file is not empty, and return what it used.

    Raises RuntimeError if the command fails.
    """
    cache.mkdir(parents=True, exist_ok=True, mode=0o700)
    launcher = [sys.executable, str(Path(__file__).with_name("launcher.py")), str(until or "-")]
    done = subprocess.run(
        [*launcher, *command],
        check=True,
        stdout=subprocess.PIPE,
        text=True,
        env=environment(cache),
    )
    clock, processor, memory, status = map(float, done.stdout.split())
    if status and not (until and status == -signal.SIGKILL):
        raise RuntimeError(f"{' '.join(command)} failed")
    return Usage(clock, processor, memory)


def environment(cache: Path) -> dict[str, str]:
    """Return the environment for a process with that cache of kernels.

    Python's bytecode is cached beside it, as it is where a package was installed.
    """
    inherited = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return {**inherited, CACHE_VARIABLE: str(cache), "PYTHONPYCACHEPREFIX": str(cache.parent / "bytecode")}


def figures_of(
    module: str, *arguments: str, patience: float, env: Mapping[str, str] | None = None
) -> list[float] | None:
    """Run a module of the benchmarks in a process of its own and return the numbers that it prints.

    Returns None if it takes longer than `patience`, in seconds.
    """
    try:
        done = subprocess.run(
            [sys.executable, "-m", module, *arguments],
            check=True,
            stdout=subprocess.PIPE,
            text=True,
            timeout=patience,
            env=env,
        )
    except subprocess.TimeoutExpired:
        return None
    return [float(word) for word in done.stdout.split()]
