"""The list of commands, and what happens to errors that a user can correct."""

import sys
from typing import Annotated

import typer

from bbsd.cli.terminal.guidance import Commands
from bbsd.cli.terminal.late import Listed
from bbsd.cli.terminal.mistakes import show_mistake
from bbsd.cli.terminal.output import say
from bbsd.cli.terminal.streams import steady_streams
from bbsd.version import __version__

NO = 1
"""The exit code for the answer no, and for a result that could not be written."""

LISTED = {
    "new": Listed("bbsd.cli.writing.new:new", "Write a small spec that runs, as a start for your own."),
    "design": Listed(
        "bbsd.cli.designing.design:design", "Fill the holes of a spec.", handles_interrupts=True
    ),
    "evaluate": Listed("bbsd.cli.evaluate:evaluate", "Measure the return of a design."),
    "spaces": Listed(
        "bbsd.cli.spaces:spaces", "Show what an environment stepped in Python observes and takes."
    ),
    "explain": Listed(
        "bbsd.cli.understanding.explain:explain", "Describe what a design does by the shortest rules."
    ),
    "why": Listed("bbsd.cli.understanding.why:why", "Say why a robot did what it did in a step."),
    "tidy": Listed("bbsd.cli.understanding.tidy:tidy", "Offer a design in fewer words that does the same."),
    "worth": Listed(
        "bbsd.cli.understanding.worth:worth",
        "Measure what each behavior, layer and rule of a design is worth.",
    ),
    "compare": Listed("bbsd.cli.understanding.compare:compare", "Show how designs differ."),
    "report": Listed("bbsd.cli.understanding.report:report", "Write one page on a design."),
    "runs": Listed(
        "bbsd.cli.understanding.runs:runs", "List runs with their state, and what came out so far."
    ),
    "watch": Listed(
        "bbsd.cli.understanding.watch:watch",
        "Show how far a run is, until it ends.",
        handles_interrupts=True,
    ),
    "export": Listed(
        "bbsd.cli.export:export",
        "Write a design in another language, for your own program.",
    ),
    "check": Listed(
        "bbsd.cli.writing.check:check",
        "Report all mistakes in specs, and what is probably not meant.",
    ),
    "fmt": Listed("bbsd.cli.writing.fmt:fmt", "Format specs in one style."),
    "config": Listed("bbsd.cli.writing.config:config", "Print a spec with all defaults filled in."),
    "compile": Listed(
        "bbsd.cli.writing.compile:compile_", "Print the kernel that a spec is compiled to, as Python source."
    ),
    "schema": Listed("bbsd.cli.writing.schema:schema", "Print the JSON Schema of the language, for editors."),
    "doctor": Listed(
        "bbsd.cli.doctor:doctor", "Check the installation: versions, cores, caches, a test result."
    ),
    "version": Listed("bbsd.cli.version:version", "Show the version."),
}
"""All commands, in the order in which --help lists them."""


class _Bbsd(Commands):
    """The commands of bbsd."""

    listed = LISTED


app = typer.Typer(
    name="bbsd",
    cls=_Bbsd,
    no_args_is_help=True,
    rich_markup_mode=None,  # with it, every --help would import rich: 0.28 s instead of 0.10 s
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


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


def run() -> None:
    """Run the command line; exit with 0, 1 for the answer no, 2 for a mistake of the user, 130 if interrupted."""
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
