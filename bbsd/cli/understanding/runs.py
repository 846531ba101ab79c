"""`bbsd runs`."""

from pathlib import Path
from typing import Annotated

import typer

import bbsd
from bbsd.cli.options import AsFormat, AsJson, ResultFormat
from bbsd.cli.terminal.output import say, show


def runs(
    folders: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="FOLDER", help="Folders of runs, or folders that hold such.", show_default="runs"
        ),
    ] = None,
    form: AsFormat = ResultFormat.TEXT,
    as_json: AsJson = False,
) -> None:
    """List runs with their state, and what came out so far.

    A run is running, stopped, finished, not begun or damaged. Only reads: no lock is taken, and nothing is written.
    """
    from bbsd.report.plain import json_text
    from bbsd.report.watching.listing import listing_plain, listing_text
    from bbsd.runs.storage.finished import way_on

    places = folders or []
    found = bbsd.runs_in(*places)
    is_json = as_json or form is ResultFormat.JSON
    show(json_text(listing_plain(found)) if is_json else listing_text(found))
    if not found:
        say(f"there are no runs in {', '.join(map(str, places)) or 'runs'}")
    elif len(found) == 1 and found[0].state == "stopped" and not found[0].version:
        say(way_on(found[0].folder))
