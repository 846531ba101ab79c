"""Tables of a comparison in Markdown, and the curves of searches as CSV."""

from __future__ import annotations

import csv
from math import floor, log10
from typing import TYPE_CHECKING, TextIO

import numpy as np

from experiments.methods.comparison import better, improvement, means, medians, quantiles
from experiments.methods.contestants import ABLATIONS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from experiments.methods.cells import Result

DEFAULT = "auto"
"""The method that others are compared with."""
NOTHING = ""


def page(results: Sequence[Result], tasks: Sequence[str], methods: Sequence[str]) -> str:
    """Return all tables, for each budget those of the methods and those of variants of `auto`."""
    parts: list[str] = []
    for budget in sorted({result.budget for result in results}):
        at_budget = [result for result in results if result.budget == budget]
        ran = {result.method for result in at_budget}
        shown = [task for task in tasks if any(result.task == task for result in at_budget)]
        for kind in (
            [name for name in methods if name in ran and name not in ABLATIONS],
            [name for name in methods if name in ran and (name in ABLATIONS or name == DEFAULT)],
        ):
            if kind and (kind[0] not in ran or len(set(kind) - {DEFAULT})):
                parts += _sections(at_budget, shown, kind, budget)
    return "\n\n".join(parts)


def _sections(
    results: Sequence[Result], tasks: Sequence[str], methods: list[str], budget: int
) -> Iterator[str]:
    of = f"{budget:,} episodes"
    yield f"### {of}: median (least) return"
    yield _table(tasks, methods, lambda task, method: _median_and_least(results, task, method, budget))
    rivals = [method for method in methods if method != DEFAULT]
    if DEFAULT in methods and rivals:
        yield f"### {of}: how probable it is that `{DEFAULT}` does better"
        yield _table(tasks, rivals, lambda task, rival: _better(results, task, rival, budget))
        yield _summary(results, tasks, rivals, budget)
    yield f"### {of}: median seconds of the processor"
    yield _table(tasks, methods, lambda task, method: _seconds(results, task, method, budget))


def _table(tasks: Sequence[str], methods: Sequence[str], cell: Callable[[str, str], str]) -> str:
    lines = [
        f"| task | {' | '.join(f'`{method}`' for method in methods)} |",
        f"| --- |{' ---: |' * len(methods)}",
    ]
    lines += [f"| `{task}` | {' | '.join(cell(task, method) for method in methods)} |" for task in tasks]
    return "\n".join(lines)


def _median_and_least(results: Sequence[Result], task: str, method: str, budget: int) -> str:
    values = means(results, task, method, budget)
    if not len(values):
        return NOTHING
    digits = _digits(task, results)
    return f"{np.median(values):.{digits}f} ({values.min():.{digits}f})"


def _digits(task: str, results: Sequence[Result]) -> int:
    """Return the decimals in which a task's figures are written: five digits in all for the best of them."""
    best = max(
        (result.mean for result in results if result.task == task and result.mean is not None), default=1.0
    )
    return min(4, max(0, 4 - floor(log10(max(abs(best), 1.0)))))


def _better(results: Sequence[Result], task: str, rival: str, budget: int) -> str:
    own, others = (means(results, task, method, budget) for method in (DEFAULT, rival))
    return f"{better(own, others):.2f}" if len(own) and len(others) else NOTHING


def _summary(results: Sequence[Result], tasks: Sequence[str], rivals: Sequence[str], budget: int) -> str:
    lines = [
        "| rival | mean over tasks | 95 % | least | on | tasks |",
        "| --- | ---: | ---: | ---: | --- | ---: |",
    ]
    for rival in rivals:
        pairs = {
            task: (means(results, task, DEFAULT, budget), means(results, task, rival, budget))
            for task in tasks
        }
        pairs = {task: pair for task, pair in pairs.items() if len(pair[0]) and len(pair[1])}
        if pairs:
            found = improvement(pairs)
            lines.append(
                f"| `{rival}` | {found.mean:.3f} | {found.low:.3f} to {found.high:.3f} | {found.worst:.2f} | "
                f"`{found.worst_task}` | {found.n_tasks} |"
            )
    return "\n".join(lines)


def _seconds(results: Sequence[Result], task: str, method: str, budget: int) -> str:
    if not len(means(results, task, method, budget)):
        return NOTHING
    return f"{medians(results, task, method, budget)[1]:.1f}"


def quantile_table(results: Sequence[Result], tasks: Sequence[str], methods: Sequence[str]) -> str:
    """Return the quantiles over seeds of each task, budget and method, and on what they were measured."""
    lines = [
        "| task | budget | method | seeds | least | 25 % | median | 75 % | greatest | measured on | seconds |",
        "| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | --- | ---: |",
    ]
    budgets = sorted({result.budget for result in results})
    for task, budget, method in ((one, two, three) for one in tasks for two in budgets for three in methods):
        values = means(results, task, method, budget)
        if len(values):
            digits = _digits(task, results)
            cells = " | ".join(f"{value:.{digits}f}" for value in quantiles(values))
            example = next(result for result in results if result.task == task and result.mean is not None)
            sample = f"all {example.episodes:,} starts" if example.exact else f"{example.episodes:,} episodes"
            seconds = medians(results, task, method, budget)[0]
            lines.append(
                f"| `{task}` | {budget:,} | `{method}` | {len(values)} | {cells} | {sample} | {seconds:.1f} |"
            )
    return "\n".join(lines)


def write_curves(results: Sequence[Result], file: TextIO) -> None:
    """Write the mean return of the best so far against episodes, a row for each record of each search."""
    writer = csv.writer(file)
    writer.writerow(["task", "method", "budget", "seed", "episodes", "mean"])
    for result in results:
        writer.writerows([*result.cell, episodes, mean] for episodes, mean in result.curve)
