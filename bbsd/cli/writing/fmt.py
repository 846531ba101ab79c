"""`bbsd fmt`."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from bbsd.cli.options import spec_files
from bbsd.cli.terminal.mistakes import show_mistake
from bbsd.cli.terminal.output import diff_text, say, show
from bbsd.errors import SpecError, escape
from bbsd.runs.storage.lock import write_result_text

if TYPE_CHECKING:
    from bbsd.text import Source

WOULD_CHANGE = 1
"""The exit code of --check if a file is not formatted."""


def fmt(
    specs: Annotated[
        list[Path],
        typer.Argument(
            metavar="SPEC...", help="Specs, as YAML files.", show_default=False, autocompletion=spec_files
        ),
    ],
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; exit with code 1 if a file would change.")
    ] = False,
    diff: Annotated[bool, typer.Option("--diff", help="Write nothing; print the changes as a diff.")] = False,
) -> None:
    """Format specs in one style.

    Indentation, spaces, blank lines and quotes. The data of a file, its comments and its order stay the same.
    """
    codes = [_format(spec, check=check, diff=diff) for spec in specs]
    if code := max(codes):
        raise typer.Exit(code)


def _format(spec: Path, *, check: bool, diff: bool) -> int:
    """Format one file and return the exit code for it."""
    from bbsd.runs.storage.finished import design_file
    from bbsd.text import Source

    try:
        spec = design_file(spec)
        source = Source.read(spec)
        formatted = _formatted_text(source)
    except SpecError as error:
        return show_mistake(error)
    if formatted == source.text:
        return 0
    if diff:
        show(diff_text(source.file, source.text, formatted, "formatted"))
    if check:
        say(f"{escape(str(spec))} is not formatted")
    elif not diff:
        write_result_text(spec, formatted)
        say(f"formatted {escape(str(spec))}")
    return WOULD_CHANGE if check else 0


def _formatted_text(source: "Source") -> str:
    from bbsd.text import read
    from bbsd.text.writing.house_style import in_house_style

    document = read(source)
    if document.diagnoses:
        raise SpecError(document.diagnoses, source)
    return in_house_style(document)
