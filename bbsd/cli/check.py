"""`bbsd check`."""

import sys
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from bbsd.cli.options import spec_files
from bbsd.cli.terminal.mistakes import MISTAKE
from bbsd.cli.terminal.output import has_color, show, show_commands
from bbsd.errors import KINDS, SpecError, describe, did_you_mean
from bbsd.report.plain import json_text

if TYPE_CHECKING:
    from bbsd.report.checked import Checked


class MistakeFormat(StrEnum):
    """How mistakes are printed: for people, for programs, beside the lines of a pull request, for code scanning."""

    TEXT = "text"
    JSON = "json"
    GITHUB = "github"
    SARIF = "sarif"


def check(
    specs: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="SPEC...", help="Specs, as YAML files.", show_default=False, autocompletion=spec_files
        ),
    ] = None,
    form: Annotated[
        MistakeFormat, typer.Option("--format", help="Format of the output.")
    ] = MistakeFormat.TEXT,
    strict: Annotated[
        bool, typer.Option("--strict", help="Exit with code 2 if there are warnings too.")
    ] = False,
    code: Annotated[
        str | None,
        typer.Option(
            "--describe",
            metavar="CODE",
            help="Describe a kind of mistake or warning, such as BB006, and exit.",
        ),
    ] = None,
) -> None:
    """Report all mistakes in specs, each at its line and column, and what they probably do not mean to say.

    Exits with code 2 if there are mistakes; warnings alone change the code with --strict.
    """
    if code is not None:
        show(_description(code))
    elif specs:
        _check(specs, form, strict=strict)
    else:
        raise typer.BadParameter("give a SPEC, or --describe CODE")


def _check(specs: list[Path], form: MistakeFormat, *, strict: bool) -> None:
    from bbsd.report.checked import checked_plain, checked_text

    checked = [_checked(spec) for spec in specs]
    diagnoses = [diagnosis for each in checked for diagnosis in each.diagnoses]
    match form:
        case MistakeFormat.TEXT:
            color = has_color(sys.stdout)
            show("\n".join(checked_text(each, color=color, strict=strict) for each in checked))
        case MistakeFormat.JSON:
            show(json_text(checked_plain(checked)))
        case MistakeFormat.GITHUB:
            from bbsd.report.github import github_text

            show_commands(github_text(diagnoses))
        case MistakeFormat.SARIF:
            from bbsd.report.sarif import sarif_log

            show(json_text(sarif_log(diagnoses)))
    if any(each.meaning is None for each in checked) or (strict and diagnoses):
        raise typer.Exit(MISTAKE)


def _checked(spec: Path) -> "Checked":
    from bbsd.api.specs import load
    from bbsd.report.checked import Checked

    try:
        loaded = load(spec)
    except SpecError as error:
        return Checked(str(spec), error.diagnoses, error, None)
    return Checked(str(spec), loaded.warnings, loaded.lineage.error(()), loaded.meaning)


def _description(code: str) -> str:
    try:
        kind = describe(code)
    except KeyError:
        raise typer.BadParameter(f"there is no code {code}{did_you_mean(code.upper(), KINDS)}") from None
    parts = [
        f"{kind.code}: {kind.title}",
        kind.explanation,
        f"Example:\n\n{_indented(kind.example)}",
        f"Corrected:\n\n{_indented(kind.mend)}",
    ]
    return "\n\n".join(parts)


def _indented(text: str) -> str:
    return "\n".join(f"    {line}" for line in text.splitlines())
