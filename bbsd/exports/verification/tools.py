"""Tools of other people that run what was exported: found, started in a folder of their own, and what goes wrong."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.exports.exported import Exported, Files

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

Run = Callable[[Exported, Files, "NDArray[np.int64]"], "NDArray[np.int64]"]
"""Returns the numbers of actions (n,) that what was written gives in joint cells (n, n_dimensions), run by a tool.

Raises ToolMissing where the tool is not there, ToolFailed where it refuses what was written."""

MOST_SECONDS = 600
"""How long one tool may take; it is stopped then."""
MOST_SAID = 2000
"""Characters of what a tool says that are shown."""


def any_number(_: Exported) -> int:
    """Return how many joint cells a tool goes through in some seconds that is as fast as machines are."""
    return sys.maxsize


class Runner(NamedTuple):
    """A tool that runs what was written; where one that is `needed` is missing, it is not verified.

    `most_cells` says how many joint cells of a design it can go through in less than a minute.
    """

    tool: str
    run: Run
    needed: bool = True
    most_cells: Callable[[Exported], int] = any_number


class ToolMissing(Exception):
    """A tool that is not on this machine; the message is its name."""


class ToolFailed(Exception):
    """A tool that did not do what was asked; the message says which one, and what it said."""


def found(tool: str) -> Path:
    """Return where a program is: on the path, or beside this Python. Raises ToolMissing where it is not."""
    beside = os.pathsep.join([os.environ.get("PATH", ""), str(Path(sys.executable).parent)])
    path = shutil.which(tool, path=beside)
    if path is None:
        raise ToolMissing(tool)
    return Path(path)


@contextmanager
def folder_of(files: Mapping[str, str]) -> Iterator[Path]:
    """Write files into a new folder, which is removed afterwards."""
    with TemporaryDirectory(prefix="bbsd-") as folder:
        for name, text in files.items():
            (Path(folder) / name).write_text(text, encoding="utf-8", newline="\n")
        yield Path(folder)


def run_in(folder: Path, *words: str | Path) -> None:
    """Run a program in a folder. Raises ToolFailed where it fails or takes too long."""
    name = Path(words[0]).name
    try:
        done = subprocess.run(  # noqa: S603 - a program that the user asked for
            [*map(str, words)], cwd=folder, capture_output=True, check=False, timeout=MOST_SECONDS
        )
    except subprocess.TimeoutExpired as error:
        raise ToolFailed(f"{name} took more than {MOST_SECONDS} seconds") from error
    if done.returncode:
        said = (done.stderr or done.stdout).decode(errors="replace").strip()[:MOST_SAID]
        raise ToolFailed(f"{name} failed with code {done.returncode}: {said}")


def write_cells(path: Path, cells: NDArray[np.int64]) -> None:
    """Write joint cells (n, n_dimensions) as a file of little-endian 32-bit numbers, row by row."""
    path.write_bytes(cells.astype("<u4").tobytes())


def read_numbers(path: Path, n: int) -> NDArray[np.int64]:
    """Return what a program wrote for so many joint cells: action numbers as little-endian 32-bit numbers.

    Raises ToolFailed where there are fewer or more.
    """
    content = path.read_bytes() if path.exists() else b""
    if len(content) != 4 * n:
        raise ToolFailed(f"{len(content) // 4} answers for {n} cells")
    return np.frombuffer(content, "<u4").astype(np.int64)
