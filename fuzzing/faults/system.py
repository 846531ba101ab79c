"""The system's calls that change files below a folder: they are counted, and one of them fails or ends the process."""

from __future__ import annotations

import errno
import io
import os
import signal
from pathlib import Path
from threading import RLock
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from collections.abc import Callable

    Fault = Literal["none", "full", "broken", "kill", "power"]

FAULTS: tuple[Fault, ...] = ("full", "broken", "kill", "power")
"""The disk is full from now on; one call fails for the disk's sake; the process is killed; the machine loses power."""
BY_DESCRIPTOR = ("write", "fsync", "ftruncate", "fchmod")
BY_PATH = ("replace", "rename", "unlink", "mkdir")
NEEDS_ROOM = ("open", "write", "mkdir")
"""Calls that fail on a disk that is full."""
WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT


class System:
    """Counts the calls of this process; the call of a number has a fault."""

    def __init__(self, root: Path, fault: Fault = "none", number: int = 0, log: Path | None = None) -> None:
        self._root, self._fault, self._number, self._log = str(root), fault, number, log
        self._calls: list[str] = []
        self._paths: dict[int, str] = {}
        self._on_disk: dict[str, int] = {}
        """How much of each file has reached the disk."""
        self._one_at_a_time = RLock()  # else power could go between a thread's call and the note of it

    def install(self) -> None:
        """Take the place of the system's functions in this process."""
        self._real = {name: getattr(os, name) for name in ("open", "close", *BY_DESCRIPTOR, *BY_PATH)}
        for name in BY_DESCRIPTOR:
            setattr(os, name, self._by_descriptor(name))
        for name in BY_PATH:
            setattr(os, name, self._by_path(name))
        vars(os).update(open=self._open, close=self._close)
        self._real_stream = io.open
        vars(io)["open"] = self._stream

    def _mine(self, path: Any) -> bool:  # noqa: ANN401
        return not isinstance(path, int) and os.fspath(path).startswith(self._root)

    def _open(self, path: Any, flags: int, *arguments: Any, **options: Any) -> int:  # noqa: ANN401
        if not self._mine(path):
            return int(self._real["open"](path, flags, *arguments, **options))
        with self._one_at_a_time:
            size = os.stat(path).st_size if os.path.isfile(path) else 0  # noqa: PTH113, PTH116
            self._called("open" if flags & WRITES else "open to read", str(path))
            descriptor: int = self._real["open"](path, flags, *arguments, **options)
            self._paths[descriptor] = str(path)
            if flags & WRITES:
                self._on_disk.setdefault(str(path), size)
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
            return result

        return call

    def _by_path(self, name: str) -> Callable[..., Any]:
        real = self._real[name]

        def call(path: Any, *arguments: Any, **options: Any) -> Any:  # noqa: ANN401
            if not self._mine(path):
                return real(path, *arguments, **options)
            with self._one_at_a_time:
                self._called(name, str(path))
                result = real(path, *arguments, **options)
                if name in ("replace", "rename"):
                    self._on_disk[str(arguments[0])] = self._on_disk.pop(
                        str(path),
                        os.stat(arguments[0]).st_size,  # noqa: PTH116
                    )
                elif name == "unlink":
                    self._on_disk.pop(str(path), None)
            return result

        return call

    def _called(self, name: str, path: str, half: Callable[[], object] | None = None) -> None:
        """Count a call; where it is its turn, do half of it and fail, or end."""
        self._calls.append(f"{name} {path}")
        number = len(self._calls)
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
        if self._fault == "power":
            for file, size in self._on_disk.items():
                if os.path.isfile(file) and os.stat(file).st_size > size:  # noqa: PTH113, PTH116
                    os.truncate(file, size)
        os.kill(os.getpid(), signal.SIGKILL)

    @staticmethod
    def _error(number: int, name: str, path: str) -> OSError:
        """Return the error as the system gives it: what was called with a descriptor does not name the file."""
        return OSError(number, os.strerror(number), *([] if name in BY_DESCRIPTOR else [path]))
