"""A run that goes on: a line for each change, or a picture of all runs for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import escape
from bbsd.report.wording.bars import bar, sparkline
from bbsd.report.wording.endings import ending_lines
from bbsd.report.wording.numbers import column, count

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from bbsd.runs.storage.watching import Line, Watched, WatchedRun

BAR_WIDTH, CURVE_WIDTH = 20, 16
STATES = {
    "waiting": "has not begun",
    "running": "is running",
    "stopped": "was stopped",
    "done": "is done",
}


def change_lines(before: Watched | None, now: Watched, generations: int = 0) -> Iterator[str]:
    """Yield a line for each change between two looks; of the first look, what each run has reached."""
    known = {} if before is None else {(run.rival, run.run): len(run.lines) for run in before.runs}
    for run in now.runs:
        first = min(known.get((run.rival, run.run), len(run.lines) - 1), len(run.lines))
        for line in run.lines[first:]:
            yield f"{who_text(run, now)}{position_text(line, now, generations)}: {fitness_text(line)}"
    if before is None or before.state != now.state:
        yield state_line(now)


def state_line(now: Watched) -> str:
    """Return whether a run goes on, and its result."""
    text = f"{escape(str(now.folder))} {STATES[now.state]}"
    returns = now.result.get("return")
    if now.state != "done" or not isinstance(returns, dict):
        return text
    numbers = [returns.get(key) for key in ("mean", "low", "high")]
    if not all(isinstance(each, int | float) for each in numbers):
        return text
    mean, low, high = column([float(each) for each in numbers if each is not None])
    structure = escape(" ".join(map(str, now.result.get("structure", ()))))
    ended = now.result.get("ended")
    early = ending_lines(ended, now.n_runs) if isinstance(ended, list) else []
    return "; ".join([f"{text}: mean return {mean} ({low} to {high}), structure {structure}", *early])


def watched_view(now: Watched, generations: int = 0, *, blocks: bool = True) -> RenderableType:
    """Return how far all runs are: a bar for each, the best so far with its curve, and its structure."""
    from rich.console import Group
    from rich.text import Text

    parts = [Text(state_line(now))]
    for run in now.runs:
        line = run.lines[-1]
        drawn = bar(share_done(line, now, generations), BAR_WIDTH, blocks=blocks).ljust(BAR_WIDTH)
        means = [float(each["mean"]) for each in run.lines]
        curve = sparkline(means, CURVE_WIDTH) if blocks else ""
        head, fitness = Text(who_text(run, now).removesuffix(", ")), Text(f"  {fitness_text(line)}  ")
        head.append(f"{'  ' if head.plain else ''}{drawn}", "cyan")
        head.append(f"  {position_text(line, now, generations)}")
        fitness.append(curve, "cyan")
        structure = Text(f"  {escape(' '.join(map(str, line['structure'])))}", "dim")
        parts += [head, fitness, structure]
    return Group(*parts)


def who_text(run: WatchedRun, now: Watched) -> str:
    """Return which run it is, with a comma behind; '' where there is only one."""
    rival = f"rival {escape(run.rival)}, " if run.rival else ""
    return f"{rival}run {run.run}/{now.n_runs}, " if now.n_runs > 1 else rival


def position_text(line: Line, now: Watched, generations: int) -> str:
    """Return the generation or the episodes of a line of metrics."""
    if "generation" in line:
        of = f"/{generations}" if generations >= line["generation"] else ""
        return f"generation {line['generation']}{of}"
    episodes = line.get("episodes", 0)
    return f"{episodes:,} of {now.budget:,} episodes" if now.budget else count(episodes, "episode")


def share_done(line: Line, now: Watched, generations: int) -> float:
    """Return which part of a run is done; an answer is all of it."""
    if line.get("stage") == "answer":
        return 1.0
    if "generation" in line:
        return float(line["generation"]) / generations if generations else 0.0
    return float(line.get("episodes", 0)) / now.budget if now.budget else 0.0


def fitness_text(line: Line) -> str:
    """Return the fitness of a generation's agents, or the best so far in new episodes."""
    if "generation" in line:
        keys = [key for key in ("mean", "best", "lifetime") if isinstance(line.get(key), int | float)]
        texts = column([float(line[key]) for key in keys])
        return ", ".join(f"{key} {text}" for key, text in zip(keys, texts, strict=True))
    (mean,) = column([float(line["mean"])])
    what = "answer" if line.get("stage") == "answer" else "best so far"
    return f"{what} {mean} in {count(int(line.get('measured', 0)), 'new episode')}"
