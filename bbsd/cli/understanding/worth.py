"""`bbsd worth`."""

from enum import StrEnum
from typing import Annotated

import typer

import bbsd
from bbsd.cli.options import (
    AllowImport,
    AsJson,
    DesignFile,
    ImportFrom,
    InPython,
    Jobs,
    Lanes,
    Overrides,
    Seed,
    StepLimit,
)
from bbsd.cli.terminal.access import stepping
from bbsd.cli.terminal.output import show, show_table
from bbsd.report.plain import json_text


class WorthFormat(StrEnum):
    """How the worth of a design is printed."""

    TEXT = "text"
    JSON = "json"
    DOT = "dot"
    MERMAID = "mermaid"


def worth(
    spec: DesignFile,
    episodes: Annotated[
        int, typer.Option(metavar="N", min=2, help="Number of episodes of the design and of each change.")
    ] = 1000,
    seed: Seed = 0,
    overrides: Overrides = None,
    allow_import: AllowImport = None,
    import_from: ImportFrom = None,
    step_limit: StepLimit = 30.0,
    in_python: InPython = False,
    form: Annotated[
        WorthFormat,
        typer.Option(
            "--format",
            help="Format of the output; dot and mermaid draw what must stand above what, and nothing else.",
        ),
    ] = WorthFormat.TEXT,
    as_json: AsJson = False,
    lanes: Lanes = 40,
    jobs: Jobs = 1,
) -> None:
    """Measure what each behavior, layer and rule of a design is worth.

    Shows who is in control, what is earned meanwhile, and how the return changes in the same episodes when a behavior
    or a rule is dropped, a behavior is replaced at random, or layers are exchanged; and points out what is selfish,
    harmful or useless.
    """
    found = bbsd.worth(
        spec,
        episodes=episodes,
        seed=seed,
        lanes=lanes,
        jobs=jobs,
        set=overrides or (),
        **stepping(allow_import, import_from, step_limit, in_python=in_python),
    )
    from bbsd.report.worth import order_dot, order_mermaid, worth_plain, worth_table

    match WorthFormat.JSON if as_json else form:
        case WorthFormat.JSON:
            show(json_text(worth_plain(found)))
        case WorthFormat.DOT:
            show(order_dot(found))
        case WorthFormat.MERMAID:
            show(order_mermaid(found))
        case _:
            show_table(worth_table(found))
