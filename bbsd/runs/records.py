"""What is kept of a run on disk: its metrics, line by line, and the state from which it is resumed."""

from __future__ import annotations

import json
import os
import time
from contextlib import suppress
from dataclasses import dataclass
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.errors import UsageError
from bbsd.files import NO_FOLLOW, errors_name, move, write_all, write_whole
from bbsd.runs import checkpoint

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path
    from types import TracebackType
    from typing import Self, TypeVar

    from bbsd.runs.checkpoint import Arrays
    from bbsd.runs.identity import Identity

    T = TypeVar("T")

INTERVAL = 1.0
"""Seconds between two checkpoints at least: writing one to the disk takes 20 ms or more."""
METRICS_SIZE, METRICS_DIGEST = "metrics.size", "metrics.digest"


class FolderError(UsageError):
    """A folder that cannot be written to or resumed; the message says what to do about it."""


@dataclass(frozen=True, slots=True)
class Records:
    """The files of one run. Their folder is made with the first of them."""

    path: Path

    @property
    def metrics(self) -> Path:
        """The file of records, one a line."""
        return self.path / "metrics.jsonl"

    @property
    def checkpoint(self) -> Path:
        """The newest state that was saved."""
        return self.path / "checkpoint.npz"

    @property
    def previous(self) -> Path:
        """The state that was saved before it."""
        return self.path / "checkpoint.previous.npz"

    def load(self, who: Identity, restored: Callable[[Arrays], T]) -> T | None:
        """Return what `restored` makes of the newest state, or None if none was saved; cut the metrics back to it.

        Where the newest is damaged, or does not agree with the metrics, the state before it is taken.

        Raises:
            FolderError: no state that was saved can be resumed; the message says why.
        """
        saved = [path for path in (self.checkpoint, self.previous) if path.exists()]
        if not saved:
            self.metrics.unlink(missing_ok=True)
            return None
        reasons = []
        for path in saved:
            try:
                arrays = checkpoint.load(path, who)
                metrics = self._metrics_at(arrays)
                reached = restored(arrays)
            except checkpoint.CheckpointError as error:
                reason = str(error)
                reasons.append(reason if str(path) in reason else f"{path}: {reason}")
                continue
            if self.metrics.exists() and self.metrics.stat().st_size != len(metrics):
                write_whole(self.metrics, metrics)
            return reached
        raise FolderError(f"{'; '.join(reasons)}; remove the folder to start again")

    def _metrics_at(self, arrays: Arrays) -> bytes:
        """Return the metrics that were written when a state was saved."""
        try:
            size, digest = int(arrays[METRICS_SIZE]), arrays[METRICS_DIGEST].tobytes()
        except (KeyError, TypeError, ValueError) as error:
            raise checkpoint.CheckpointError(f"it lacks {error}") from None
        content = self.metrics.read_bytes()[:size] if self.metrics.exists() else b""
        if len(content) != size or sha256(content).digest() != digest:
            raise checkpoint.CheckpointError(
                f"{self.metrics} is not what it was when {self.checkpoint} was saved"
            )
        return content

    def lines(self) -> list[dict[str, Any]]:
        """Return the metrics so far, without a last line that was cut off. Raises FolderError for a damaged file."""
        if not self.metrics.exists():
            return []
        complete = [
            line for line in self.metrics.read_bytes().splitlines(keepends=True) if line.endswith(b"\n")
        ]
        try:
            return [json.loads(line) for line in complete]
        except ValueError:
            raise FolderError(f"{self.metrics} is damaged; remove the folder to start again") from None

    def save_over(self, content: bytes) -> None:
        """Put a state in the place of the newest, which becomes the previous one."""
        if self.checkpoint.exists():
            move(self.checkpoint, self.previous)
        write_whole(self.checkpoint, content)


class Journal:
    """The records of a run while it goes on: each line is written at once, the state at most once a second."""

    def __init__(self, records: Records, who: Identity) -> None:
        records.path.mkdir(exist_ok=True)
        self._records, self._who = records, who
        with errors_name(records.metrics):
            self._file = os.open(records.metrics, os.O_WRONLY | os.O_CREAT | os.O_APPEND | NO_FOLLOW, 0o666)
        content = records.metrics.read_bytes()
        self._size, self._digest = len(content), sha256(content)
        self._unsaved: Callable[[], Arrays] | None = None
        self._saved_at = -INTERVAL

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Save the last state, also where the run was interrupted."""
        try:
            if isinstance(error, OSError):
                with suppress(OSError):
                    self.save()
            else:
                self.save()
        finally:
            os.close(self._file)

    def add(self, arrays: Callable[[], Arrays], line: dict[str, Any] | None) -> None:
        """Record a step of the run: its line of metrics, and what makes the arrays of its state."""
        if line is not None:
            text = json.dumps(line).encode() + b"\n"
            with errors_name(self._records.metrics):
                write_all(self._file, text)
            self._size += len(text)
            self._digest.update(text)
        self._unsaved = arrays
        if time.monotonic() - self._saved_at >= INTERVAL:
            self.save()

    def save(self) -> None:
        """Save the last state, after its metrics have reached the disk; nothing where it is saved already."""
        if self._unsaved is None:
            return
        with errors_name(self._records.metrics):
            os.fsync(self._file)
        position = {
            METRICS_SIZE: np.array(self._size),
            METRICS_DIGEST: np.frombuffer(self._digest.digest(), np.uint8),
        }
        self._records.save_over(checkpoint.packed(self._who, {**self._unsaved(), **position}))
        self._unsaved, self._saved_at = None, time.monotonic()
