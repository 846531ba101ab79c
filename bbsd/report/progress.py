"""How far a design or an evaluation is, told while it runs.

A live line on a terminal; elsewhere a plain line of a design now and then.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from bbsd.report.bars import sparkline
from bbsd.report.numbers import column

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rich.console import Console

    from bbsd.report.shown import Generation

    Listener = Callable[[Generation], None]

LINES = 10
"""Plain lines of a run."""
CURVE_WIDTH = 16
REST_WIDTH = 76
"""Characters of the live line without the curve."""


@contextmanager
def progress(console: Console, *, quiet: bool = False) -> Iterator[Listener]:
    """Give a function to call after each generation, that shows it on the console; quiet shows nothing."""
    if quiet:
        yield lambda _generation: None
    elif console.is_terminal:
        with _live(console) as line:
            yield _line_listener(line)
    else:
        yield lambda generation: _print_tenths(console, generation)


@contextmanager
def episodes_lived(console: Console) -> Iterator[Callable[[int, int], None]]:
    """Give a function to call with how many episodes were lived, and of how many; only a terminal shows it."""
    if not console.is_terminal:
        yield lambda _done, _total: None
        return
    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn(compact=True))
    with Progress(*columns, console=console, transient=True) as line:
        task = line.add_task("compiling", total=None)

        def show(done: int, total: int) -> None:
            line.update(task, description=f"{done:,} of {total:,} episodes", completed=done, total=total)

        yield show


def standing(generation: Generation) -> str:
    """Return how far a run is and how well its agents do, as one plain line."""
    return f"{position(generation)}: {means(generation)}"


def position(generation: Generation) -> str:
    """Return the generation, and the run where there are several."""
    run = f"run {generation.run}/{generation.runs}, " if generation.runs > 1 else ""
    return f"{run}generation {generation.generation}/{generation.generations}"


def _phase(generation: Generation) -> str:
    """Return what goes on now that a generation ended: after a run's last one, the race for its answer."""
    if generation.generation < generation.generations:
        return position(generation)
    return f"run {generation.run}/{generation.runs}, final race" if generation.runs > 1 else "final race"


def means(generation: Generation) -> str:
    """Return the fitness of a generation's agents."""
    mean, best, lifetime = column([generation.mean, generation.best, generation.lifetime])
    return f"mean {mean}, best {best}, lifetime {lifetime}"


def _print_tenths(console: Console, generation: Generation) -> None:
    done, total = generation.generation, generation.generations
    if done * LINES // total > (done - 1) * LINES // total:
        console.print(standing(generation), markup=False, highlight=False, soft_wrap=True)


def _live(console: Console) -> Progress:
    return Progress(
        TextColumn("{task.description}", markup=False),
        TextColumn("{task.fields[means]}", markup=False),
        TextColumn("{task.fields[curve]}", style="cyan", markup=False),
        TimeRemainingColumn(compact=True),
        console=console,
        transient=True,
    )


def _line_listener(line: Progress) -> Listener:
    task = line.add_task("compiling", total=None, means="", curve="")
    curve_width = max(0, min(CURVE_WIDTH, line.console.width - REST_WIDTH))
    history: list[float] = []

    def show(generation: Generation) -> None:
        if generation.generation == 1:
            history.clear()
        history.append(generation.mean)
        line.update(
            task,
            description=_phase(generation),
            total=generation.runs * generation.generations,
            completed=(generation.run - 1) * generation.generations + generation.generation,
            means=means(generation),
            curve=sparkline(history, curve_width),
        )

    return show
