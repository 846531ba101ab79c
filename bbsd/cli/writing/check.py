"""`bbsd check`."""

import sys
from enum import Enum, StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from bbsd.cli.options import AsJson, spec_files
from bbsd.cli.terminal.mistakes import MISTAKE
from bbsd.cli.terminal.output import diff_text, has_color, say, show, show_commands
from bbsd.errors import SpecError, did_you_mean

if TYPE_CHECKING:
    from bbsd.language.fixing import Made
    from bbsd.report.spec.checked import Checked
    from bbsd.text import Source


class MistakeFormat(StrEnum):
    """How mistakes are printed: for people, for programs, beside the lines of a pull request, for code scanning."""

    TEXT = "text"
    JSON = "json"
    GITHUB = "github"
    SARIF = "sarif"


class Fixing(Enum):
    """What becomes of corrections: nothing, shown, written."""

    NO = "no"
    SHOWN = "shown"
    WRITTEN = "written"


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
    as_json: AsJson = False,
    strict: Annotated[
        bool, typer.Option("--strict", help="Exit with code 2 if there are warnings too.")
    ] = False,
    every_hole: Annotated[
        bool,
        typer.Option(
            "--open", help="List all cells and layers that are open to design, not the first alone."
        ),
    ] = False,
    fix: Annotated[bool, typer.Option("--fix", help="Correct in the files what has one reading.")] = False,
    diff: Annotated[
        bool, typer.Option("--diff", help="With --fix: write nothing; print the corrections as a diff.")
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
    """Report all mistakes in specs, and what is probably not meant.

    Each is told at its line and column. Says which cells and layers are open to design.
    Exits with code 2 if there are mistakes, with --fix if some remain; warnings alone change the code with --strict.
    """
    if diff and not fix:
        raise typer.BadParameter("--diff shows what --fix would change; give both")
    if code is not None:
        show(_description(code))
    elif specs:
        fixing = Fixing.NO if not fix else Fixing.SHOWN if diff else Fixing.WRITTEN
        _check(specs, MistakeFormat.JSON if as_json else form, fixing, strict=strict, every_hole=every_hole)
    else:
        raise typer.BadParameter("give a SPEC, or --describe CODE")


def _check(specs: list[Path], form: MistakeFormat, fixing: Fixing, *, strict: bool, every_hole: bool) -> None:
    from bbsd.report.spec.checked import checked_plain, checked_text

    checked = [_checked(spec, fixing) for spec in specs]
    diagnoses = [diagnosis for each in checked for diagnosis in each.diagnoses]
    match form:
        case MistakeFormat.TEXT:
            color = has_color(sys.stdout)
            texts = [checked_text(each, color=color, strict=strict, whole=every_hole) for each in checked]
            # Beside a diff, which programs read, what is said of the specs is for people.
            (say if fixing is Fixing.SHOWN else show)("\n".join(texts))
        case MistakeFormat.JSON:
            from bbsd.report.plain import json_text

            show(json_text(checked_plain(checked)))
        case MistakeFormat.GITHUB:
            from bbsd.report.spec.github import github_text

            show_commands(github_text(diagnoses))
        case MistakeFormat.SARIF:
            from bbsd.report.plain import json_text
            from bbsd.report.spec.sarif import sarif_log

            show(json_text(sarif_log(diagnoses)))
    if any(each.meaning is None for each in checked) or (strict and diagnoses):
        raise typer.Exit(MISTAKE)


def _checked(spec: Path, fixing: Fixing) -> "Checked":
    from bbsd.api.specs import load
    from bbsd.language.loading import load as load_source
    from bbsd.report.spec.checked import Checked

    made: tuple[Made, ...] = ()
    is_written = fixing is not Fixing.SHOWN
    try:
        if fixing is Fixing.NO:
            loaded = load(spec)
        else:
            source, made = _fixed(spec, fixing)
            loaded = load_source(source)
    except SpecError as error:
        return Checked(str(spec), error.diagnoses, error, None, made, is_written)
    return Checked(str(spec), loaded.warnings, loaded.lineage.error(()), loaded.meaning, made, is_written)


def _fixed(spec: Path, fixing: Fixing) -> "tuple[Source, tuple[Made, ...]]":
    """Return a spec's text after its corrections, and these; write it, or show how it differs."""
    from bbsd.language.fixing import fixed
    from bbsd.text import Source
    from bbsd.text.source import BYTE_ORDER_MARK

    source = Source.read(spec)
    result = fixed(source)
    if result.source.text == source.text:
        return source, ()
    if fixing is Fixing.SHOWN:
        show(diff_text(source.file, source.text, result.source.text, "corrected"))
    else:
        has_mark = spec.read_bytes().startswith(BYTE_ORDER_MARK.encode())
        text = BYTE_ORDER_MARK * has_mark + result.source.text
        from bbsd.runs.storage.lock import write_result_text

        write_result_text(spec, text)
    return result.source, result.made


def _description(code: str) -> str:
    from bbsd.errors.catalog import KINDS, describe

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
