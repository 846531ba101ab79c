"""Builds wheel and source archive from what git tracks, so that nothing left over from another build gets in."""

from __future__ import annotations

import shutil
import sys
import tarfile
from dataclasses import dataclass
from typing import TYPE_CHECKING

from release.commands import ROOT, run

if TYPE_CHECKING:
    from pathlib import Path


@dataclass(frozen=True, slots=True)
class Built:
    """What was built."""

    source: Path
    """The source archive."""
    wheel: Path
    """The wheel, built from the source archive."""
    direct: Path
    """A wheel that was built from the tree."""


def tracked_files() -> tuple[str, ...]:
    """Return the paths of all files that git tracks, as they are in the work tree, from its root."""
    names = run("git", "ls-files", "-z", folder=ROOT).split("\0")
    return tuple(name for name in names if name and (ROOT / name).is_file())


def copy_tracked(target: Path) -> Path:
    """Copy the tracked files into a folder, and return it."""
    for name in tracked_files():
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, target / name)
    return target


def build(tree: Path, folder: Path) -> Built:
    """Build the source archive of a tree, a wheel of that, and a wheel of the tree, each in an environment of its own.

    The times of files in a wheel are those of the commit, as reproducible builds have them.
    """
    epoch = {"SOURCE_DATE_EPOCH": run("git", "log", "-1", "--format=%ct", folder=ROOT).strip()}
    run(sys.executable, "-m", "build", "--sdist", "--outdir", folder, tree, folder=folder, more=epoch)
    (source,) = folder.glob("*.tar.gz")
    with tarfile.open(source) as archive:
        archive.extractall(folder / "unpacked", filter="data")
    (unpacked,) = (folder / "unpacked").iterdir()
    wheels = {"from-source": unpacked, "direct": tree}
    for place, root in wheels.items():
        run(
            sys.executable,
            "-m",
            "build",
            "--wheel",
            "--outdir",
            folder / place,
            root,
            folder=folder,
            more=epoch,
        )
    wheel, direct = (next((folder / place).glob("*.whl")) for place in wheels)
    return Built(source, wheel, direct)
