"""Standard output and standard error that never end a command: what is said does not decide what is done."""

from __future__ import annotations

import errno
import io
import os
import sys
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from bbsd.errors import inert

if TYPE_CHECKING:
    from collections.abc import Iterator


class Steady(io.TextIOBase):
    """A text stream that takes everything: after a first failure, of which it keeps the reason, nothing is shown.

    What it shows is inert.
    """

    def __init__(self, stream: TextIO) -> None:
        super().__init__()
        self._stream = stream
        self._begins_line = True
        self.failure: OSError | None = None

    def write(self, text: str, /) -> int:
        """Write a text; characters that steer a terminal, or that the encoding does not have, are escaped."""
        self.write_raw(inert(text, begins_line=self._begins_line))
        return len(text)

    def write_commands(self, text: str) -> None:
        """Write lines that are commands to what runs a job."""
        self.write_raw(inert(text, commands=True))

    def write_raw(self, text: str) -> None:
        """Write what steers a terminal on purpose."""
        if text:
            self._begins_line = text.endswith("\n")
        self._try(lambda: self._stream.write(text))

    def flush(self) -> None:
        """Write what is in the buffer."""
        self._try(self._stream.flush)

    def isatty(self) -> bool:
        """Return whether this is a terminal."""
        return self._stream.isatty()

    def fileno(self) -> int:
        """Return the number of the file."""
        return self._stream.fileno()

    def __getattribute__(self, name: str) -> Any:  # noqa: ANN401 - whatever the stream has
        # Of `TextIOBase`, only what is written here; `encoding` and `buffer` are the stream's.
        if name in {"encoding", "errors", "buffer", "newlines"}:
            return getattr(object.__getattribute__(self, "_stream"), name, None)
        return object.__getattribute__(self, name)

    def _try(self, action: Any) -> None:  # noqa: ANN401 - a call
        if self.failure is not None:
            return
        try:
            action()
        except OSError as error:
            self.failure = error
            self._discard()
        except ValueError as error:  # it was closed
            self.failure = OSError(errno.EBADF, str(error))

    def _discard(self) -> None:
        """Send what is still in the buffer to nowhere, when Python flushes it at exit."""
        with suppress(OSError, ValueError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self._stream.fileno())
            os.close(nowhere)


class Raw(io.TextIOBase):
    """The same stream for what draws on a terminal: its texts must be inert before."""

    def __init__(self, stream: Steady) -> None:
        super().__init__()
        self._stream = stream

    def write(self, text: str, /) -> int:
        """Write a text as it is."""
        self._stream.write_raw(text)
        return len(text)

    def flush(self) -> None:
        """Write what is in the buffer."""
        self._stream.flush()

    def isatty(self) -> bool:
        """Return whether this is a terminal."""
        return self._stream.isatty()

    def fileno(self) -> int:
        """Return the number of the file."""
        return self._stream.fileno()

    @property
    def encoding(self) -> str:  # type: ignore[override]  # of a writable attribute
        """The encoding of the stream."""
        return self._stream.encoding or "utf-8"


@contextmanager
def steady_streams() -> Iterator[Steady]:
    """Put steady streams in the place of standard output and error, and give the former.

    Numbers 0 to 2 that were closed lead to nowhere, so that no file that is opened later gets one of them.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    before = sys.stdout, sys.stderr
    with Path(os.devnull).open("w", encoding="utf-8") as nowhere:
        # A stream is None where it was closed when Python began.
        output, notes = (_steady(nowhere if stream is None else stream) for stream in before)
        sys.stdout, sys.stderr = output, notes
        try:
            yield output
        finally:
            output.flush()
            notes.flush()
            sys.stdout, sys.stderr = before


def _steady(stream: TextIO) -> Steady:
    if isinstance(stream, io.TextIOWrapper):
        stream.reconfigure(errors="backslashreplace")  # such as block characters in ASCII
    return Steady(stream)
