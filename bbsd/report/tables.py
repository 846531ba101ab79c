"""Tables of results, printed by rich. Names from specs are printed as they are, never read as markup."""

from __future__ import annotations

from math import isnan
from statistics import fmean, stdev
from typing import TYPE_CHECKING

from rich.console import Group
from rich.table import Table
from rich.text import Text

from bbsd.errors import escape
from bbsd.report.wording.bars import bar
from bbsd.report.wording.endings import ending_lines
from bbsd.report.wording.numbers import column, count, duration, percent
from bbsd.report.wording.warnings import disagreement, warnings_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from rich.console import RenderableType

    from bbsd.api import Designed
    from bbsd.evaluation import Evaluation, Interval, Spread

BAR_WIDTH = 24
SMALL = 1e-9
"""Mean steps that are a whole number but for rounding."""
WORTH_SAYING = 0.5
"""Seconds of compiling that are told."""
INTERVAL = "95 % interval"
JOINT_POLICY = "as one joint table"


def evaluation_table(evaluation: Evaluation, *, blocks: bool = True) -> RenderableType:
    """Return tables of the return with its interval, of the reward terms, and of the behaviors in control.

    Bars are made of block characters if the output has them, else of ASCII.
    """
    parts: list[RenderableType] = [
        Group(_return(evaluation), _basis(evaluation), *_optimum(evaluation)),
        *([] if evaluation.spread is None else [_spread(evaluation.spread)]),
        _reward_terms(evaluation),
        _control(evaluation, blocks=blocks),
    ]
    if evaluation.expectation_share:
        parts.append(_expectations(evaluation, blocks=blocks))
    if evaluation.not_finite:
        parts.append(_not_finite(evaluation))
    return Group(*_separated(parts))


def design_table(designed: Designed) -> RenderableType:
    """Return tables of the structure, highest layer first, and of the returns of the design and of random agents."""
    path = escape(designed.name if designed.written is None else str(designed.architecture))
    # People copy the path, so it is never broken into lines.
    where = Text(f"{path}, designed in {_time_taken(designed)}", no_wrap=True, overflow="ignore")
    parts: list[RenderableType] = [_structure(designed.structure), _returns(designed)]
    if designed.each:
        parts.append(_runs(designed))
    early = ending_lines([each.plain() for each in designed.ended], max(1, len(designed.each)))
    parts += [Text(line) for line in early]
    parts += [Text(warning, "yellow") for warning in warnings_of(designed)]
    return Group(*_separated([*parts, where]))


def _time_taken(designed: Designed) -> str:
    """Return how long a design took, and what was compiled before if that is worth a word."""
    compiling = f", after {duration(designed.compile_seconds)} of compiling"
    return duration(designed.seconds) + compiling * (designed.compile_seconds >= WORTH_SAYING)


def runs_table(rows: Sequence[tuple[str, Interval, Sequence[str]]], heading: str = "run") -> RenderableType:
    """Return a table of runs, each with its mean return and its structure, and their spread."""
    table = plain_table(heading, "mean return", INTERVAL, "structure, highest layer first", right=[0, 1])
    means = [interval.mean for _, interval, _ in rows]
    spread = stdev(means) if len(means) > 1 else 0.0
    texts = column([value for _, each, _ in rows for value in (each.mean, each.low, each.high)] + [spread])
    for index, (name, _, structure) in enumerate(rows):
        mean, low, high = texts[3 * index : 3 * index + 3]
        table.add_row(name, mean, f"{low} to {high}", Text(escape(" ".join(structure))))
    mean = column([*means, fmean(means)])[-1]
    table.add_row("mean", mean, "", f"standard deviation {texts[-1]}")
    return table


def seeds_table(several: Mapping[int, Designed]) -> RenderableType:
    """Return a table of designs, one for each seed, and where the best of them is."""
    rows = [
        (str(seed), designed.evaluation.returns, designed.structure) for seed, designed in several.items()
    ]
    best = max(several.values(), key=lambda designed: designed.mean)
    where = Text(f"best: {escape(str(best.architecture))}", no_wrap=True, overflow="ignore")
    parts: list[RenderableType] = [runs_table(rows, "seed")]
    if warning := disagreement([returns for _, returns, _ in rows]):
        parts.append(Text(warning, "yellow"))
    return Group(*_separated([*parts, where]))


def _runs(designed: Designed) -> RenderableType:
    rows = [
        (str(index), returns, structure) for index, (returns, structure) in enumerate(designed.each, start=1)
    ]
    return runs_table(rows)


def _separated(parts: Sequence[RenderableType]) -> Iterable[RenderableType]:
    for index, part in enumerate(parts):
        if index:
            yield ""
        yield part


def plain_table(*headings: str, right: Sequence[int] = ()) -> Table:
    """Return an empty table without lines; `right` are the columns whose texts stand at the right."""
    table = Table(box=None, pad_edge=False, padding=(0, 3, 0, 0), header_style="bold")
    for index, heading in enumerate(headings):
        table.add_column(Text(heading), justify="right" if index in right else "left", overflow="fold")
    return table


def _return(evaluation: Evaluation) -> Table:
    mean, sd, low, high = column([evaluation.mean, evaluation.sd, *evaluation.ci95])
    table = plain_table("return", "standard deviation", INTERVAL)
    spread = "exact" if evaluation.exact else f"{low} to {high}"
    table.add_row(Text(mean, "bold"), sd, spread)
    return table


def _basis(evaluation: Evaluation) -> str:
    """Return the numbers of episodes, steps and agents that the return was measured on."""
    steps = count(round(evaluation.steps), "step")
    if abs(evaluation.steps - round(evaluation.steps)) > SMALL:
        steps = f"{evaluation.steps:.1f} steps on average"
    if evaluation.optimum is not None:
        return f"all {count(evaluation.episodes, 'start')}, and all that chance may do, in {steps}"
    if evaluation.exact:
        return f"all {count(evaluation.episodes, 'start')}, {steps} each"
    agents = f" by {count(evaluation.agents, 'agent')}" if evaluation.agents > 1 else ""
    return f"{count(evaluation.episodes, 'episode')} of {steps}{agents}"


def _optimum(evaluation: Evaluation) -> list[str]:
    """Return what could be earned at best, where that is known."""
    if evaluation.optimum is None:
        return []
    best, fixed = column([evaluation.optimum.best, evaluation.optimum.fixed])
    lines = [f"optimum of any controller that sees the state: {best}"]
    if fixed != best:
        lines.append(f"the best found that always does the same in a state: {fixed}")
    return lines


def _spread(spread: Spread) -> Table:
    """Return the table of single episodes' returns; the median's number is that of the episode nearest to it."""
    headings = ["worst", *(f"{percent} %" for percent in spread.quantiles), "best"]
    table = plain_table("episodes", *headings, right=range(1, len(headings) + 1))
    table.add_row("return", *column([spread.worst, *spread.quantiles.values(), spread.best]))
    if spread.episodes:
        numbers = {"worst": spread.episodes["worst"], "50 %": spread.episodes["median"]}
        numbers["best"] = spread.episodes["best"]
        table.add_row("number", *(str(numbers.get(heading, "")) for heading in headings))
    return table


def _reward_terms(evaluation: Evaluation) -> Table:
    table = plain_table("reward term", "per episode", right=[1])
    values = column(list(evaluation.reward_terms.values()))
    for name, value in zip(evaluation.reward_terms, values, strict=True):
        table.add_row(Text(escape(name)), value)
    return table


def _control(evaluation: Evaluation, *, blocks: bool) -> Table:
    table = plain_table("in control", "share of time", "", right=[1])
    for name, share in evaluation.control_share.items():
        drawn = Text(bar(share, BAR_WIDTH, blocks=blocks), "dim" if name == "nobody" else "cyan")
        table.add_row(Text(escape(name)), percent(share), drawn)
    return table


def _expectations(evaluation: Evaluation, *, blocks: bool) -> Table:
    table = plain_table("expectation of", "held", "", right=[1])
    for name, share in evaluation.expectation_share.items():
        if isnan(share):
            table.add_row(Text(escape(name)), "", "never in control")
        else:
            drawn = Text(bar(share, BAR_WIDTH, blocks=blocks), "cyan")
            table.add_row(Text(escape(name)), percent(share), drawn)
    return table


def _not_finite(evaluation: Evaluation) -> Table:
    table = plain_table("infinite or not a number", "in steps", right=[1])
    for name, steps in evaluation.not_finite.items():
        table.add_row(Text(escape(name), "yellow"), str(steps))
    return table


def _structure(structure: Sequence[str]) -> Table:
    table = plain_table("layer", "behavior", right=[0])
    for index, name in enumerate(structure):
        table.add_row(str(len(structure) - index), Text(escape(name)))
    return table


def _returns(designed: Designed) -> Table:
    """Return the table of mean returns; all its numbers have the same decimals, to compare them at a glance."""
    rows = {"design": (designed.evaluation.returns, count(designed.evaluation.episodes, "new episode"))}
    if designed.lifetime is not None:
        rows["lifetime fitness"] = (designed.lifetime, count(designed.lifetime.count, "lifetime"))
    if designed.joint is not None:
        rows["its joint policy"] = (designed.joint, JOINT_POLICY)
    for rival in designed.rivals:
        if rival.returns is None:
            continue
        basis = f"after {count(rival.episodes, 'episode')}"
        rows[f"rival {rival.method}"] = (rival.returns, basis)
        if rival.joint is not None:
            rows[f"joint policy of {rival.method}"] = (rival.joint, JOINT_POLICY)
    rows["random agents"] = (designed.random, count(designed.random.count, "agent"))
    intervals = [interval for interval, _ in rows.values()]
    texts = column(
        [value for interval in intervals for value in (interval.mean, interval.low, interval.high)]
    )
    table = plain_table("", "mean return", INTERVAL, "", right=[1])
    for index, (name, (_, basis)) in enumerate(rows.items()):
        mean, low, high = texts[3 * index : 3 * index + 3]
        table.add_row(name, Text(mean, "" if index else "bold"), f"{low} to {high}", basis)
    return table
