"""Output of the commands: results, notes and tables."""

import errno
import os
import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn, TextIO, cast

from bbsd.cli.terminal.streams import Raw, Steady
from bbsd.errors import escape

if TYPE_CHECKING:
    from rich.console import Console, RenderableType


def show(text: str) -> None:
    """Print a result to standard output."""
    sys.stdout.write(text if text.endswith("\n") or not text else text + "\n")
    sys.stdout.flush()


def show_commands(text: str) -> None:
    """Print commands to what runs a job, such as GitHub's, to standard output."""
    write = sys.stdout.write_commands if isinstance(sys.stdout, Steady) else sys.stdout.write
    write(text if text.endswith("\n") or not text else text + "\n")


def say(text: str) -> None:
    """Print a note to standard error."""
    sys.stderr.write(text + "\n")


def leave_now(code: int) -> NoReturn:
    """End the process without waiting for its threads."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError):
            stream.flush()
    os._exit(code)


def diff_text(file: str, before: str, after: str, what: str) -> str:
    """Return how a file differs from its text after a change, as a unified diff; `what` says what the change is."""
    from difflib import unified_diff

    lines = unified_diff(before.splitlines(), after.splitlines(), file, f"{file} {what}", lineterm="")
    return "\n".join(escape(line) for line in lines)


def show_table(table: "RenderableType") -> None:
    """Print a table as wide as its terminal, without color if that is not wanted."""
    console = _console(sys.stdout)
    with console.capture() as capture:
        console.print(table, crop=False)
    show("\n".join(line.rstrip() for line in capture.get().splitlines()))


def output_console() -> "Console":
    """Return the console of standard output."""
    return _console(sys.stdout)


def error_console() -> "Console":
    """Return the console of standard error."""
    return _console(sys.stderr)


def _console(stream: TextIO) -> "Console":
    from rich.console import Console

    drawn_on = Raw(stream) if isinstance(stream, Steady) else stream
    return Console(file=cast("TextIO", drawn_on), highlight=False, soft_wrap=False)


def has_blocks() -> bool:
    """Return whether standard output can show block characters."""
    return (sys.stdout.encoding or "").lower().startswith("utf")


def has_color(stream: TextIO) -> bool:
    """Return whether a stream is a terminal that shows colors, and they are wanted."""
    return stream.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


def require_writable_file(path: Path) -> None:
    """Find out whether a file can be written at a path before time is spent on its content.

    Raises:
        OSError: it cannot.
        FileInFolderInUse: it is in the folder of a run that another process writes.
    """
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    folder = path.parent
    if not folder.is_dir():
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(folder))
    if not os.access(path if path.exists() else folder, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
    from bbsd.runs.storage.lock import writer_of

    with writer_of(path):
        pass
