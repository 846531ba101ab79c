"""Which folder a design is written into: a new one, or the one that is resumed."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.files import make_folder
from bbsd.runs.storage.folder import Folder, not_empty_text
from bbsd.runs.storage.identity import START
from bbsd.runs.storage.records import FolderError
from bbsd.runs.storage.unused import is_unused
from bbsd.version import REVISION, __version__

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.runs.storage.identity import Identity

RUNS = Path("runs")
"""Where designs are written that name no folder."""


def new_folder(wanted: Path | None, name: str, seed: int, below: Path = RUNS) -> Folder:
    """Make a new folder: the one wanted, which must be empty or not there, or the first free one below another."""
    try:
        if wanted is None:
            return Folder(next(path for path in _defaults(below, name, seed) if _make(path)))
        if not _make(wanted) and not is_unused(wanted):
            raise FolderError(not_empty_text(wanted))
    except OSError as error:
        raise FolderError(f"{error.filename} cannot be made: {error.strerror}") from None
    return Folder(wanted)


def _make(path: Path) -> bool:
    """Make a folder and return True, or False if it is there, maybe made by another run just now."""
    if not path.parent.is_dir():
        _make(path.parent)
    try:
        return make_folder(path)
    except FileExistsError:
        return False


def folder_to_resume(
    wanted: Path | None, name: str, who: Identity, below: Path = RUNS, *, has_start: bool = False
) -> Folder:
    """Return the folder of a design: the one wanted, or the newest one below another that has a start or has none.

    What the start is, the folder says.

    Raises FolderError if no folder holds this design, or only by another version or revision of bbsd.
    """
    folders = [Folder(wanted)] if wanted is not None else [*_default_folders(below, name, who.seed)]
    if wanted is None:
        folders = [folder for folder in folders if bool(folder.read_run_file().get("starts")) is has_start]
    for folder in reversed(folders):
        if folder.holds(who):
            return folder
    for folder in reversed(folders):
        if folder.holds_other_version(who):
            raise FolderError(_other_version(folder, who))
    if wanted is not None:
        raise FolderError(_other_run(folders[0], who))
    raise FolderError(
        f"there is no run of this spec with this seed under {below}/ that could be resumed; name its folder with --out"
    )


def _other_run(folder: Folder, who: Identity) -> str:
    content = folder.read_run_file()
    if not folder.path.exists():
        return f"there is no folder {folder.path}: nothing was begun there; start it without --resume"
    if not folder.run_file.exists() and is_unused(folder.path):
        return f"{folder.path} holds no run of this spec: nothing was begun there; start it without --resume"
    content = {key: value for key, value in content.items() if key != START}
    different = f": different are {' and '.join(who.differences(content))}" if "spec" in content else ""
    return f"{folder.path} holds no run of this spec with this seed, these runs and these settings{different}"


def _other_version(folder: Folder, who: Identity) -> str:
    content = folder.read_run_file()
    if content.get("bbsd") == __version__ and content.get("revision") == REVISION:
        different = " and ".join(who.differences(content))
        return (
            f"{folder.path} is a run of the same spec and seed in another environment: different are {different}; "
            "resume it where it was begun, or start again without --resume"
        )
    theirs = (
        f"bbsd {content.get('bbsd', 'of unknown version')}, revision {content.get('revision', 'unknown')}"
    )
    return (
        f"{folder.path} is a run of the same spec and seed by {theirs}; this is bbsd {__version__}, "
        f"revision {REVISION}, which may give other results: resume it with the former, or start again without --resume"
    )


def _default_folders(below: Path, name: str, seed: int) -> Iterator[Folder]:
    """Yield the folders below another that are there, oldest first."""
    for path in _defaults(below, name, seed):
        if not path.exists():
            return
        yield Folder(path)


def _defaults(below: Path, name: str, seed: int) -> Iterator[Path]:
    """Yield the folders below another that a design may use, one after another without end."""
    base = below / f"{name}-seed{seed}"
    yield base
    number = 2
    while True:
        yield base.with_name(f"{base.name}-{number}")
        number += 1
