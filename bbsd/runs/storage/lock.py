"""One writer at a time in a run's folder."""

from __future__ import annotations

import errno
import json
import os
import platform
import time
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from bbsd.errors import UsageError
from bbsd.files import NO_FOLLOW, errors_name, read_regular, write_all
from bbsd.runs.storage.finished import LOCK
from bbsd.runs.storage.reading import plain_data

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from bbsd.runs.storage.folder import Folder

HELD = (errno.EWOULDBLOCK, errno.EAGAIN, errno.EACCES)
"""The reasons of a refusal when another process has the lock."""
MOST_BYTES = 1000
"""Bytes of the file that are read: it names one process."""
LOOKS, BETWEEN_LOOKS = 10, 0.02
"""How often the file is read until it names a process, and the seconds between."""


class FolderInUse(UsageError):
    """Another process writes in the folder."""

    advice = "wait until it has ended, or stop it; it can then be continued with --resume"


@contextmanager
def only_writer(folder: Folder) -> Iterator[None]:
    """Hold the lock of a folder, which the system frees when this process ends, however it ends.

    Raises:
        FolderInUse: another process holds it; the message names the process.
    """
    path = folder.path / LOCK
    with errors_name(path):  # a link would lead to a file that is none of the folder's
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT | NO_FOLLOW, 0o666)
    try:
        if not _locked(descriptor):
            raise FolderInUse(f"{folder.path} is being written by {holder_text(path)}")
        with errors_name(path):
            os.ftruncate(descriptor, 0)
            write_all(descriptor, _who().encode())
        try:
            yield
        finally:
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
