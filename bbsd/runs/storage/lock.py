"""One writer at a time in a run's folder: a design, or who puts a figure, a trace, a page there."""

from __future__ import annotations

import errno
import json
import os
import platform
import time
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from typing import TYPE_CHECKING

from bbsd.errors import UsageError
from bbsd.files import NO_FOLLOW, errors_name, read_regular, write_all, write_whole
from bbsd.runs.storage.finished import LOCK, PART, RUN_FILE, SPEC
from bbsd.runs.storage.reading import plain_data

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

HELD = (errno.EWOULDBLOCK, errno.EAGAIN, errno.EACCES)
"""The reasons of a refusal when another process has the lock."""
MOST_BYTES = 1000
"""Bytes of the file that are read: it names one process."""
LOOKS, BETWEEN_LOOKS = 10, 0.02
"""How often the file is read until it names a process, and the seconds between."""
PATIENCE = 1.0
"""Seconds that who writes one file waits for another one that does so."""
_HELD: ContextVar[frozenset[Path]] = ContextVar("held", default=frozenset())
"""The folders that are locked by whom asks, as they are resolved."""


class FolderInUse(UsageError):
    """Another process writes in the folder."""

    advice = "wait until it has ended, or stop it; it can then be continued with --resume"


class FileInFolderInUse(FolderInUse):
    """A file is to be written into a folder in which another process writes."""

    advice = "wait until it has ended, or write into another folder"


def write_result(path: Path, content: bytes) -> None:
    """Write a file that a user wants, whole: in the folder of a run while nobody else writes there.

    Links are followed, pipes and devices written directly.

    Raises:
        FileInFolderInUse: another process writes in the folder.
        OSError: the file cannot be written; it names the file.
    """
    with writer_of(path):
        write_whole(path, content, through_links=True)


def write_result_text(path: Path, text: str) -> None:
    """Write a text as UTF-8 with its own line ends, as `write_result` does."""
    write_result(path, text.encode())


@contextmanager
def writer_of(path: Path) -> Iterator[None]:
    """Hold the lock of the run in whose folder a file is, where there is one, and it is not held here already.

    Raises:
        FileInFolderInUse: another process writes in the folder.
    """
    folder = _run_around(path.resolve())
    if folder is None or folder in _HELD.get():
        yield
        return
    with only_writer(folder, PATIENCE, FileInFolderInUse):
        yield


def _run_around(path: Path) -> Path | None:
    """Return the folder of the run that a file is in, also in that of one of its parts; None for any other file."""
    around = path.parent
    folders = [around, *([around.parent] if PART.fullmatch(around.name) else [])]
    return next((each for each in folders if (each / RUN_FILE).is_file() and (each / SPEC).is_file()), None)


@contextmanager
def only_writer(
    folder: Path, patience: float = 0.0, refusal: type[FolderInUse] = FolderInUse
) -> Iterator[None]:
    """Hold the lock of a folder, which the system frees when this process ends, however it ends.

    Args:
        folder: the folder.
        patience: seconds that it is waited for.
        refusal: what is raised where another process holds it.

    Raises:
        FolderInUse: another process holds it; the message names the process.
    """
    path = folder / LOCK
    with errors_name(path):  # a link would lead to a file that is none of the folder's
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT | NO_FOLLOW, 0o666)
    try:
        until = time.monotonic() + patience
        while not _locked(descriptor):
            if time.monotonic() >= until:
                raise refusal(f"{folder} is being written by {holder_text(path)}")
            time.sleep(BETWEEN_LOOKS)
        with errors_name(path):
            os.ftruncate(descriptor, 0)
            write_all(descriptor, _who().encode())
        held = _HELD.set(_HELD.get() | {folder.resolve()})
        try:
            yield
        finally:
            _HELD.reset(held)
            with suppress(OSError):  # what was done is done; a lock that is not held hinders nobody
                os.ftruncate(descriptor, 0)
    finally:
        os.close(descriptor)


def _locked(descriptor: int) -> bool:
    """Lock a file for this process and return True, or False where another one has it."""
    try:
        import fcntl
    except ImportError:  # a system without such locks
        return True
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return error.errno not in HELD  # a file system without locks has nobody who holds one
    return True


def _who() -> str:
    since = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
    return json.dumps({"host": platform.node(), "process": os.getpid(), "since": since}) + "\n"


def holder_text(path: Path) -> str:
    """Return who holds a lock, in words; a holder that has just come may need a moment to write its name."""
    for _ in range(LOOKS):
        if (holder := _named(path)) is not None:
            return holder
        time.sleep(BETWEEN_LOOKS)
    return "another process"


def _named(path: Path) -> str | None:
    try:
        holder = plain_data(read_regular(path, MOST_BYTES))
        return (
            f"process {holder['process']:d} on {str(holder['host'])[:64]}, since {str(holder['since'])[:32]}"
        )
    except (OSError, ValueError, KeyError, TypeError):
        return None
