"""A run's folder: anything can open it, rsync can copy it, and a run that was killed goes on from it."""

from __future__ import annotations

import json
import platform
from dataclasses import dataclass
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bbsd.errors import UsageError
from bbsd.solver import checkpoint
from bbsd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.solver.checkpoint import Progress

FORMAT = 1


class FolderError(UsageError):
    """A folder that cannot be written to or gone on from, and what to do about it."""


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
    """The files of a run."""

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
    def figure(self) -> Path:
        """The curves over the generations."""
        return self.path / "curves.png"

    @property
    def note(self) -> Path:
        """What was run, with what, and what came of it."""
        return self.path / "run.json"

    @property
    def _checkpoint(self) -> Path:
        return self.path / "checkpoint.npz"

    def copy_spec(self, text: str) -> None:
        """Keep the spec as it was when the run began."""
        (self.path / "spec.yaml").write_text(text, encoding="utf-8")

    def write_architecture(self, text: str) -> None:
        """Write the designed spec; one that is there already may have been edited since and is left alone."""
        if not self.architecture.exists():
            self.architecture.write_text(text, encoding="utf-8")

    def save(self, progress: Progress, line: dict[str, Any] | None) -> None:
        """Note a generation: first its metrics, then the state, so the state never knows more than the metrics."""
        if line is not None:
            with self.metrics.open("a", encoding="utf-8") as file:
                file.write(json.dumps(line) + "\n")
        checkpoint.save(self._checkpoint, progress)

    def progress(self) -> Progress | None:
        """The last state that was saved, with the metrics cut back to it; None if there is none.

        Raises FolderError for a damaged checkpoint.
        """
        if not self._checkpoint.exists():
            self.metrics.unlink(missing_ok=True)
            return None
        try:
            progress = checkpoint.load(self._checkpoint)
        except checkpoint.CheckpointError as error:
            raise FolderError(f"{error}; remove the folder to start again") from None
        lines = [
            line
            for line in self.lines()
            if (line["run"] - 1, line["generation"]) <= (progress.run, progress.state.generation)
        ]
        text = "".join(json.dumps(line) + "\n" for line in lines)
        self.metrics.write_text(text, encoding="utf-8")
        return progress

    def lines(self) -> list[dict[str, Any]]:
        """The metrics so far; a last line that was cut off is left out.

        Raises FolderError for a file that is damaged.
        """
        if not self.metrics.exists():
            return []
        whole = [
            line
            for line in self.metrics.read_text(encoding="utf-8").splitlines(keepends=True)
            if line.endswith("\n")
        ]
        try:
            return [json.loads(line) for line in whole]
        except ValueError:
            raise FolderError(f"{self.metrics} is damaged; remove the folder to start again") from None

    def write_note(self, who: Identity, result: dict[str, Any] | None = None) -> None:
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
        self.note.write_text(json.dumps(note, indent=2) + "\n", encoding="utf-8")

    def is_of(self, who: Identity) -> bool:
        """Whether the folder holds a run of exactly this."""
        try:
            note = json.loads(self.note.read_text(encoding="utf-8"))
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


def old_folder(wanted: Path | None, name: str, who: Identity) -> Folder:
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
