"""A design's folder: anything can open it, rsync can copy it, and runs that were killed go on from it."""

from __future__ import annotations

import json
import platform
from dataclasses import dataclass
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bbsd.runs.records import FolderError, Records
from bbsd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterator

FORMAT = 2


@dataclass(frozen=True, slots=True)
class Identity:
    """What a run is of: only the same can be gone on with."""

    spec_digest: str
    overrides: tuple[str, ...]
    seed: int
    runs: int

    def plain(self) -> dict[str, Any]:
        """As `run.json` holds it."""
        return {
            "bbsd": __version__,
            "spec_sha256": self.spec_digest,
            "set": list(self.overrides),
            "seed": self.seed,
            "runs": self.runs,
        }


def identity(spec_text: str, overrides: tuple[str, ...], seed: int, runs: int) -> Identity:
    """The identity of a command."""
    return Identity(sha256(spec_text.encode()).hexdigest(), overrides, seed, runs)


@dataclass(frozen=True, slots=True)
class Folder:
    """The files of a design."""

    path: Path

    @property
    def architecture(self) -> Path:
        """The designed spec."""
        return self.path / "architecture.yaml"

    @property
    def metrics(self) -> Path:
        """One line for each generation."""
        return self.path / "metrics.jsonl"

    @property
    def run_file(self) -> Path:
        """What was run, with what, and what came of it."""
        return self.path / "run.json"

    def records(self, run: int, n_runs: int) -> Records:
        """What is kept of a run, which counts from 0: in the folder itself where it is the only one."""
        return Records(self.path if n_runs == 1 else self.path / f"run-{run + 1}")

    def gather(self, n_runs: int) -> None:
        """Write the metrics of all runs, in their order, into one file."""
        if n_runs > 1:
            each = (self.records(run, n_runs).metrics.read_bytes() for run in range(n_runs))
            self.metrics.write_bytes(b"".join(each))

    def copy_spec(self, text: str) -> None:
        """Keep the spec as it was when the run began."""
        (self.path / "spec.yaml").write_text(text, encoding="utf-8")

    def write_architecture(self, text: str) -> None:
        """Write the designed spec; one that is there already may have been edited since and is left alone."""
        if not self.architecture.exists():
            self.architecture.write_text(text, encoding="utf-8")

    def lines(self) -> list[dict[str, Any]]:
        """The metrics of all generations. Raises FolderError for a file that is damaged."""
        return Records(self.path).lines()

    def write_run_file(self, who: Identity, result: dict[str, Any] | None = None) -> None:
        """Write `run.json`; the result is added when there is one."""
        note = {
            "format": FORMAT,
            **who.plain(),
            "versions": {name: version(name) for name in ("numba", "numpy", "llvmlite")},
            "machine": {
                "python": platform.python_version(),
                "system": platform.system(),
                "processor": platform.machine(),
            },
            **({} if result is None else {"result": result}),
        }
        self.run_file.write_text(json.dumps(note, indent=2) + "\n", encoding="utf-8")

    def is_of(self, who: Identity) -> bool:
        """Whether the folder holds a run of exactly this."""
        try:
            note = json.loads(self.run_file.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return False
        return isinstance(note, dict) and all(note.get(key) == value for key, value in who.plain().items())


def new_folder(wanted: Path | None, name: str, seed: int) -> Folder:
    """A new folder: the one wanted, which must be empty or not there, or the first free one under `runs/`."""
    try:
        if wanted is None:
            return Folder(next(path for path in _defaults(name, seed) if _made(path)))
        if not _made(wanted) and (not wanted.is_dir() or any(wanted.iterdir())):
            raise FolderError(
                f"{wanted} is not empty; nothing is overwritten: choose another --out, or go on with --resume"
            )
    except OSError as error:
        raise FolderError(f"{error.filename} cannot be made: {error.strerror}") from None
    return Folder(wanted)


def _made(path: Path) -> bool:
    """Make a folder; False if it was there, maybe only just made by another run."""
    try:
        path.mkdir(parents=True)
    except FileExistsError:
        return False
    return True


def folder_to_resume(wanted: Path | None, name: str, who: Identity) -> Folder:
    """The folder to go on in: the one wanted, or the newest default one that is of the same."""
    if wanted is not None:
        if not Folder(wanted).is_of(who):
            raise FolderError(
                f"{wanted} holds no run of this spec with this seed, these runs and these settings"
            )
        return Folder(wanted)
    found = None
    for path in _defaults(name, who.seed):
        if not path.exists():
            break
        found = Folder(path) if Folder(path).is_of(who) else found
    if found is None:
        raise FolderError(
            "there is no run of this spec with this seed under runs/ to go on with; name it with --out"
        )
    return found


def _defaults(name: str, seed: int) -> Iterator[Path]:
    base = Path("runs") / f"{name}-seed{seed}"
    yield base
    number = 2
    while True:
        yield base.with_name(f"{base.name}-{number}")
        number += 1
