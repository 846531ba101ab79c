"""How far a design or an evaluation is, told while it goes on.

Live lines on a terminal; elsewhere a plain line of a design now and then.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from bbsd.report.bars import sparkline
from bbsd.report.numbers import column

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rich.console import Console
    from rich.progress import Progress, TaskID

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
            yield _Lines(line).show
    else:
        yield lambda generation: _print_tenths(console, generation)


@contextmanager
def episodes_lived(console: Console) -> Iterator[Callable[[int, int], None]]:
    """Give a function to call with how many episodes were lived, and of how many; only a terminal shows it."""
    if not console.is_terminal:
        yield lambda _done, _total: None
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

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
    from rich.progress import Progress, TextColumn, TimeRemainingColumn

    return Progress(
        TextColumn("{task.description}", markup=False),
        TextColumn("{task.fields[means]}", markup=False),
        TextColumn("{task.fields[curve]}", style="cyan", markup=False),
        TimeRemainingColumn(compact=True),
        console=console,
        transient=True,
    )


class _Lines:
    """A line for each run that is going on. All of them tell the time that is left for all runs."""

    def __init__(self, live: Progress) -> None:
        self._live = live
        self._tasks: dict[int, TaskID] = {}
        self._free = [self._new_line()]
        self._reached: dict[int, int] = {}
        self._histories: dict[int, list[float]] = {}
        self._curve_width = max(0, min(CURVE_WIDTH, live.console.width - REST_WIDTH))

    def show(self, generation: Generation) -> None:
        """Show a generation that ended."""
        if generation.run not in self._tasks:
            self._tasks[generation.run] = self._line_for(generation)
        self._reached[generation.run] = generation.generation
        history = self._histories.setdefault(generation.run, [])
        history.append(generation.mean)
        self._live.update(
            self._tasks[generation.run],
            description=_phase(generation),
            means=means(generation),
            curve=sparkline(history, self._curve_width),
        )
        self._tell_time(generation)

    def _line_for(self, generation: Generation) -> TaskID:
        """The line of a run that came to its end, since whoever begins a run has ended one; at first a new one."""
        ended = [run for run in self._tasks if self._reached[run] == generation.generations]
        if ended:
            self._free.append(self._tasks.pop(ended[0]))
        return self._free.pop() if self._free else self._new_line()

    def _new_line(self) -> TaskID:
        return self._live.add_task("compiling", total=None, means="", curve="")

    def _tell_time(self, generation: Generation) -> None:
        """Runs are begun in their order, so those before a run that was not told of were done before."""
        each, begun = generation.generations, range(1, max(self._reached) + 1)
        done = sum(self._reached.get(run, each) for run in begun)
        for task in self._tasks.values():
            self._live.update(task, total=generation.runs * each, completed=done)
