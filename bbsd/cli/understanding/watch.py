"""`bbsd watch`."""

from contextlib import contextmanager, nullcontext
from pathlib import Path
from shlex import quote
from threading import Event
from typing import TYPE_CHECKING, Annotated

import typer

from bbsd.cli.options import spec_files
from bbsd.cli.terminal.interrupts import INTERRUPTED
from bbsd.cli.terminal.output import has_blocks, output_console, say, show
from bbsd.errors import escape

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.live import Live

    from bbsd.runs.storage.watching import Watched


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
    serve: Annotated[
        bool,
        typer.Option(
            "--serve",
            help="Serve a page on the run to browsers on this machine, until Ctrl-C; at its end, "
            "the page of bbsd report.",
        ),
    ] = False,
    port: Annotated[
        int,
        typer.Option(metavar="N", min=0, max=65535, help="Port of the page.", show_default="any free one"),
    ] = 0,
) -> None:
    """Show how far a run is, until it ends.

    Only reads: a run is the same whether it is watched or not. Where the output is no terminal, it is a line for each
    change.
    """
    from bbsd.api import watching
    from bbsd.report.watching.events import EventFiles
    from bbsd.report.watching.words import change_lines, watched_view

    events = None if tensorboard is None else EventFiles(tensorboard)
    generations, before, page = 0, None, _Page(run)
    try:
        with _served(page, port) if serve else nullcontext():
            with _display() as display:
                for now in watching.watch(run):
                    generations = generations or watching.generations(run)
                    page.update(now, generations)
                    if display is None:
                        show("\n".join(change_lines(before, now, generations)))
                    else:
                        display.update(watched_view(now, generations, blocks=has_blocks()), refresh=True)
                    if events is not None:
                        events.update(now)
                    before = now
            _say_how_to_go_on(before)
            if serve:
                page.finish()
                Event().wait()
    except KeyboardInterrupt:
        raise typer.Exit(INTERRUPTED) from None


def _say_how_to_go_on(last: "Watched | None") -> None:
    """Say how a run that was stopped is continued."""
    from bbsd.runs.storage.finished import way_on

    if last is not None and last.state == "stopped":
        say(way_on(last.folder))


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


class _Page:
    """The page that is served: how far the run is, and at its end the whole design."""

    def __init__(self, run: Path) -> None:
        self._run = run
        self._watched: Watched | None = None
        self._generations = 0
        self._whole = ""

    def update(self, now: "Watched", generations: int) -> None:
        """Show how far the run is."""
        self._watched, self._generations = now, generations

    def finish(self) -> None:
        """Show the design, where the run has one."""
        if self._watched is None or self._watched.state != "done":
            return
        import bbsd
        from bbsd.environments.importing.consent import ImportNotAllowed
        from bbsd.report.page import page_text

        say("the run is done; its page is being made")
        try:
            self._whole = page_text(bbsd.page(self._run))
        except ImportNotAllowed:
            say("no page is made: it needs the environment, and watching a run imports nothing")
            say(f"its page is made by: bbsd report {escape(quote(str(self._run)))} --allow-import MODULE")
            return
        say("the page is there")

    def text(self) -> str:
        """Return the page as it is now."""
        from bbsd.report.watching.live_page import live_page
        from bbsd.runs.storage.watching import look

        return self._whole or live_page(self._watched or look(self._run), self._generations)


@contextmanager
def _served(page: _Page, port: int) -> "Iterator[None]":
    from bbsd.report.watching.server import serving

    with serving(page.text, port) as address:
        say(f"{address} shows the run to browsers on this machine; Ctrl-C ends it")
        yield
