"""`bbsd check`."""

import sys
from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from bbsd.cli.mistakes import MISTAKE, diagnoses_text
from bbsd.cli.options import spec_files
from bbsd.cli.output import has_color, show
from bbsd.errors import KINDS, Diagnosis, SpecError, describe, did_you_mean, render_json
from bbsd.report.numbers import count
from bbsd.report.plain import json_text


class MistakeFormat(StrEnum):
    """How mistakes are printed: for people, for programs, beside a pull request's lines, for code scanning."""

    TEXT = "text"
    JSON = "json"
    GITHUB = "github"
    SARIF = "sarif"


def check(
    specs: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="SPEC...", help="Specs, YAML files.", show_default=False, autocompletion=spec_files
        ),
    ] = None,
    form: Annotated[MistakeFormat, typer.Option("--format", help="How to print it.")] = MistakeFormat.TEXT,
    code: Annotated[
        str | None,
        typer.Option("--describe", metavar="CODE", help="Describe a kind of mistake, such as BB006."),
    ] = None,
) -> None:
    """Say all that is wrong with specs.

    Leaves with 2 if anything is.
    """
    if code is not None:
        show(_described(code))
    elif specs:
        _check(specs, form)
    else:
        raise typer.BadParameter("give a SPEC, or --describe CODE")


def _check(specs: list[Path], form: MistakeFormat) -> None:
    found = [(spec, *_checked(spec)) for spec in specs]
    errors = [error for _, _, error in found if error]
    if form is MistakeFormat.TEXT:
        show("\n".join(_verdict(*each) for each in found))
    else:
        show(_machine_text([each for error in errors for each in error.diagnoses], form))
    if errors:
        raise typer.Exit(MISTAKE)


def _machine_text(diagnoses: Sequence[Diagnosis], form: MistakeFormat) -> str:
    from bbsd.report.github import github_text
    from bbsd.report.sarif import sarif_log

    if form is MistakeFormat.GITHUB:
        return github_text(diagnoses)
    return json_text(sarif_log(diagnoses) if form is MistakeFormat.SARIF else render_json(diagnoses))


def _checked(spec: Path) -> tuple[str, SpecError | None]:
    """Return how large the spec is, or what is wrong with it."""
    from bbsd.language.loading import load
    from bbsd.report.size import size_text
    from bbsd.text import Source

    try:
        return size_text(load(Source.read(spec)).meaning), None
    except SpecError as error:
        return "", error


def _verdict(spec: Path, size: str, error: SpecError | None) -> str:
    if error is None:
        return f"{spec}: ok ({size})"
    diagnoses = diagnoses_text(error, color=has_color(sys.stdout))
    return f"{diagnoses}\n\n{count(len(error.diagnoses), 'mistake')} in {spec}"


def _described(code: str) -> str:
    try:
        kind = describe(code)
    except KeyError:
        raise typer.BadParameter(f"there is no code {code}{did_you_mean(code.upper(), KINDS)}") from None
    parts = [
        f"{kind.code}: {kind.title}",
        kind.explanation,
        f"Such as:\n\n{_indented(kind.example)}",
        f"Instead:\n\n{_indented(kind.mend)}",
    ]
    return "\n\n".join(parts)


def _indented(text: str) -> str:
    return "\n".join(f"    {line}" for line in text.splitlines())
