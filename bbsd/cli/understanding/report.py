"""`bbsd report`."""

from pathlib import Path
from typing import Annotated

import typer

import bbsd
from bbsd.cli.options import (
    AllowImport,
    DesignFile,
    ImportFrom,
    InPython,
    Overrides,
    Seed,
    StepLimit,
    spec_files,
)
from bbsd.cli.terminal.access import stepping
from bbsd.cli.terminal.output import error_console, require_writable_file, show
from bbsd.errors import escape
from bbsd.runs.storage.lock import write_result_text


def report(
    design: DesignFile,
    other: Annotated[
        Path | None,
        typer.Argument(
            metavar="[OTHER]",
            help="Another design, to compare the first one with.",
            show_default=False,
            autocompletion=spec_files,
        ),
    ] = None,
    output: Annotated[
        Path, typer.Option("-o", "--out", "--output", metavar="PAGE.html", help="The file of the page.")
    ] = Path("page.html"),
    episodes: Annotated[int, typer.Option(metavar="N", min=1, help="Number of episodes.")] = 1000,
    faults: Annotated[
        list[str] | None,
        typer.Option(
            "--fault",
            metavar="FAULT",
            help="Evaluate under a fault too, such as robot=1:dead; may be repeated.",
            show_default=False,
        ),
    ] = None,
    seed: Seed = 0,
    overrides: Overrides = None,
    allow_import: AllowImport = None,
    import_from: ImportFrom = None,
    step_limit: StepLimit = 30.0,
    in_python: InPython = False,
) -> None:
    """Write one page on a design.

    It shows what the design earns, why it does what it does, and episodes to replay. The page is a single file that
    works offline, in any browser.
    """
    require_writable_file(output)
    from bbsd.report.progress import episode_listener

    opening = stepping(allow_import, import_from, step_limit, in_python=in_python)
    with episode_listener(error_console(), "%") as listener:
        page = bbsd.page(
            design,
            other,
            seed=seed,
            episodes=episodes,
            faults=faults or (),
            set=overrides or (),
            progress=listener,
            **opening,
        )
    from bbsd.report.page import page_text

    write_result_text(output, page_text(page))
    show(escape(str(output)))
