"""`bbsd spaces`."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from bbsd.cli.options import (
    AllowImport,
    AsFormat,
    AsJson,
    ImportFrom,
    Overrides,
    ResultFormat,
    StepLimit,
    spec_files,
)
from bbsd.cli.terminal.access import access
from bbsd.cli.terminal.output import show

if TYPE_CHECKING:
    from bbsd.api import Spaces


def spaces(
    spec: Annotated[
        Path | None,
        typer.Argument(
            metavar="[SPEC]",
            help="A spec that names an environment stepped in Python; it need not be complete.",
            show_default=False,
            autocompletion=spec_files,
        ),
    ] = None,
    gymnasium: Annotated[
        str | None,
        typer.Option(metavar="ID", help="Instead of SPEC: a Gymnasium environment, as CartPole-v1."),
    ] = None,
    pettingzoo: Annotated[
        str | None,
        typer.Option(metavar="MODULE", help="Instead of SPEC: one of PettingZoo, as mpe2.simple_spread_v3."),
    ] = None,
    python: Annotated[
        str | None, typer.Option(metavar="MODULE:CLASS", help="Instead of SPEC: a class of your own.")
    ] = None,
    overrides: Overrides = None,
    allow_import: AllowImport = None,
    import_from: ImportFrom = None,
    step_limit: StepLimit = 30.0,
    form: AsFormat = ResultFormat.TEXT,
    as_json: AsJson = False,
) -> None:
    """Show what an environment stepped in Python observes and takes.

    Prints the block `environment` of a spec with a name for each number, ready to paste. Where SPEC says what it
    observes and sends, it is compared with that.
    """
    if (spec is not None) + sum(each is not None for each in (gymnasium, pettingzoo, python)) != 1:
        raise typer.BadParameter("give SPEC, or one of --gymnasium, --pettingzoo and --python")
    from bbsd import api

    found = api.spaces(
        spec,
        gymnasium=gymnasium,
        pettingzoo=pettingzoo,
        python=python,
        set=overrides or (),
        **access(allow_import, import_from, step_limit),
    )
    _show(found, as_json=as_json or form is ResultFormat.JSON)
    if found.mistakes is not None:
        raise found.mistakes


def _show(found: "Spaces", *, as_json: bool) -> None:
    from bbsd.report.plain import json_text
    from bbsd.report.spec.spaces import spaces_plain, spaces_text

    show(json_text(spaces_plain(found)) if as_json else spaces_text(found))
