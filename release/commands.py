"""Runs other programs, and says what failed."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

ROOT = Path(__file__).parents[1]
LAST_LINES = 40
"""Lines of a failed command's output that are shown."""


class CheckFailed(Exception):
    """Something that is handed out is not as it should be."""


def run(*command: str | Path, folder: Path, more: Mapping[str, str] | None = None) -> str:
    """Run a command in a folder and return what it printed; CheckFailed with its last lines if it fails.

    Nothing of the checkout is imported by it: PYTHONPATH is left out of its surroundings.
    """
    surroundings = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    done = subprocess.run(
        list(map(str, command)),
        cwd=folder,
        env={**surroundings, "NO_COLOR": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1", **(more or {})},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
        check=False,
    )
    if done.returncode != 0:
        last = "\n".join(done.stdout.splitlines()[-LAST_LINES:])
        raise CheckFailed(f"{' '.join(map(str, command))}\nexit code {done.returncode}\n{last}")
    return done.stdout


def tool(name: str) -> Path:
    """Return the path of a program that is installed beside this Python."""
    return Path(sys.executable).parent / name
