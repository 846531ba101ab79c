"""`bbsd check`."""

import sys
from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from bbsd.cli.options import spec_files
from bbsd.cli.terminal.mistakes import MISTAKE, diagnoses_text
from bbsd.cli.terminal.output import has_color, show, show_commands
from bbsd.errors import KINDS, Diagnosis, SpecError, describe, did_you_mean, escape, render_json
from bbsd.report.numbers import count
from bbsd.report.plain import json_text


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
    code: Annotated[
        str | None,
        typer.Option(
            "--describe", metavar="CODE", help="Describe a kind of mistake, such as BB006, and exit."
        ),
    ] = None,
) -> None:
    """Report all mistakes in specs, each at its line and column.

    Exits with code 2 if there are any.
    """
    if code is not None:
        show(_description(code))
    elif specs:
        _check(specs, form)
    else:
        raise typer.BadParameter("give a SPEC, or --describe CODE")


def _check(specs: list[Path], form: MistakeFormat) -> None:
    results = [(spec, *_size_or_error(spec)) for spec in specs]
    errors = [error for _, _, error in results if error]
    if form is MistakeFormat.TEXT:
        show("\n".join(_verdict(*result) for result in results))
    else:
        text = _machine_text([diagnosis for error in errors for diagnosis in error.diagnoses], form)
        (show_commands if form is MistakeFormat.GITHUB else show)(text)
    if errors:
        raise typer.Exit(MISTAKE)


def _machine_text(diagnoses: Sequence[Diagnosis], form: MistakeFormat) -> str:
    from bbsd.report.github import github_text
    from bbsd.report.sarif import sarif_log

    if form is MistakeFormat.GITHUB:
        return github_text(diagnoses)
    return json_text(sarif_log(diagnoses) if form is MistakeFormat.SARIF else render_json(diagnoses))


def _size_or_error(spec: Path) -> tuple[str, SpecError | None]:
    """Return the size of a spec in words and None, or "" and its mistakes."""
    from bbsd.api.specs import load
    from bbsd.report.size import size_text

    try:
        return size_text(load(spec).meaning), None
    except SpecError as error:
        return "", error


def _verdict(spec: Path, size: str, error: SpecError | None) -> str:
    if error is None:
        return f"{escape(str(spec))}: ok ({size})"
    diagnoses = diagnoses_text(error, color=has_color(sys.stdout))
    return f"{diagnoses}\n\n{count(len(error.diagnoses), 'mistake')} in {escape(str(spec))}"


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
