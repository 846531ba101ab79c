"""Where a command's words go."""

import errno
import os
import sys
from contextlib import suppress
from io import TextIOWrapper
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn, TextIO

if TYPE_CHECKING:
    from rich.console import Console, RenderableType


def show(text: str) -> None:
    """Print data. Where nobody reads on (`| head`), that is no mistake: the rest goes nowhere."""
    try:
        sys.stdout.write(text if text.endswith("\n") or not text else text + "\n")
        sys.stdout.flush()
    except BrokenPipeError:
        _discard(sys.stdout)


def say(text: str) -> None:
    """Print a remark."""
    try:
        sys.stderr.write(text + "\n")
    except BrokenPipeError:
        _discard(sys.stderr)


def leave_now(code: int) -> NoReturn:
    """End the process without waiting for anything that it does."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError):
            stream.flush()
    os._exit(code)


def _discard(stream: TextIO) -> None:
    """Let what is still in a stream's buffer go nowhere when Python flushes it at its end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def show_table(table: "RenderableType") -> None:
    """Print a table, as wide as its terminal, without color where that is not wanted."""
    console = _console(sys.stdout)
    with console.capture() as capture:
        console.print(table, crop=False)
    show("\n".join(line.rstrip() for line in capture.get().splitlines()))


def error_console() -> "Console":
    """Return the console of remarks."""
    return _console(sys.stderr)


def _console(stream: TextIO) -> "Console":
    from rich.console import Console

    return Console(file=stream, highlight=False, soft_wrap=False)


def never_fail_to_encode(*streams: TextIO) -> None:
    """Let streams write what their encoding does not have as escapes, such as block characters in ASCII."""
    for stream in streams:
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def has_blocks() -> bool:
    """Say whether standard output can show block characters."""
    return (sys.stdout.encoding or "").lower().startswith("utf")


def has_color(stream: TextIO) -> bool:
    """Say whether a stream is a terminal that shows colors, and they are wanted."""
    return stream.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


def require_writable_file(path: Path) -> None:
    """Raise OSError if no file can be written at a path, before time is spent on what it is to hold."""
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    folder = path.parent
    if not folder.is_dir():
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(folder))
    if not os.access(path if path.exists() else folder, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
