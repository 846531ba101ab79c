"""The one place where regular files are written: whole or not at all, and on the disk when the call returns.

Records of runs are read here too, so that a pipe of a record's name is not waited for.
"""

from __future__ import annotations

import errno
import os
import stat
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

NO_FOLLOW = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)


def write_whole(path: Path, content: bytes, *, through_links: bool = False) -> None:
    """Write a file so that after a kill or a power failure it has either its old content or the new one.

    The mode of a file that is there is kept. Pipes and devices are written directly.

    Args:
        path: The file.
        content: All that it is to hold.
        through_links: Write the file that a link leads to; by default a link is refused.

    Raises:
        OSError: the file cannot be written; it names the file.
    """
    with errors_name(path):
        if through_links:
            path = path.resolve()
        before = _stat(path)
        if before is not None and stat.S_ISLNK(before.st_mode):
            raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
        if before is not None and not stat.S_ISREG(before.st_mode):
            with path.open("wb", buffering=0) as stream:
                write_all(stream.fileno(), content)
            return
        _replace(path, content, 0o666 if before is None else stat.S_IMODE(before.st_mode), before is not None)


def write_text_whole(path: Path, text: str, *, through_links: bool = False) -> None:
    """Write a text as UTF-8 with its own line ends, as `write_whole` does."""
    write_whole(path, text.encode(), through_links=through_links)


def read_regular(path: Path, most: int = -1) -> bytes:
    """Return the content of a regular file, or its first bytes.

    Raises:
        OSError: there is none, or a folder, a pipe or a device has its name; it names the file.
    """
    with errors_name(path):
        flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
        with os.fdopen(os.open(path, flags | getattr(os, "O_CLOEXEC", 0)), "rb") as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise OSError(errno.EINVAL, "it is no regular file")
            return file.read(most)


def _stat(path: Path) -> os.stat_result | None:
    try:
        return path.lstat()
    except FileNotFoundError:
        return None


def _replace(path: Path, content: bytes, mode: int, keep_mode: bool) -> None:
    part = path.with_name(f".{path.name}.{os.urandom(4).hex()}.part")
    descriptor = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL | NO_FOLLOW, mode)
    try:
        try:
            write_all(descriptor, content)
            if keep_mode and hasattr(os, "fchmod"):
                os.fchmod(descriptor, mode)
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
        os.replace(part, path)  # noqa: PTH105 - the module's function, which tests replace
    except BaseException:
        with suppress(OSError):
            part.unlink()
        raise
    sync_folder(path.parent)


def move(source: Path, target: Path) -> None:
    """Give a file another name in its folder, in place of what has it."""
    with errors_name(target):
        os.replace(source, target)  # noqa: PTH105 - as above


def make_folder(path: Path) -> bool:
    """Make a folder in one that is there, and return True; False if it is there already."""
    with errors_name(path):
        try:
            os.mkdir(path)  # noqa: PTH102 - as above
        except FileExistsError:
            if path.is_dir():
                return False
            raise
        sync_folder(path.parent)
    return True


def write_all(descriptor: int, content: bytes) -> None:
    """Write all bytes to a descriptor, in as many calls as it takes."""
    rest = memoryview(content)
    while rest:
        rest = rest[os.write(descriptor, rest) :]


def sync_folder(path: Path) -> None:
    """Let the names in a folder reach the disk, where the system can do so."""
    if os.name == "nt":
        return
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


@contextmanager
def errors_name(path: Path) -> Iterator[None]:
    """Let an OSError of the system name the file that was to be written, whichever call failed."""
    try:
        yield
    except OSError as error:
        if error.filename == str(path):
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error
