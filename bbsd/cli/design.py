"""`bbsd design`."""

import shlex
import sys
import time
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from bbsd.cli.options import AsJson, Lanes, Overrides, Seed, SpecFile
from bbsd.cli.output import error_console, leave_now, say, show, show_table
from bbsd.report.figures import draw_curves, require_figure
from bbsd.report.plain import design_plain, json_text

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from bbsd.api import Designed
    from bbsd.runs.price import Price
    from bbsd.runs.processes import Processes

INTERRUPTED = 130
CURVES = "curves.png"
DRAWING = 0.5
"""Approximate seconds to import matplotlib and draw the curves."""


def design(
    spec: SpecFile,
    seed: Seed = 0,
    runs: Annotated[
        int, typer.Option(metavar="N", min=1, help="Independent runs; the best of their designs is kept.")
    ] = 1,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="Folder for the results, new or empty.", show_default="runs/SPEC-seedN"
        ),
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Continue a design that was stopped.")] = False,
    lanes: Lanes = 40,
    jobs: Annotated[
        int,
        typer.Option(
            metavar="N",
            min=1,
            help="Parallel jobs: processes for several runs, threads within a run; affects only the speed.",
        ),
    ] = 1,
    overrides: Overrides = None,
    plot: Annotated[
        bool, typer.Option("--plot", help="Also draw fitness and diversity over the generations: curves.png.")
    ] = False,
    as_json: AsJson = False,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Only estimate what the design would cost; write nothing.")
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Show no progress.")] = False,
) -> None:
    """Fill the holes of a spec.

    Evolves the behaviors, learns the structure, and writes a folder with the designed spec, the metrics of
    each generation, and the state from which --resume continues.
    """
    from bbsd.language.loading import load
    from bbsd.text import Source

    if plot:
        require_figure(Path(CURVES))
    # Mistakes are shown before anything heavy is imported, and workers import it at the same time as this process.
    loaded = load(Source.read(str(spec)), seed=seed, overrides=overrides or ())
    with _workers(0 if dry_run or resume else min(runs, jobs) - 1) as ready:
        from bbsd import api
        from bbsd.report.progress import generation_listener

        if dry_run:
            starting = time.process_time() + (DRAWING if plot else 0.0)
            price = api.price(loaded, seed=seed, runs=runs, lanes=lanes, jobs=jobs, starting=starting)
            _show_price(price, as_json=as_json)
            return
        console = error_console()

        def leave(stopped: api.Interrupted) -> None:
            """End the process at once: what was written is complete."""
            console.show_cursor()
            _say_how_to_continue(stopped.folder, begin="\n" if console.is_terminal and not quiet else "")
            leave_now(INTERRUPTED)

        try:
            with generation_listener(console, quiet=quiet) as listener:
                designed = api.design(
                    loaded,
                    seed=seed,
                    runs=runs,
                    out=out,
                    resume=resume,
                    lanes=lanes,
                    jobs=jobs,
                    overrides=overrides or (),
                    progress=listener,
                    overdue=leave,
                    ready=ready,
                )
        except api.Interrupted as stopped:
            _say_how_to_continue(stopped.folder)
            raise typer.Exit(INTERRUPTED) from None
    _show(designed, seed, runs, as_json=as_json)
    if plot:
        _draw_curves(designed)


def _workers(count: int) -> "AbstractContextManager[Processes | None]":
    if count == 0:
        return nullcontext()
    from bbsd.runs.processes import waiting_processes

    return waiting_processes(count)


def _show_price(price: "Price", *, as_json: bool) -> None:
    from bbsd.report.price import price_plain, price_text

    show(json_text(price_plain(price)) if as_json else price_text(price))


def _say_how_to_continue(folder: Path, begin: str = "") -> None:
    say(f"{begin}stopped; what was done is kept in {folder}. To continue: {_resume_command(folder)}")


def _resume_command(folder: Path) -> str:
    """Return the command that continues in a folder: the one given, with --resume."""
    given = [word for word in sys.argv[1:] if word != "--resume"]
    named = any(word.partition("=")[0] == "--out" for word in given)
    return shlex.join(["bbsd", *given, *([] if named else ["--out", str(folder)]), "--resume"])


def _draw_curves(designed: "Designed") -> None:
    """Draw the metrics into their folder, after the result is shown: matplotlib takes longer than a small design."""
    from bbsd.runs.folder import Folder

    draw_curves(Folder(designed.folder).lines(), designed.folder / CURVES)


def _show(designed: "Designed", seed: int, runs: int, *, as_json: bool) -> None:
    if as_json:
        show(json_text(design_plain(designed, seed, runs)))
        return
    from bbsd.report.tables import design_table

    show_table(design_table(designed))
