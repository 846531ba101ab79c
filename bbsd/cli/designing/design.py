"""`bbsd design`."""

import time
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from bbsd.cli.designing.budget import read_budget, read_seeds, read_time
from bbsd.cli.designing.continuing import former_design, say_how_to_continue
from bbsd.cli.designing.designed import show_design, show_price, show_seeds
from bbsd.cli.designing.search_figures import Additions
from bbsd.cli.designing.seeds import designs_of_seeds, order_of
from bbsd.cli.designing.workers import AnyEngine, EngineName, Scheduler, chosen_engine, require_engine
from bbsd.cli.options import (
    AllowImport,
    AsFormat,
    AsJson,
    ImportFrom,
    InPython,
    Lanes,
    Overrides,
    ResultFormat,
    Seed,
    StepLimit,
    spec_files,
)
from bbsd.cli.terminal.access import stepping
from bbsd.cli.terminal.interrupts import INTERRUPTED
from bbsd.cli.terminal.output import error_console, leave_now, say
from bbsd.cli.terminal.warnings import say_warnings

if TYPE_CHECKING:
    from rich.console import Console

    from bbsd.api import Designed, Interrupted
    from bbsd.language.loading import Loaded

LEAST_BUDGET = 5_000
"""As in `bbsd.language.design`, which takes long to import."""
RUNS = Path("runs")
"""Where designs are written that name no folder."""
DRAWING = 0.5
"""Approximate seconds to import matplotlib and draw the curves."""


def design(
    context: typer.Context,
    spec: Annotated[
        Path,
        typer.Argument(
            metavar="SPEC",
            help="The spec, a YAML file; with --resume or --more also the folder of a design.",
            show_default=False,
            autocompletion=spec_files,
        ),
    ],
    seed: Seed = 0,
    runs: Annotated[
        int, typer.Option(metavar="N", min=1, help="Independent runs; the best of their designs is kept.")
    ] = 1,
    seeds: Annotated[
        str | None,
        typer.Option(
            metavar="A-B",
            help="A design for each of several seeds, such as 0-9, each in a folder of its own, and a table of them.",
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="Folder for the results, new or empty.", show_default="runs/SPEC-seedN"
        ),
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Continue a design that was stopped.")] = False,
    start: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="DESIGN",
            help="Begin with a known design, a file or the folder of a run: it is among the first candidates. "
            "Repeatable.",
            show_default=False,
            autocompletion=spec_files,
        ),
    ] = None,
    lanes: Lanes = 40,
    budget: Annotated[
        str | None,
        typer.Option(
            metavar="N",
            help="Episodes of each run in all, such as 300_000; or seconds, such as 20s, "
            "which cannot be reproduced.",
            show_default="from the spec",
        ),
    ] = None,
    time_limit: Annotated[
        str | None,
        typer.Option(
            metavar="T",
            help="End the searches after a time, such as 10m, with their final races; --more goes on. It cannot be "
            "reproduced.",
            show_default=False,
        ),
    ] = None,
    more: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            min=LEAST_BUDGET,
            help="Go on after the end with so many more episodes; SPEC may be the folder of a design.",
            show_default=False,
        ),
    ] = None,
    jobs: Annotated[
        int,
        typer.Option(
            metavar="N",
            min=1,
            help="Parallel jobs: processes for several seeds or runs, threads within a run; affects only the speed.",
        ),
    ] = 1,
    engine: AnyEngine = EngineName.PROCESSES,
    scheduler: Scheduler = None,
    overrides: Overrides = None,
    plot: Annotated[
        bool,
        typer.Option(
            "--plot",
            help="Also draw the search: the best so far, or fitness and diversity; in the folder as curves.png.",
        ),
    ] = False,
    plot_to: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.png",
            help="Draw the search into this file, as .png, .svg or .pdf.",
            show_default=False,
        ),
    ] = None,
    plot_beside: Annotated[
        Path | None,
        typer.Option(
            metavar="DESIGN",
            help="With --plot or --plot-to: a design to compare with, such as one made by hand; its mean return is a "
            "line.",
            show_default=False,
        ),
    ] = None,
    tensorboard: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Also write the metrics as event files of TensorBoard, at the end; bbsd watch does so meanwhile.",
            show_default=False,
        ),
    ] = None,
    rival: Annotated[
        str | None,
        typer.Option(
            metavar="METHOD",
            help="Spend the same budget on another method too, and show what it achieves.",
            show_default=False,
        ),
    ] = None,
    compare_methods: Annotated[
        bool, typer.Option("--compare-methods", help="Spend the same budget on every other method too.")
    ] = False,
    allow_import: AllowImport = None,
    import_from: ImportFrom = None,
    step_limit: StepLimit = 30.0,
    in_python: InPython = False,
    form: AsFormat = ResultFormat.TEXT,
    as_json: AsJson = False,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Only estimate what the design would cost; write nothing.")
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Show no progress.")] = False,
) -> None:
    """Fill the holes of a spec.

    Searches for the behaviors and the structure by the method and the budget that the spec names, and writes a
    folder with the designed spec, the metrics on the way, and the state from which --resume continues.
    """
    from bbsd.api.specs import load

    as_json = as_json or form is ResultFormat.JSON
    opening = stepping(allow_import, import_from, step_limit, in_python=in_python)
    require_engine(engine, scheduler)
    additions = Additions(plot, plot_to, plot_beside, tensorboard, opening)
    additions.require(seed, out, several=seeds is not None)
    (set_by_budget, within), limit = read_budget(budget), read_time(time_limit)
    overrides, resume = [*(overrides or ()), *set_by_budget], resume or more is not None
    if spec.is_dir():
        # The folder of a design names its spec, its seed and its settings.
        former = former_design(spec, context, goes_on=resume)
        spec, out = former.spec, spec
        seed, runs, overrides = former.seed, former.runs, [*former.overrides, *set_by_budget]
    # Mistakes are shown before anything heavy is imported, and workers import it at the same time as this process.
    loaded = load(spec, seed=seed, set=overrides)
    if not quiet:
        say_warnings(loaded)
        _say_which_method(loaded)
    processes = 0 if resume or seeds else min(runs, jobs) - 1
    if dry_run:
        starting = time.process_time() + (DRAWING if plot or plot_to else 0.0)
        show_price(
            loaded, opening, seed, runs=runs, lanes=lanes, jobs=jobs, starting=starting, as_json=as_json
        )
        return
    with chosen_engine(engine, scheduler, jobs=jobs, processes=processes) as workers:
        from bbsd import api
        from bbsd.report.progress import generation_listener

        console = error_console()

        options: dict[str, Any] = {
            "runs": runs,
            "lanes": lanes,
            "more": more,
            "within": within,
            "rivals": _rivals(rival, loaded, every=compare_methods),
            "start": start or (),
            "time_limit": limit,
        }
        overdue = partial(_leave, console, quiet=quiet)
        base = out or RUNS / f"{spec.stem}-seeds{seeds}"
        try:
            if seeds is not None:
                orders = [
                    order_of(spec, each, overrides, base / f"seed-{each}", additions, options, resume=resume)
                    for each in read_seeds(seeds)
                ]
                several = designs_of_seeds(
                    orders, opening, jobs, workers, console, quiet=quiet, overdue=overdue, base=base
                )
                show_seeds(several, as_json=as_json)
                return
            with ExitStack() as showing:

                def finish(designed: "Designed") -> None:
                    """Show the result first: matplotlib takes longer than a small design."""
                    showing.close()
                    show_design(designed, seed, runs, by_time=within is not None, as_json=as_json)
                    additions.add(designed, seed)

                api.design(
                    loaded,
                    seed=seed,
                    out=out,
                    below=RUNS if out is None else None,
                    resume=resume,
                    jobs=jobs,
                    progress=showing.enter_context(generation_listener(console, quiet=quiet)),
                    overdue=overdue,
                    engine=workers,
                    finish=finish,
                    **options,
                    **opening,
                )
        except api.Interrupted as stopped:
            say_how_to_continue(stopped, out=out if seeds is None else base)
            raise typer.Exit(INTERRUPTED) from None


def _leave(console: "Console", stopped: "Interrupted", *, quiet: bool) -> None:
    """End the process at once: what was written is complete."""
    console.show_cursor()
    say_how_to_continue(stopped, begin="\n" if console.is_terminal and not quiet else "")
    leave_now(INTERRUPTED)


def _rivals(name: str | None, loaded: "Loaded", *, every: bool) -> tuple[str, ...]:
    from bbsd.runs.rivals import all_rivals

    others = all_rivals(loaded.spec.design.chosen_method)
    if name is not None and name not in others:
        raise typer.BadParameter(f"{name} is none of {', '.join(others)}", param_hint="--rival")
    return others if every else () if name is None else (name,)


def _say_which_method(loaded: "Loaded") -> None:
    """Say that the paper's loop is meant where it is not named, and what the default would be."""
    design = loaded.spec.design
    if design.chosen_method == "paper" and "method" not in design.model_fields_set:
        keys = " and ".join(f"design.{key}" for key in design.loop_keys)
        say(
            f"the spec has {keys} and names no method, so it is designed by the paper's loop (method: paper); "
            "method: auto would search with several methods on one budget (--set design.method=auto)"
        )
