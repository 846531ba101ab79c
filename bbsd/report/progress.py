"""Progress of a design or an evaluation, shown while it runs.

A terminal shows live lines; any other output gets a plain line for each tenth of a run.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from bbsd.api import Progress as GenerationProgress
from bbsd.report.wording.bars import sparkline
from bbsd.report.wording.numbers import column, count, duration

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rich import progress as rich_progress
    from rich.console import Console

    from bbsd.api import AnyProgress

PLAIN_LINES = 10
"""The number of plain lines for a run."""
CURVE_WIDTH = 16
"""The number of characters of the curve, at most."""
REST_WIDTH = 76
"""The number of characters of a live line without its curve."""


@contextmanager
def generation_listener(console: Console, *, quiet: bool = False) -> Iterator[Callable[[AnyProgress], None]]:
    """Yield a function to call after each generation; it shows the progress on the console unless `quiet`."""
    if quiet:
        yield lambda _progress: None
    elif console.is_terminal:
        with _live_display(console) as display:
            yield _LiveLines(display).show
    else:
        yield _Tenths(console).show


@contextmanager
def episode_listener(console: Console, what: str = "episodes") -> Iterator[Callable[[int, int], None]]:
    """Yield a function to call with the numbers of finished and of all episodes; only a terminal shows them."""
    if not console.is_terminal:
        yield lambda _done, _total: None
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn(compact=True))
    with Progress(*columns, console=console, transient=True) as display:
        task = display.add_task("compiling", total=None)

        def show(done: int, total: int) -> None:
            display.update(task, description=f"{done:,} of {total:,} {what}", completed=done, total=total)

        yield show


def progress_line(progress: AnyProgress) -> str:
    """Return the generation that ended and the fitness of its agents, as one plain line."""
    return f"{_position(progress)}: {_fitness(progress)}"


def _position(progress: AnyProgress) -> str:
    """Return the generation or the episodes, and the run where there are several."""
    run = f"run {progress.run}/{progress.runs}, " if progress.runs > 1 else ""
    if isinstance(progress, GenerationProgress):
        return f"{run}generation {progress.generation}/{progress.generations}"
    rival = f"rival {progress.rival}, " if progress.rival else ""
    return f"{rival}{run}{progress.episodes:,} of {progress.budget:,} episodes"


def _phase(progress: AnyProgress) -> str:
    """Return the generation that ended; after a run's last one, the final race that follows it."""
    if progress.done < progress.total or not isinstance(progress, GenerationProgress):
        return _position(progress)
    return f"run {progress.run}/{progress.runs}, final race" if progress.runs > 1 else "final race"


def _fitness(progress: AnyProgress) -> str:
    """Return the fitness of a generation's agents, or the best so far in new episodes."""
    if isinstance(progress, GenerationProgress):
        mean, best, lifetime = column([progress.mean, progress.best, progress.lifetime])
        return f"mean {mean}, best {best}, lifetime {lifetime}"
    (mean,) = column([progress.mean])
    return f"best so far {mean} in {count(progress.measured, 'new episode')}"


class _Tenths:
    """A plain line for each tenth of a run."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._printed: dict[tuple[str, int], int] = {}

    def show(self, progress: AnyProgress) -> None:
        """Print a line if a tenth of the run was completed."""
        tenth = progress.done * PLAIN_LINES // progress.total
        before = 0
        if isinstance(progress, GenerationProgress):
            before = (progress.done - 1) * PLAIN_LINES // progress.total
        who = ("" if isinstance(progress, GenerationProgress) else progress.rival, progress.run)
        if tenth > self._printed.get(who, before):
            self._console.print(progress_line(progress), markup=False, highlight=False, soft_wrap=True)
        self._printed[who] = max(tenth, before)


def _live_display(console: Console) -> rich_progress.Progress:
    from rich.progress import Progress, TextColumn, TimeRemainingColumn
    from rich.text import Text

    class Time(TimeRemainingColumn):
        """The time that is left; while nothing is known of it yet, the time that compiling has taken."""

        def render(self, task: rich_progress.Task) -> Text:
            if task.total is None:
                return Text(duration(task.elapsed or 0.0), style="progress.elapsed")
            return super().render(task)

    return Progress(
        TextColumn("{task.description}", markup=False),
        TextColumn("{task.fields[fitness]}", markup=False),
        TextColumn("{task.fields[curve]}", style="cyan", markup=False),
        Time(compact=True),
        console=console,
        transient=True,
    )


class _LiveLines:
    """A live line for each run in progress; each shows the time that is left for all runs together."""

    def __init__(self, display: rich_progress.Progress) -> None:
        self._display = display
        self._tasks: dict[int, rich_progress.TaskID] = {}
        self._free = [self._new_line()]
        self._done: dict[int, int] = {}
        self._histories: dict[int, list[float]] = {}
        self._curve_width = max(0, min(CURVE_WIDTH, display.console.width - REST_WIDTH))

    def show(self, progress: AnyProgress) -> None:
        """Show a generation that ended."""
        if progress.run not in self._tasks:
            self._tasks[progress.run] = self._line_for(progress)
        self._done[progress.run] = progress.done
        history = self._histories.setdefault(progress.run, [])
        history.append(progress.mean)
        self._display.update(
            self._tasks[progress.run],
            description=_phase(progress),
            fitness=_fitness(progress),
            curve=sparkline(history, self._curve_width),
        )
        self._update_time_left(progress)

    def _line_for(self, progress: AnyProgress) -> rich_progress.TaskID:
        """Return the line of a run that ended, since a process begins a run after ending another; else a new one."""
        ended = [run for run in self._tasks if self._done[run] == progress.total]
        if ended:
            self._free.append(self._tasks.pop(ended[0]))
        return self._free.pop() if self._free else self._new_line()

    def _new_line(self) -> rich_progress.TaskID:
        return self._display.add_task("compiling", total=None, fitness="", curve="")

    def _update_time_left(self, progress: AnyProgress) -> None:
        """Give every line the work done in all runs, from which rich estimates the time left.

        Runs begin in order, so a run that nothing was reported of, before one that was, ended earlier: before
        a stopped design was resumed.
        """
        per_run, started = progress.total, range(1, max(self._done) + 1)
        done = sum(self._done.get(run, per_run) for run in started)
        for task in self._tasks.values():
            self._display.update(task, total=progress.runs * per_run, completed=done)
