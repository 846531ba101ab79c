"""Errors that a user can correct, shown without a traceback."""

import sys

from bbsd.cli.terminal.guidance import with_file
from bbsd.cli.terminal.output import has_color, say
from bbsd.errors import SpecError, UsageError, render_text

MISTAKE = 2
"""The exit code for a mistake that the user can correct."""


def show_mistake(error: Exception) -> int:
    """Show an error and return the exit code; raise it again if it is a bug of this program."""
    if isinstance(error, SpecError):
        say(diagnoses_text(error, color=has_color(sys.stderr)))
    elif isinstance(error, OSError):
        say(f"bbsd: {_os_text(error)}")
    elif isinstance(error, UsageError):
        say("\n      ".join([f"bbsd: {error}", *([with_file(error.advice)] if error.advice else [])]))
    else:
        raise error
    return MISTAKE


def diagnoses_text(error: SpecError, *, color: bool) -> str:
    """Return mistakes with their source lines, a blank line between them; warnings are for `bbsd check`."""
    return "\n\n".join(
        render_text(mistake, error.line(mistake.place), color, error.corrected_lines(mistake))
        for mistake in error.mistakes
    )


def _os_text(error: OSError) -> str:
    return f"{error.filename}: {error.strerror}" if error.filename else str(error)
