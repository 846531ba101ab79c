"""Look at runs: at all in a folder, or at one that another process writes, until it ends."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.api.given.arguments import checked, path, paths
from bbsd.api.specs import load
from bbsd.errors import SpecError, UsageError
from bbsd.runs.storage.finished import SPEC, run_content
from bbsd.runs.storage.listing import listed_below
from bbsd.runs.storage.watching import is_run, look

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.runs.storage.listing import Listed
    from bbsd.runs.storage.watching import Watched

INTERVAL = 0.5
"""Seconds between two looks by default."""


class NoRun(UsageError):
    """A folder in which no run is or will be."""

    advice = "give the folder that bbsd design writes, as it names it with --out or below runs/"


@checked(run=path)
def watch(run: str | Path, *, interval: float = INTERVAL) -> Iterator[Watched]:
    """Yield how far a design is, now and after each change, until it is done or stopped.

    Nothing is written, and the folder's lock is not taken: a run is the same whether it is watched or not.

    Args:
        run: The folder of the run, which may be empty still.
        interval: Seconds between two looks.

    Raises:
        NoRun: there is no such folder, or it is another one.
    """
    folder = Path(run)
    if not is_run(folder):
        what = "is no folder of a run" if folder.is_dir() else "is no folder"
        raise NoRun(f"{folder} {what}")
    before = None
    while True:
        now = look(folder)
        if now != before:
            yield now
            before = now
        if now.state in ("done", "stopped"):
            return
        time.sleep(interval)


@checked(places=paths)
def runs_in(*places: str | Path) -> list[Listed]:
    """Return the runs in folders, each with its state, seed, and what came out so far; only read.

    Args:
        places: Folders of runs, or folders that hold such, up to two levels deep; by default `runs`, which need not be
            there.

    Raises:
        NoRun: there is no such folder.
        OSError: a folder cannot be read.
    """
    folders = [Path(place) for place in places] or [path for path in [Path("runs")] if path.exists()]
    for folder in folders:
        if not folder.is_dir():
            raise NoRun(f"{folder} is no folder")
    return [_with_generations(each) for folder in folders for each in listed_below(folder)]


def _with_generations(each: Listed) -> Listed:
    """Return a listed run with the number of its generations, which only its spec says."""
    if not each.has_generations:
        return each
    if each.state == "finished":
        return replace(each, budget=each.done)
    return replace(each, budget=generations(each.folder) * each.runs)


def generations(run: str | Path) -> int:
    """Return how many generations each run of a design has; 0 where that cannot be told, or it has none."""
    folder, content = Path(run), run_content(Path(run))
    overrides = content.get("set", [])
    if not (folder / SPEC).is_file():
        return 0
    try:
        loaded = load(folder / SPEC, set=[str(each) for each in overrides])
    except (SpecError, UsageError, OSError, TypeError):
        return 0
    design = loaded.spec.design
    return design.coevolution.generations if design.chosen_method == "paper" else 0
