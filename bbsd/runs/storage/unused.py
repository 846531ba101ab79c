"""Folders in which nothing was achieved yet: what a design leaves that ended before its first step was kept."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.runs.storage.finished import LOCK, RUN_FILE, SPEC, run_content
from bbsd.runs.storage.records import FILES

if TYPE_CHECKING:
    from pathlib import Path

PART = re.compile(r"\..+\.[0-9a-f]{8}\.part")
"""Names of files that were being written, as `bbsd.files` gives them."""
BELOW = re.compile(r"run-[1-9][0-9]*|rival-.+")
"""Names of folders of runs and rivals."""


def is_unused(path: Path) -> bool:
    """Return whether a folder is empty, or holds only what a design leaves that ended before its first step was kept.

    A design makes the lock first: without one, files belong to somebody else, whatever their names are.
    """
    if not path.is_dir():
        return False
    files = list(path.iterdir())
    has_lock = any(file.name == LOCK for file in files)
    return all(has_lock and _is_leftover(file) for file in files) and not run_content(path).get("result")


def remove_parts(path: Path) -> None:
    """Remove what writers left in a locked folder and below it that were killed while they wrote a file."""
    folders = [
        path,
        *(each for each in path.iterdir() if BELOW.fullmatch(each.name) and _is_own_folder(each)),
    ]
    for folder in folders:
        for file in folder.iterdir():
            if PART.fullmatch(file.name) and not file.is_dir():
                file.unlink(missing_ok=True)


def _is_own_folder(path: Path) -> bool:
    return path.is_dir() and not path.is_symlink()


def _is_leftover(file: Path) -> bool:
    if file.is_symlink():
        return False
    if file.is_dir():
        return BELOW.fullmatch(file.name) is not None and all(
            not each.is_dir() and _is_leftover(each) for each in file.iterdir()
        )
    if file.name in FILES:
        return file.stat().st_size == 0
    return file.name in (LOCK, SPEC, RUN_FILE) or PART.fullmatch(file.name) is not None
