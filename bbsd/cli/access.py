"""What a command may import for a spec's environment, as the verbs take it."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypedDict

from bbsd.cli.output import say
from bbsd.errors import escape


class Access(TypedDict):
    """How the environment of a spec may be opened, where its world is one that is stepped in Python."""

    allow_import: Sequence[str]
    import_from: Sequence[Path]
    step_limit: float
    announce: Callable[[str, str], None]


def access(allow_import: list[str] | None, import_from: list[Path] | None, step_limit: float) -> Access:
    """Return the arguments of a verb that the options of a command are."""
    return Access(
        allow_import=allow_import or (),
        import_from=import_from or (),
        step_limit=step_limit,
        announce=_announce,
    )


def _announce(module: str, file: str) -> None:
    """Print a note that a module is imported, and where it lies."""
    say(f"importing {escape(module)} from {escape(file)}")
