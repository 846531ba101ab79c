"""The list of commands, and what happens to errors that a user can correct."""

import atexit
import gc
import sys
from typing import Annotated

import typer

from bbsd.cli.designing.design import design
from bbsd.cli.doctor import doctor
from bbsd.cli.evaluate import evaluate
from bbsd.cli.export import export
from bbsd.cli.spaces import spaces
from bbsd.cli.terminal.guidance import Commands
from bbsd.cli.terminal.interrupts import stoppable
from bbsd.cli.terminal.mistakes import show_mistake
from bbsd.cli.terminal.output import say
from bbsd.cli.terminal.streams import steady_streams
from bbsd.cli.understanding.compare import compare
from bbsd.cli.understanding.explain import explain
from bbsd.cli.understanding.report import report
from bbsd.cli.understanding.runs import runs
from bbsd.cli.understanding.tidy import tidy
from bbsd.cli.understanding.watch import watch
from bbsd.cli.understanding.why import why
from bbsd.cli.understanding.worth import worth
from bbsd.cli.writing.check import check
from bbsd.cli.writing.compile import compile_
from bbsd.cli.writing.config import config
from bbsd.cli.writing.fmt import fmt
from bbsd.cli.writing.new import new
from bbsd.cli.writing.schema import schema
from bbsd.version import __version__

GC_THRESHOLD = 100_000
"""New objects between two garbage collections; a command's objects live as long as it does, or die at once."""
NO = 1
"""The exit code for the answer no, and for a result that could not be written."""

app = typer.Typer(
    name="bbsd",
    cls=Commands,
    no_args_is_help=True,
    rich_markup_mode=None,  # with it, every --help would import rich: 0.28 s instead of 0.10 s
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command()(stoppable(new))
app.command()(design)
app.command()(stoppable(evaluate))
app.command()(stoppable(spaces))
app.command()(stoppable(explain))
app.command()(stoppable(why))
app.command()(stoppable(tidy))
app.command()(stoppable(worth))
app.command()(stoppable(compare))
app.command()(stoppable(report))
app.command()(stoppable(runs))
app.command()(watch)
app.command()(stoppable(export))
app.command()(stoppable(check))
app.command()(stoppable(fmt))
app.command()(stoppable(config))
app.command("compile")(stoppable(compile_))
app.command()(stoppable(schema))
app.command()(stoppable(doctor))


@app.command()
def version() -> None:
    """Show the version."""
    typer.echo(f"bbsd {__version__}")


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"bbsd {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version and exit."),
    ] = False,
) -> None:
    """Design behavior-based agents from a spec: what the spec gives is kept, what it leaves open is designed."""


def main() -> None:
    """Run the command line; exit with 0, 1 for the answer no, 2 for a mistake of the user, 130 if interrupted."""
    gc.set_threshold(GC_THRESHOLD)
    atexit.register(gc.freeze)  # Python's last collection would take a tenth of a design's time
    with steady_streams() as output:
        code = _run()
        output.flush()
        # A reader that has seen enough (`| head`) is no failure.
        if output.failure is not None and not isinstance(output.failure, BrokenPipeError):
            say(f"bbsd: the result cannot be written: {output.failure.strerror}")
            code = code or NO
    sys.exit(code)


def _run() -> int | str | None:
    """Run the command that was given, and return its exit code."""
    try:
        app(prog_name="bbsd")
    except SystemExit as left:
        return left.code
    except Exception as error:  # noqa: BLE001 - raised again unless the user can correct it
        return show_mistake(error)
    return 0
