"""What is kept of a run on disk: its metrics and tables, line by line, and the state from which it is resumed."""

from __future__ import annotations

import json
import os
import time
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.errors import UsageError
from bbsd.files import NO_FOLLOW, errors_name, make_folder, move, read_regular, write_all, write_whole
from bbsd.runs.storage import checkpoint
from bbsd.runs.storage.census import TABLES
from bbsd.runs.storage.reading import are_metrics, plain_data

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping
    from pathlib import Path
    from types import TracebackType
    from typing import Self, TypeVar

    from bbsd.runs.storage.census import Table
    from bbsd.runs.storage.checkpoint import Arrays
    from bbsd.runs.storage.identity import Identity

    T = TypeVar("T")

INTERVAL = 1.0
"""Seconds between two checkpoints at least: writing one to the disk takes 20 ms or more."""
METRICS = "metrics.jsonl"
FILES = (METRICS, *TABLES)
"""Files that grow line by line while a run goes on; all but the metrics may be missing."""


class FolderError(UsageError):
    """A folder that cannot be written to or resumed; the message says what to do about it."""


@dataclass(frozen=True, slots=True)
class Records:
    """The files of one run. Their folder is made with the first of them."""

    path: Path

    @property
    def metrics(self) -> Path:
        """The file of records, one a line."""
        return self.path / METRICS

    @property
    def checkpoint(self) -> Path:
        """The newest state that was saved."""
        return self.path / "checkpoint.npz"

    @property
    def previous(self) -> Path:
        """The state that was saved before it."""
        return self.path / "checkpoint.previous.npz"

    def load(self, who: Identity, restored: Callable[[Arrays], T]) -> T | None:
        """Return what `restored` makes of the newest state, or None if there is none.

        Metrics and tables are cut back to it. Where the newest is damaged, or does not agree with these files,
        the state before it is taken.

        Raises:
            FolderError: no state that was saved can be resumed; the message says why.
        """
        saved = [path for path in (self.checkpoint, self.previous) if path.exists()]
        if not saved:
            for name in FILES:
                (self.path / name).unlink(missing_ok=True)
            return None
        reasons = []
        for path in saved:
            try:
                arrays = checkpoint.load(path, who)
                contents = {name: self._content_at(name, arrays) for name in FILES}
                reached = restored(arrays)
            except checkpoint.CheckpointError as error:
                reason = str(error)
                reasons.append(reason if str(path) in reason else f"{path}: {reason}")
                continue
            for name, content in contents.items():
                self._cut(self.path / name, content)
            if path == self.previous:  # the next state must not put a damaged one in its place
                self.checkpoint.unlink(missing_ok=True)
            return reached
        raise FolderError(f"{'; '.join(reasons)}; remove the folder to start again")

    def _content_at(self, name: str, arrays: Arrays) -> bytes:
        """Return what was written into a file when a state was saved."""
        path, (size_key, digest_key) = self.path / name, _position_keys(name)
        if name != METRICS and size_key not in arrays:
            return b""
        try:
            size, digest = int(arrays[size_key]), arrays[digest_key].tobytes()
        except (KeyError, TypeError, ValueError) as error:
            raise checkpoint.CheckpointError(f"it lacks {error}") from None
        content = read_regular(path)[:size] if path.exists() else b""
        if len(content) != size or sha256(content).digest() != digest:
            raise checkpoint.CheckpointError(f"{path} is not what it was when {self.checkpoint} was saved")
        return content

    @staticmethod
    def _cut(path: Path, content: bytes) -> None:
        if not path.exists() or path.stat().st_size == len(content):
            return
        if content or path.name == METRICS:
            write_whole(path, content)
        else:
            path.unlink()

    def lines(self) -> list[dict[str, Any]]:
        """Return the metrics so far, without a last line that was cut off. Raises FolderError for a damaged file."""
        if not self.metrics.exists():
            return []
        complete = [
            line for line in read_regular(self.metrics).splitlines(keepends=True) if line.endswith(b"\n")
        ]
        try:
            lines = [plain_data(line) for line in complete]
        except ValueError:
            lines = [None]
        if not are_metrics(lines):
            raise FolderError(f"{self.metrics} is damaged; remove the folder to start again")
        return lines

    def save_over(self, content: bytes) -> None:
        """Put a state in the place of the newest, which becomes the previous one."""
        if self.checkpoint.exists():
            move(self.checkpoint, self.previous)
        write_whole(self.checkpoint, content)


def _position_keys(name: str) -> tuple[str, str]:
    """Return the names of the arrays that hold how far a file was written when a state was saved."""
    stem = name.partition(".")[0]
    return f"{stem}.size", f"{stem}.digest"


class _Growing:
    """A file to which lines are added, and the digest of its content.

    It is open only while something is written: a thousand runs may go on at the same time.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        with self._open():
            content = read_regular(path)
        self.size, self.lines, self._digest = len(content), content.count(b"\n"), sha256(content)
        self._synced = True

    def add(self, text: bytes) -> None:
        """Write whole lines."""
        with self._open() as file:
            write_all(file, text)
        self.size += len(text)
        self.lines += text.count(b"\n")
        self._digest.update(text)
        self._synced = False

    def position(self) -> Arrays:
        """Return how far the file is written, once that has reached the disk."""
        if not self._synced:
            with self._open() as file:
                os.fsync(file)
            self._synced = True
        size, digest = _position_keys(self.path.name)
        return {size: np.array(self.size), digest: np.frombuffer(self._digest.digest(), np.uint8)}

    @contextmanager
    def _open(self) -> Iterator[int]:
        with errors_name(self.path):
            file = os.open(self.path, os.O_WRONLY | os.O_CREAT | os.O_APPEND | NO_FOLLOW, 0o666)
            try:
                yield file
            finally:
                os.close(file)


def line_text(line: dict[str, Any]) -> bytes:
    """Return a line of metrics as it is written."""
    return json.dumps(line).encode() + b"\n"


class Journal:
    """The records of a run while it goes on: each line is written at once, the state at most once a second."""

    def __init__(self, records: Records, who: Identity) -> None:
        make_folder(records.path)
        self._records, self._who = records, who
        self._files: dict[str, _Growing] = {}
        for name in FILES:
            if name == METRICS or (records.path / name).exists():
                self._grow(name)
        self._unsaved: Callable[[], Arrays] | None = None
        self._saved_at = -INTERVAL

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Save the last state, also where the run was interrupted."""
        if isinstance(error, OSError):
            with suppress(OSError):
                self.save()
        else:
            self.save()

    @property
    def lines(self) -> int:
        """The number of lines of metrics."""
        return self._files[METRICS].lines

    def add(
        self, arrays: Callable[[], Arrays], line: dict[str, Any] | None, tables: Iterable[Table] = ()
    ) -> None:
        """Record a step of the run: its line of metrics, rows of tables, and what makes the arrays of its state."""
        with self._whole_step():
            if line is not None:
                self._files[METRICS].add(line_text(line))
            for table in tables:
                file = self._grow(table.file)
                file.add(table.content(with_columns=file.size == 0))
        self._unsaved = arrays
        if time.monotonic() - self._saved_at >= INTERVAL:
            self.save()

    def add_texts(self, texts: Mapping[str, bytes], arrays: Callable[[], Arrays], interval: float) -> None:
        """Record several steps as what they add to each file; the state is saved after the interval, in seconds."""
        with self._whole_step():
            for name in sorted(texts):
                self._grow(name).add(texts[name])
        self._unsaved = arrays
        if time.monotonic() - self._saved_at >= interval:
            self.save()

    @contextmanager
    def _whole_step(self) -> Iterator[None]:
        """Never save a state beside files that are ahead of it, because a step was written in part."""
        try:
            yield
        except BaseException:
            self._unsaved = None
            raise

    def sizes(self) -> dict[str, int]:
        """Return the sizes of the files that grow."""
        return {name: file.size for name, file in self._files.items()}

    def save(self) -> None:
        """Save the last state, after metrics and tables have reached the disk; nothing where it is saved already."""
        if self._unsaved is None:
            return
        arrays = self._unsaved()
        for file in self._files.values():
            arrays |= file.position()
        self._records.save_over(checkpoint.packed(self._who, arrays))
        self._unsaved, self._saved_at = None, time.monotonic()

    def _grow(self, name: str) -> _Growing:
        if name not in self._files:
            self._files[name] = _Growing(self._records.path / name)
        return self._files[name]
