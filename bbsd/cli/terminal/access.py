"""What a command may import for a spec's environment, as the verbs take it."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypedDict

from bbsd.cli.terminal.output import say
from bbsd.errors import escape


class Access(TypedDict):
    """How the environment of a spec may be opened, where its world is one that is stepped in Python."""

    allow_import: Sequence[str]
    import_from: Sequence[Path]
    step_limit: float
    announce: Callable[[str, str], None]


class Stepping(Access):
    """How it may be opened and stepped."""

    by_table: bool
    note: Callable[[str], None]


def access(allow_import: list[str] | None, import_from: list[Path] | None, step_limit: float) -> Access:
    """Return the arguments of a verb that the options of a command are."""
    return Access(
        allow_import=allow_import or (),
        import_from=import_from or (),
        step_limit=step_limit,
        announce=_announce,
    )


def stepping(
    allow_import: list[str] | None, import_from: list[Path] | None, step_limit: float, *, in_python: bool
) -> Stepping:
    """Return the arguments of a verb that runs episodes."""
    said = set[str]()

    def note(sentence: str) -> None:
        """Print a sentence on the environment, once."""
        if sentence not in said:
            said.add(sentence)
            say(sentence)

    return Stepping(**access(allow_import, import_from, step_limit), by_table=not in_python, note=note)


def _announce(module: str, file: str) -> None:
    """Print a note that a module is imported, and where it lies."""
    say(import_text(module, file))


def import_text(module: str, file: str) -> str:
    """Return the note on a module that is imported, and where it lies."""
    return f"importing {escape(module)} from {escape(file)}"
