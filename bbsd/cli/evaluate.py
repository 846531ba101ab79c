"""`bbsd evaluate`."""

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

import bbsd
from bbsd.cli.options import (
    AllowImport,
    AsFormat,
    AsJson,
    DesignFile,
    Episode,
    ImportFrom,
    InPython,
    Jobs,
    Lanes,
    Overrides,
    ResultFormat,
    Seed,
    StepLimit,
    read_episode,
)
from bbsd.cli.terminal.access import stepping
from bbsd.cli.terminal.output import (
    error_console,
    has_blocks,
    require_writable_file,
    say,
    show,
    show_table,
)
from bbsd.cli.terminal.warnings import say_warnings
from bbsd.cli.understanding.faults import TOO_LOW, show_faults, too_low
from bbsd.errors import UsageError

if TYPE_CHECKING:
    from bbsd.evaluation import Evaluation, Rank, Trace
    from bbsd.language.loading import Loaded


class NothingExpected(UsageError):
    """`--expect-at-least` for a spec without expectations."""

    advice = "add expects: CONDITION to a behavior, or omit the option"


class TraceFormat(StrEnum):
    """How a trace is laid out: a column for each value, or a line for each value of each step."""

    WIDE = "wide"
    LONG = "long"


class Fill(StrEnum):
    """How to fill holes."""

    RANDOM = "random"


def evaluate(
    spec: DesignFile,
    episodes: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            min=1,
            help="Number of episodes; with --fill, for each agent.",
            show_default="1000; 10 with --fill",
        ),
    ] = None,
    seed: Seed = 0,
    at_least: Annotated[
        float | None, typer.Option(metavar="X", help="Exit with code 1 if the mean return is below X.")
    ] = None,
    expect_at_least: Annotated[
        float | None,
        typer.Option(
            metavar="SHARE",
            min=0,
            max=1,
            help="Exit with code 1 if an expectation holds in a smaller share of its steps.",
        ),
    ] = None,
    fill: Annotated[
        Fill | None, typer.Option(help="Fill holes at random; without it, a spec with holes is refused.")
    ] = None,
    agents: Annotated[
        int, typer.Option(metavar="N", min=1, help="Number of random agents, with --fill.")
    ] = 1000,
    exact: Annotated[
        bool,
        typer.Option(
            "--exact",
            help="Give the exact mean: by each possible start, or by all that a table of transitions may do.",
        ),
    ] = False,
    overrides: Overrides = None,
    returns: Annotated[
        Path | None,
        typer.Option(metavar="FILE.csv", help="Write a line for each episode: return, terms, steps."),
    ] = None,
    episode: Episode = "0",
    trace: Annotated[
        Path | None, typer.Option(metavar="FILE.csv", help="Write the episode step by step.")
    ] = None,
    trace_format: Annotated[
        TraceFormat,
        typer.Option(help="A column for each value, or a line for each value of each step."),
    ] = TraceFormat.WIDE,
    plot: Annotated[
        Path | None,
        typer.Option(
            "--plot-to", "--plot", metavar="FILE.png", help="Draw the episode, as .png, .svg or .pdf."
        ),
    ] = None,
    values: Annotated[
        list[str] | None,
        typer.Option(
            "--show",
            metavar="NAME",
            help="A value that --plot shows: a state, world, sensor or definition, or reward; may be repeated.",
            show_default="state, world, sensors that are the same for all robots, reward",
        ),
    ] = None,
    fault: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FAULT",
            help="Show how far the return falls under a fault, such as behavior=NAME:silent, behavior=NAME:stuck@100, "
            "sensor=NAME:noise(0.5), sensor=NAME:lost or robot=1:dead; all: every behavior silent. May be repeated.",
            show_default=False,
        ),
    ] = None,
    relearn: Annotated[
        bool,
        typer.Option("--relearn", help="With --fault: also learn the order of the layers again around it."),
    ] = False,
    allow_import: AllowImport = None,
    import_from: ImportFrom = None,
    step_limit: StepLimit = 30.0,
    in_python: InPython = False,
    form: AsFormat = ResultFormat.TEXT,
    as_json: AsJson = False,
    lanes: Lanes = 40,
    jobs: Jobs = 1,
) -> None:
    """Measure the return of a design.

    Runs new episodes and shows their mean return, how much of it each reward term gave, the share of time
    that each behavior was in control, and how often its expectation held.
    """
    if fill and (exact or trace or plot):
        raise typer.BadParameter(
            "--exact, --trace and --plot need one complete design, so they exclude --fill"
        )
    if fault and (fill or exact or returns or trace or plot or expect_at_least is not None):
        raise typer.BadParameter("--fault goes with --episodes, --seed, --relearn and --at-least alone")
    if relearn and not fault:
        raise typer.BadParameter("--relearn needs --fault")
    as_json = as_json or form is ResultFormat.JSON
    chosen = read_episode(episode)
    _require_use(chosen, values, trace, plot)
    if exact and isinstance(chosen, str):
        raise typer.BadParameter(f"--episode {chosen} is among random episodes, so it excludes --exact")
    _require_outputs(returns, trace, plot)
    loaded = bbsd.load(spec, seed=seed, set=overrides or ())
    say_warnings(loaded)
    if expect_at_least is not None:
        _require_expectations(loaded)
    if values:
        from bbsd.report.figures import names_to_show, require_names

        require_names(values, names_to_show(loaded.spec))
    opening = stepping(allow_import, import_from, step_limit, in_python=in_python)
    if fault:
        episodes = episodes or 1000
        show_faults(
            loaded, fault, episodes, seed, at_least, lanes, jobs, opening, relearn=relearn, as_json=as_json
        )
        return
    from bbsd.report.progress import episode_listener

    with episode_listener(error_console()) as listener:
        evaluation = bbsd.evaluate(
            loaded,
            episodes=episodes,
            seed=seed,
            fill="random" if fill else None,
            agents=agents,
            exact=exact,
            lanes=lanes,
            jobs=jobs,
            progress=listener,
            keep_each=returns is not None,
            **opening,
        )
    _show(evaluation, as_json=as_json)
    _write_returns(evaluation, returns)
    if trace or plot:
        number = chosen if isinstance(chosen, int) else _number_of(chosen, evaluation)
        traced = bbsd.trace(loaded, seed=seed, episode=number, **opening)
        if trace:
            _write_trace(traced, trace, trace_format)
        if plot:
            from bbsd.report.figures import draw_episode

            draw_episode(traced, loaded.spec, plot, episode=number, show=values or ())
    failures = [*too_low(evaluation.mean, at_least), *_too_rare(evaluation, expect_at_least)]
    for failure in failures:
        say(failure)
    if failures:
        raise typer.Exit(TOO_LOW)


def _require_expectations(loaded: "Loaded") -> None:
    if all(behavior.expects is None for behavior in loaded.spec.behaviors.values()):
        raise NothingExpected("--expect-at-least: no behavior of this spec has an expectation")


def _require_use(
    chosen: "int | Rank", values: list[str] | None, trace: Path | None, plot: Path | None
) -> None:
    """Raise BadParameter for options that would have no effect."""
    if values and not plot:
        raise typer.BadParameter("--show needs --plot-to")
    if chosen and not (trace or plot):
        raise typer.BadParameter("--episode needs --trace or --plot-to")


def _require_outputs(returns: Path | None, trace: Path | None, plot: Path | None) -> None:
    if plot:
        from bbsd.report.figures import require_figure

        require_figure(plot)
    for path in (returns, trace, plot):
        if path:
            require_writable_file(path)


def _show(evaluation: "Evaluation", *, as_json: bool) -> None:
    if as_json:
        from bbsd.report.plain import evaluation_plain, json_text

        show(json_text(evaluation_plain(evaluation)))
        return
    from bbsd.report.tables import evaluation_table

    show_table(evaluation_table(evaluation, blocks=has_blocks()))


def _write_returns(evaluation: "Evaluation", path: Path | None) -> None:
    if path and evaluation.each is not None:
        from bbsd.report.csv_text import returns_text
        from bbsd.runs.storage.lock import write_result_text

        write_result_text(path, returns_text(evaluation.each))


def _write_trace(traced: "Trace", path: Path, form: TraceFormat) -> None:
    from bbsd.report.csv_text import csv_text
    from bbsd.runs.storage.lock import write_result_text

    write_result_text(path, csv_text(traced, long=form is TraceFormat.LONG))


def _number_of(rank: "Rank", evaluation: "Evaluation") -> int:
    """Return the number of the worst, median or best of the episodes that were run."""
    return 0 if evaluation.spread is None else evaluation.spread.episodes[rank]


def _too_rare(evaluation: "Evaluation", least: float | None) -> list[str]:
    """Report each expectation that held too rarely; the one of a behavior that never controls (NaN) does not fail."""
    shares = evaluation.expectation_share.items() if least is not None else ()
    return [
        f"bbsd: the expectation of {name} held in {share:.4g} of its steps, below {least:g} by {least - share:.2g}"
        for name, share in shares
        if least is not None and share < least
    ]
