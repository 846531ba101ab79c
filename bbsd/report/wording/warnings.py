"""What a reader of a design should know beside its figures: nothing to select by, runs that disagree."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.report.wording.numbers import count, number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.api import Designed
    from bbsd.evaluation import Interval


def warnings_of(designed: Designed) -> list[str]:
    """Return the warnings about a design, one sentence or two each."""
    warnings = [
        _fickle(designed),
        _selection(designed),
        disagreement([returns for returns, _ in designed.each]),
    ]
    warnings += [_unvisited(designed)]
    warnings += [f"rival {rival.method}: {rival.reason}" for rival in designed.rivals if rival.reason]
    return [warning for warning in warnings if warning]


def _fickle(designed: Designed) -> str:
    """Return why the design cannot be made again, or ""."""
    reason = designed.not_reproducible
    return f"not reproducible: {reason}, so the same command may give another design" if reason else ""


def _selection(designed: Designed) -> str:
    """Return what random agents never earned, or ""."""
    selection = designed.selection
    who = f"{count(selection.agents, 'random agent')} in {count(selection.episodes, 'episode')}"
    terms = ", ".join(selection.unearned)
    if selection.alike is None:
        return f"{who} never earned {terms}" if terms else ""
    named = f", and never {terms}" if terms else ""
    text = f"{who} all earned {number(selection.alike)}{named}: there is nothing to select by"
    if designed.first_reward is not None:
        text += f"; a better design was there in episode {designed.first_reward:,}"
    return text


def _unvisited(designed: Designed) -> str:
    """Return which cells no candidate's episodes visited, or ""."""
    if not designed.unvisited:
        return ""
    cells = ", ".join(f"{each.cells:,} of {each.of:,} of {each.behavior}" for each in designed.unvisited)
    episodes = count(designed.unvisited[0].episodes, "episode")
    return f"cells that no candidate visited in {episodes}, where any choice is as good: {cells}"


def disagreement(returns: Sequence[Interval]) -> str:
    """Return by how much runs disagree that differ by more than their intervals, or ""."""
    if len(returns) < 2:
        return ""
    best = max(returns, key=lambda interval: interval.mean)
    behind = [interval for interval in returns if interval.high < best.low]
    if not behind:
        return ""
    short = number(best.mean - min(interval.mean for interval in behind))
    are = "is" if len(behind) == 1 else "are"
    return f"local optima: {len(behind)} of {len(returns)} runs {are} up to {short} below the best"
