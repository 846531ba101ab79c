"""`bbsd watch`."""

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from bbsd.cli.options import spec_files
from bbsd.cli.output import has_blocks, output_console, show

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.live import Live

INTERRUPTED = 130


def watch(
    run: Annotated[
        Path,
        typer.Argument(
            metavar="RUN",
            help="The folder of a run that another process writes, or has written.",
            show_default=False,
            autocompletion=spec_files,
        ),
    ],
    tensorboard: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="Also write the metrics as event files of TensorBoard.", show_default=False
        ),
    ] = None,
) -> None:
    """Show how far a run is, until it ends.

    Only reads: a run is the same whether it is watched or not. Where the output is no terminal, it is a line for each
    change.
    """
    from bbsd.api import watching
    from bbsd.report.watching.events import EventFiles
    from bbsd.report.watching.words import change_lines, watched_view

    events = None if tensorboard is None else EventFiles(tensorboard)
    generations, before = 0, None
    try:
        with _display() as display:
            for now in watching.watch(run):
                generations = generations or watching.generations(run)
                if display is None:
                    show("\n".join(change_lines(before, now, generations)))
                else:
                    display.update(watched_view(now, generations, blocks=has_blocks()), refresh=True)
                if events is not None:
                    events.update(now)
                before = now
    except KeyboardInterrupt:
        raise typer.Exit(INTERRUPTED) from None


@contextmanager
def _display() -> "Iterator[Live | None]":
    """Yield what shows a picture that changes, None where the output is no terminal."""
    console = output_console()
    if not console.is_terminal:
        yield None
        return
    from rich.live import Live

    with Live(console=console, auto_refresh=False) as display:
        yield display
