"""`python -m experiments.methods`: runs the cells that have no result yet, and prints the tables of all."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.engines.local import processes_engine
from experiments.methods.carrying import carried_out
from experiments.methods.cells import Cell, ResultsFile, missing
from experiments.methods.contestants import ABLATIONS, ALL, PAPER, RIVALS
from experiments.methods.tables import page, quantile_table, write_curves
from experiments.methods.tasks import IN_ORDER, task
from experiments.methods.trial import run

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from experiments.methods.cells import Result

RESULTS = Path("runs") / "methods.jsonl"
BUDGETS, SEEDS = (30_000, 300_000), 20
SMALL_TASKS = ("abstract", "object_lifting", "lake", "cliff_walking", "cartpole")
SMALL_METHODS, SMALL_BUDGETS, SMALL_SEEDS = ("auto", *RIVALS), (30_000,), 3
"""What `--small` runs, in a few minutes with the compilation of all kernels."""


def arguments(texts: Sequence[str] | None = None) -> argparse.Namespace:
    """Return the options, with the defaults of the full or the small comparison where none are given."""
    parser = argparse.ArgumentParser(
        prog="python -m experiments.methods", description="Compare methods at equal budgets on all tasks."
    )
    add = parser.add_argument
    add("--tasks", nargs="+", choices=IN_ORDER, metavar="TASK", help=f"of {', '.join(IN_ORDER)}")
    add("--methods", nargs="+", choices=ALL, metavar="METHOD", help=f"of {', '.join(ALL)}")
    add("--budgets", nargs="+", type=int, metavar="EPISODES", help="by default 30_000 and 300_000")
    add("--seeds", type=int, metavar="N", help=f"run seeds 0 to N - 1; by default {SEEDS}")
    add("--first", type=int, default=0, metavar="SEED", help="the first seed instead of 0")
    add("--small", action="store_true", help="few tasks, methods and seeds, unless they are named")
    add("--ablations", action="store_true", help="also run variants of auto that lack an ingredient")
    add("--jobs", type=int, default=1, metavar="N", help="processes, or workers of a cluster of this machine")
    add("--engine", choices=("processes", "dask"), default="processes", help="where cells are run")
    add("--scheduler", metavar="ADDRESS", help="of a Dask cluster")
    add("--results", type=Path, default=RESULTS, metavar="FILE", help=f"by default {RESULTS}")
    add("--curves", type=Path, metavar="FILE", help="write the best so far against episodes as CSV")
    add("--quantiles", action="store_true", help="also print the quantiles of every task and method")
    add("--tables-only", action="store_true", help="run nothing")
    options = parser.parse_args(texts)
    every = tuple(name for name in ALL if name not in ABLATIONS)
    options.tasks = options.tasks or (SMALL_TASKS if options.small else IN_ORDER)
    options.methods = options.methods or (SMALL_METHODS if options.small else every)
    options.budgets = options.budgets or (SMALL_BUDGETS if options.small else BUDGETS)
    options.seeds = options.seeds or (SMALL_SEEDS if options.small else SEEDS)
    if options.ablations:
        options.methods = (*options.methods, *(name for name in ABLATIONS if name not in options.methods))
    return options


def cells_of(options: argparse.Namespace) -> list[Cell]:
    """Return the cells that options ask for: task by task, and seed by seed, so that an early stop leaves few seeds."""
    return [
        Cell(name, method, budget, seed)
        for name in options.tasks
        for seed in range(options.first, options.first + options.seeds)
        for budget in options.budgets
        for method in options.methods
        if method != PAPER or task(name).paper_path is not None
    ]


def results_of(cells: Sequence[Cell], options: argparse.Namespace) -> Iterator[Result]:
    """Run cells and yield their results, each as soon as it is there."""
    if options.engine == "processes" and options.jobs == 1:
        yield from map(run, cells)
    elif options.engine == "processes":
        with processes_engine(options.jobs, ["experiments.methods.trial"]) as engine:
            yield from carried_out(cells, engine)
    else:
        from bbsd.engines.cluster import dask_engine

        with dask_engine(options.scheduler, options.jobs) as engine:
            yield from carried_out(cells, engine)


def line(result: Result) -> str:
    """Return a finished cell as text."""
    what = f"{result.task:<15} {result.method:<14} {result.budget:>9} {result.seed:>3}"
    if result.mean is None:
        return f"{what}  {result.reason}"
    return f"{what}  {result.mean:12.4f}  {result.seconds:7.1f} s"


def wanted(results: dict[Cell, Result], cells: Iterable[Cell]) -> list[Result]:
    """Return the results of cells that have one."""
    return [results[cell] for cell in cells if cell in results]


def main(texts: Sequence[str] | None = None) -> int:
    """Run what is missing, and print the tables."""
    options = arguments(texts)
    cells, file = cells_of(options), ResultsFile(options.results)
    digests = {(cell.task, cell.method): "" for cell in cells}
    digests = {(name, method): task(name).digest(method) for name, method in digests}
    results = file.read()
    file.begin()
    todo = [] if options.tables_only else missing(cells, results, digests)
    for number, result in enumerate(results_of(todo, options), start=1):
        file.add(result)
        results[result.cell] = result
        print(f"{number:>5}/{len(todo)}  {line(result)}", file=sys.stderr, flush=True)
    current = [
        result for result in wanted(results, cells) if result.of == digests[result.task, result.method]
    ]
    print(page(current, options.tasks, options.methods))
    if options.quantiles:
        print(f"\n{quantile_table(current, options.tasks, options.methods)}")
    if options.curves is not None:
        with options.curves.open("w", newline="", encoding="utf-8") as curves:
            write_curves(current, curves)
    return 0


if __name__ == "__main__":
    sys.exit(main())
