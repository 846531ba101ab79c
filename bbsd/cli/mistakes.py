"""Errors that a user can mend, told without a traceback."""

import sys
from collections.abc import Iterable

from bbsd.cli.output import has_color, say
from bbsd.errors import Diagnosis, Lines, SpecError, render_text

MISTAKE = 2
"""The exit code for what the user gave and can mend."""


def told(error: Exception) -> int:
    """Tell of an error and return the exit code; one that is our own mistake is raised again."""
    if isinstance(error, SpecError):
        say(diagnoses_text(error.diagnoses, error.source, color=has_color(sys.stderr)))
    elif isinstance(error, OSError):
        say(f"bbsd: {_os_text(error)}")
    elif isinstance(error, _mendable()):
        say(f"bbsd: {error}{_advice(error)}")
    else:
        raise error
    return MISTAKE


def diagnoses_text(diagnoses: Iterable[Diagnosis], source: Lines, *, color: bool) -> str:
    """Return diagnoses with their source lines, a blank line between them."""
    return "\n\n".join(render_text(each, source.line(each.place.line), color) for each in diagnoses)


def _os_text(error: OSError) -> str:
    return f"{error.filename}: {error.strerror}" if error.filename else str(error)


def _advice(error: Exception) -> str:
    from bbsd.architecture import HolesLeft

    if not isinstance(error, HolesLeft):
        return ""
    return "\n      have it designed: bbsd design; or measure random agents: bbsd evaluate --fill random"


def _mendable() -> tuple[type[Exception], ...]:
    """Return the errors whose messages are written for users; who raises them has imported their modules."""
    from bbsd.api import NothingToDesign
    from bbsd.architecture import HolesLeft
    from bbsd.evaluation import NotEnumerable
    from bbsd.report.figures import FigureError
    from bbsd.solver.folder import FolderError

    return FigureError, FolderError, HolesLeft, NotEnumerable, NothingToDesign
