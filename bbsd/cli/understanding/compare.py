"""`bbsd compare`."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

import bbsd
from bbsd.cli.options import (
    AllowImport,
    AsFormat,
    AsJson,
    ImportFrom,
    InPython,
    Jobs,
    Lanes,
    Overrides,
    ResultFormat,
    Seed,
    StepLimit,
    spec_files,
)
from bbsd.cli.terminal.access import stepping
from bbsd.cli.terminal.output import say, show, show_table
from bbsd.report.plain import json_text
from bbsd.report.wording.numbers import column

if TYPE_CHECKING:
    from bbsd.explanation.comparison import Comparison

TOO_LOW = 1
"""The exit code if the lower end of a difference is below --at-least."""


def compare(
    designs: Annotated[
        list[Path],
        typer.Argument(
            metavar="A B [C...]",
            help="Designs, as YAML files or folders of runs; each is compared with the first one.",
            show_default=False,
            autocompletion=spec_files,
        ),
    ],
    episodes: Annotated[int, typer.Option(metavar="N", min=2, help="Number of episodes of each.")] = 1000,
    seed: Seed = 0,
    at_least: Annotated[
        float | None,
        typer.Option(
            metavar="X",
            help="Exit with code 1 unless the 95 % interval of what a design earns more than A begins at X or above.",
            show_default=False,
        ),
    ] = None,
    overrides: Overrides = None,
    allow_import: AllowImport = None,
    import_from: ImportFrom = None,
    step_limit: StepLimit = 30.0,
    in_python: InPython = False,
    form: AsFormat = ResultFormat.TEXT,
    as_json: AsJson = False,
    lanes: Lanes = 40,
    jobs: Jobs = 1,
) -> None:
    """Show how designs differ.

    That is: in what they do, in their rules and order, and in what they earn. All run the same episodes.
    Differences are those of the other design minus A.
    """
    first, *others = designs
    if not others:
        raise typer.BadParameter("give two designs at least, A and B")
    opening = stepping(allow_import, import_from, step_limit, in_python=in_python)
    comparisons = [
        bbsd.compare(
            first,
            other,
            episodes=episodes,
            seed=seed,
            lanes=lanes,
            jobs=jobs,
            set=overrides or (),
            **opening,
        )
        for other in others
    ]
    _show(comparisons, ResultFormat.JSON if as_json else form)
    failures = [line for comparison in comparisons for line in _too_low(comparison, at_least)]
    for failure in failures:
        say(failure)
    if failures:
        raise typer.Exit(TOO_LOW)


def _show(comparisons: "list[Comparison]", form: ResultFormat) -> None:
    if form is ResultFormat.JSON:
        from bbsd.report.comparison import comparison_plain

        plain = [comparison_plain(comparison) for comparison in comparisons]
        show(json_text(plain[0] if len(plain) == 1 else plain))
        return
    from bbsd.report.comparison import comparison_table

    for index, comparison in enumerate(comparisons):
        if index:
            show("\n")
        show_table(comparison_table(comparison))


def _too_low(comparison: "Comparison", least: float | None) -> list[str]:
    low = comparison.difference.low
    if least is None or low >= least:
        return []
    low_text, least_text, by = column([low, least, least - low])
    what = f"the 95 % interval of what {comparison.b} earns more than {comparison.a}"
    return [f"bbsd: {what} begins at {low_text}, below {least_text} by {by}"]
