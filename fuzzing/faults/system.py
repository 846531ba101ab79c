"""The system's calls that change files below a folder: they are counted, and one of them fails or ends the process."""

from __future__ import annotations

import errno
import io
import os
import shutil
import signal
from functools import partial
from pathlib import Path
from threading import RLock
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from collections.abc import Callable

    Fault = Literal["none", "full", "broken", "kill", "power", "names"]

FAULTS: tuple[Fault, ...] = ("full", "broken", "kill", "power", "names")
"""The disk is full from now on; one call fails for the disk's sake; the process is killed; the machine loses power,
and bytes that were not brought to the disk; or names too that were not brought there with their folder.
"""
BY_DESCRIPTOR = ("write", "fsync", "ftruncate", "fchmod")
BY_PATH = ("replace", "rename", "unlink", "mkdir")
NEEDS_ROOM = ("open", "write", "mkdir")
"""Calls that fail on a disk that is full."""
WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT


class System:
    """Counts the calls of this process; the call of a number has a fault."""

    def __init__(self, root: Path, fault: Fault = "none", number: int = 0, log: Path | None = None) -> None:
        self._root, self._fault, self._number, self._log = str(root), fault, number, log
        self.calls: list[str] = []
        """What was called, and with which path."""
        self._paths: dict[int, str] = {}
        self._on_disk: dict[str, int] = {}
        """How much of each file has reached the disk."""
        self._changes: list[tuple[str, Callable[[], object]]] = []
        """The folders whose names have changed since they reached the disk, and what takes each change back."""
        self._kept = Path(f"{root}.kept")
        """Files that have lost their name, by the number of the call."""
        self._one_at_a_time = RLock()  # else power could go between a thread's call and the note of it

    def install(self) -> None:
        """Take the place of the system's functions in this process."""
        if self._fault == "names":
            shutil.rmtree(self._kept, ignore_errors=True)
            self._kept.mkdir()
        self._real = {name: getattr(os, name) for name in ("open", "close", *BY_DESCRIPTOR, *BY_PATH)}
        for name in BY_DESCRIPTOR:
            setattr(os, name, self._by_descriptor(name))
        for name in BY_PATH:
            setattr(os, name, self._by_path(name))
        vars(os).update(open=self._open, close=self._close)
        self._real_stream = io.open
        vars(io)["open"] = self._stream

    def _mine(self, path: Any) -> bool:  # noqa: ANN401
        """Return whether a path is the folder, below it, or the one that has its name."""
        if isinstance(path, int):
            return False
        return str(path) == os.path.dirname(self._root) or str(path).startswith(self._root)  # noqa: PTH120

    def _open(self, path: Any, flags: int, *arguments: Any, **options: Any) -> int:  # noqa: ANN401
        if not self._mine(path):
            descriptor = int(self._real["open"](path, flags, *arguments, **options))
            self._paths.pop(descriptor, None)  # a stream may have closed what had the number before
            return descriptor
        with self._one_at_a_time:
            is_new = not os.path.lexists(path)
            size = os.stat(path).st_size if os.path.isfile(path) else 0  # noqa: PTH113, PTH116
            self._called("open" if flags & WRITES else "open to read", str(path))
            descriptor = int(self._real["open"](path, flags, *arguments, **options))
            self._paths[descriptor] = str(path)
            if flags & WRITES:
                self._on_disk.setdefault(str(path), size)
                if is_new:
                    self._changed(path, partial(self._real["unlink"], path))
            return descriptor

    def _close(self, descriptor: int) -> None:
        self._paths.pop(descriptor, None)
        self._real["close"](descriptor)

    def _stream(self, file: Any, mode: str = "r", *arguments: Any, **options: Any) -> Any:  # noqa: ANN401
        if self._mine(file) and set(mode) & set("wax+"):
            with self._one_at_a_time:
                self._called("open", str(file))
        return self._real_stream(file, mode, *arguments, **options)

    def _by_descriptor(self, name: str) -> Callable[..., Any]:
        real = self._real[name]

        def call(descriptor: int, *arguments: Any) -> Any:  # noqa: ANN401
            number = descriptor if isinstance(descriptor, int) else descriptor.fileno()
            path = self._paths.get(number)
            if path is None:
                return real(descriptor, *arguments)
            half = (
                (lambda: real(descriptor, arguments[0][: len(arguments[0]) // 2]))
                if name == "write"
                else None
            )
            with self._one_at_a_time:
                self._called(name, path, half)
                result = real(descriptor, *arguments)
                if name == "fsync" and path in self._on_disk:
                    self._on_disk[path] = os.fstat(number).st_size
                elif name == "fsync":
                    self._changes = [change for change in self._changes if change[0] != path]
            return result

        return call

    def _by_path(self, name: str) -> Callable[..., Any]:
        real = self._real[name]

        def call(path: Any, *arguments: Any, **options: Any) -> Any:  # noqa: ANN401
            if not self._mine(path):
                return real(path, *arguments, **options)
            with self._one_at_a_time:
                self._called(name, str(path))
                back = self._way_back(name, *map(str, (path, *arguments[:1])))
                result = real(path, *arguments, **options)
                if name in ("replace", "rename"):
                    self._on_disk[str(arguments[0])] = self._on_disk.pop(
                        str(path),
                        os.stat(arguments[0]).st_size,  # noqa: PTH116
                    )
                elif name == "unlink":
                    self._on_disk.pop(str(path), None)
                self._changed(path, back)
            return result

        return call

    def _changed(self, path: Any, back: Callable[[], object]) -> None:  # noqa: ANN401
        """Note how a change of a name can be taken back, before its folder has reached the disk."""
        if self._fault == "names":
            self._changes.append((str(Path(path).parent), back))

    def _way_back(self, name: str, path: str, target: str = "") -> Callable[[], object]:
        """Return what takes the change of a name back; a file that loses its name gets another one until then."""
        if self._fault != "names":
            return lambda: None
        if name == "mkdir":
            return partial(os.rmdir, path)
        lost = path if name == "unlink" else target
        kept = self._kept / str(len(self.calls))
        if os.path.lexists(lost):
            os.link(lost, kept)
        size = self._on_disk.get(lost, os.stat(kept).st_size if kept.exists() else 0)  # noqa: PTH116

        def back() -> None:
            if name != "unlink":
                self._real["replace"](target, path)
            if kept.exists():
                os.truncate(kept, size)
                self._real["replace"](kept, lost)

        return back

    def _called(self, name: str, path: str, half: Callable[[], object] | None = None) -> None:
        """Count a call; where it is its turn, do half of it and fail, or end."""
        self.calls.append(f"{name} {path}")
        number = len(self.calls)
        if self._log is not None:
            line = f"{name} {Path(path).name}\n".encode()
            descriptor = self._real["open"](self._log, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
            self._real["write"](descriptor, line)
            self._real["close"](descriptor)
        if self._fault == "full" and number > self._number and name in NEEDS_ROOM:
            raise self._error(errno.ENOSPC, name, path)
        if number != self._number:
            return
        if half is not None:
            half()
        if self._fault == "full":
            raise self._error(errno.ENOSPC, name, path)
        if self._fault == "broken":
            raise self._error(errno.EIO, name, path)
        if self._fault in ("power", "names"):
            for file, size in self._on_disk.items():
                if os.path.isfile(file) and os.stat(file).st_size > size:  # noqa: PTH113, PTH116
                    os.truncate(file, size)
            for _, take_back in reversed(self._changes):
                take_back()
        os.kill(os.getpid(), signal.SIGKILL)

    @staticmethod
    def _error(number: int, name: str, path: str) -> OSError:
        """Return the error as the system gives it: what was called with a descriptor does not name the file."""
        return OSError(number, os.strerror(number), *([] if name in BY_DESCRIPTOR else [path]))
