"""`bbsd fmt`."""

from difflib import unified_diff
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from bbsd.cli.mistakes import show_mistake
from bbsd.cli.options import spec_files
from bbsd.cli.output import say, show
from bbsd.errors import SpecError, escape

if TYPE_CHECKING:
    from bbsd.text import Source

WOULD_CHANGE = 1
"""The exit code of --check where a file is not in the house's style."""


def fmt(
    specs: Annotated[
        list[Path],
        typer.Argument(
            metavar="SPEC...", help="Specs, YAML files.", show_default=False, autocompletion=spec_files
        ),
    ],
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; leave with 1 if a file would change.")
    ] = False,
    diff: Annotated[
        bool, typer.Option("--diff", help="Write nothing; print what would change as a diff.")
    ] = False,
) -> None:
    """Put specs in the house's style: blanks, blank lines and quotes.

    What a file says stays the same, and its comments and its order are kept.
    """
    codes = [_formatted(spec, check=check, diff=diff) for spec in specs]
    if code := max(codes):
        raise typer.Exit(code)


def _formatted(spec: Path, *, check: bool, diff: bool) -> int:
    """Put one file in the style and return the exit code for it."""
    from bbsd.text import Source

    try:
        source = Source.read(spec)
        styled = _styled(source)
    except SpecError as error:
        return show_mistake(error)
    if styled == source.text:
        return 0
    if diff:
        show(_diff(source, styled))
    if check:
        say(f"{escape(str(spec))} is not in the style")
    elif not diff:
        spec.write_text(styled, encoding="utf-8", newline="")
        say(f"{escape(str(spec))} is in the style now")
    return WOULD_CHANGE if check else 0


def _styled(source: "Source") -> str:
    from bbsd.text import read
    from bbsd.text.writing.house_style import in_house_style

    document = read(source)
    if document.diagnoses:
        raise SpecError(document.diagnoses, source)
    return in_house_style(document)


def _diff(source: "Source", styled: str) -> str:
    lines = unified_diff(
        source.text.splitlines(), styled.splitlines(), source.file, f"{source.file} in the style", lineterm=""
    )
    return "\n".join(escape(line) for line in lines)
