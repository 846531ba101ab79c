"""`bbsd evaluate`."""

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

import bbsd
from bbsd.cli.options import AsJson, Jobs, Lanes, Overrides, Seed, SpecFile
from bbsd.cli.output import has_blocks, require_writable, say, show, show_table
from bbsd.report.csv_text import csv_text
from bbsd.report.figures import episode, require_figure
from bbsd.report.numbers import column
from bbsd.report.plain import evaluation_plain, json_text

if TYPE_CHECKING:
    from bbsd.evaluation import Evaluation

TOO_LOW = 1
"""The exit code where a mean is below --at-least."""


class Fill(StrEnum):
    """What to fill holes with."""

    RANDOM = "random"


def evaluate(
    spec: SpecFile,
    episodes: Annotated[int, typer.Option(metavar="N", min=1, help="Episodes, of each agent.")] = 1000,
    seed: Seed = 0,
    at_least: Annotated[
        float | None, typer.Option(metavar="X", help="Leave with 1 if the mean return is below this.")
    ] = None,
    fill: Annotated[
        Fill | None, typer.Option(help="Fill what is open at random instead of refusing it.")
    ] = None,
    agents: Annotated[int, typer.Option(metavar="N", min=1, help="Random agents, with --fill.")] = 1000,
    exact: Annotated[bool, typer.Option("--exact", help="Try every start there is once.")] = False,
    overrides: Overrides = None,
    trace: Annotated[
        Path | None, typer.Option(metavar="FILE.csv", help="Write the first episode, step by step.")
    ] = None,
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE.png", help="Draw the first episode: .png, .svg or .pdf.")
    ] = None,
    as_json: AsJson = False,
    lanes: Lanes = 40,
    jobs: Jobs = 1,
) -> None:
    """Measure what a design earns.

    Lives fresh episodes and shows their return, how much of it each reward term gave, and which behaviors
    were in control.
    """
    if fill and (exact or trace or plot):
        raise typer.BadParameter("--exact, --trace and --plot are of one design, --fill is of many")
    _require_outputs(trace, plot)
    evaluation = bbsd.evaluate(
        spec,
        episodes=episodes,
        seed=seed,
        fill="random" if fill else None,
        agents=agents,
        exact=exact,
        lanes=lanes,
        jobs=jobs,
        overrides=overrides or (),
    )
    _show(evaluation, as_json=as_json)
    if trace or plot:
        _write_episode(spec, seed, overrides, trace, plot)
    if at_least is not None and not evaluation.mean >= at_least:
        say(_shortfall(evaluation.mean, at_least))
        raise typer.Exit(TOO_LOW)


def _require_outputs(trace: Path | None, plot: Path | None) -> None:
    if plot:
        require_figure(plot)
    for path in (trace, plot):
        if path:
            require_writable(path)


def _show(evaluation: "Evaluation", *, as_json: bool) -> None:
    if as_json:
        show(json_text(evaluation_plain(evaluation)))
        return
    from bbsd.report.tables import evaluation_table

    show_table(evaluation_table(evaluation, blocks=has_blocks()))


def _write_episode(
    spec: Path, seed: int, overrides: Overrides, trace: Path | None, plot: Path | None
) -> None:
    loaded = bbsd.load(spec, seed=seed, overrides=overrides or ())
    lived = bbsd.trace(loaded, seed=seed)
    if trace:
        trace.write_text(csv_text(lived), encoding="utf-8")
    if plot:
        episode(lived, loaded.spec, plot)


def _shortfall(mean: float, wanted: float) -> str:
    mean_text, wanted_text, by = column([mean, wanted, wanted - mean])
    return f"bbsd: the mean return {mean_text} is below {wanted_text} by {by}"
