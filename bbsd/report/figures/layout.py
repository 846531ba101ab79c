"""What all figures of an episode have: a title, panels of values beside or below each other, and a note below."""

from __future__ import annotations

from contextlib import contextmanager
from textwrap import shorten, wrap
from typing import TYPE_CHECKING

import numpy as np

from bbsd.report.figures.files import LETTER_HEIGHT, TITLE_HEIGHT, figure_in_file, legend, set_title
from bbsd.report.figures.panels import MOST_TERMS, draw_reward, draw_values, is_strip
from bbsd.report.wording.numbers import column

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from bbsd.evaluation import Trace
    from bbsd.language.models import Spec
    from bbsd.report.figures.choice import Choice, ValuePanel

PANEL_HEIGHT, STRIP = 1.35, 0.1
"""Heights in inches: of the panel of a value, and of a strip in it if there are many."""
MOST_STRIPS = 64
"""Strips of a panel that have their full height, as many as a team has robots; more are thinner."""
AROUND_PANEL = 0.45
"""The part of a panel's height that its title and ticks take, in inches."""
NOTE_LINE = 0.16
"""The height of a line of the note below in inches."""
LETTERS_PER_INCH = 17
"""Of the note's small letters."""
MOST_NOTE_LINES = 3


def title_of(trace: Trace, spec: Spec, episode: int | None) -> str:
    """Return a figure's title: the spec's name, the episode, its return and length."""
    total = float(sum(np.sum(robots) for robots in trace.rewards.values())) / trace.robots
    number = "" if episode is None else f", episode {episode}"
    n_steps = len(trace.steps)
    return f"{spec.name}{number}: return {column([total])[0]} in {n_steps:,} step{'s' * (n_steps != 1)}"


@contextmanager
def titled_figure(
    path: Path, width: float, height: float, title: str, left_out: Sequence[str]
) -> Iterator[Figure]:
    """Yield a figure with a title, and a note on what it leaves out, in a file at the end; sizes in inches."""
    lines = _note(left_out, width)
    with figure_in_file(path, width, height + TITLE_HEIGHT + NOTE_LINE * len(lines)) as figure:
        set_title(figure, title)
        if lines:
            figure.supxlabel(
                "\n".join(lines), x=0.01, ha="left", fontsize=7, color="#555555", linespacing=1.3
            )
        yield figure


def _note(left_out: Sequence[str], width: float) -> list[str]:
    """Return the lines that name what is left out, and how to see it."""
    if not left_out:
        return []
    letters = int(width * LETTERS_PER_INCH)
    names = shorten(", ".join(left_out), MOST_NOTE_LINES * letters - 60, placeholder=" ...")
    return wrap(f"Not shown: {names} (choose with --show NAME).", letters)


def draw_panels(
    panels: Sequence[Axes], choice: Choice, trace: Trace, heights: Sequence[float], *, in_gray: bool
) -> None:
    """Draw the values that were chosen and the reward into panels of these heights in inches, and a legend of lines."""
    told = set[tuple[str, ...]]()
    for panel, shown in zip(panels, choice.panels, strict=False):
        draw_values(panel, shown, in_gray=in_gray)
        labels = tuple(curve.label for curve in shown.curves)
        if any(labels) and labels not in told and not is_strip(shown, in_gray=in_gray):
            legend(panel)
            told.add(labels)
    if choice.reward:
        place = len(choice.panels)
        draw_reward(panels[place], trace, heights[place] - AROUND_PANEL)


def value_height(shown: ValuePanel, *, in_gray: bool) -> float:
    """Return the height of the panel of a value in inches."""
    if is_strip(shown, in_gray=in_gray):
        return max(PANEL_HEIGHT, AROUND_PANEL + STRIP * min(len(shown.curves), MOST_STRIPS))
    return PANEL_HEIGHT + 0.12 * max(0, len(shown.cells) - 4)


def reward_height(trace: Trace) -> float:
    """Return the height in inches that the panel of the reward needs for the names of its lines."""
    return AROUND_PANEL + LETTER_HEIGHT * (min(len(trace.rewards), MOST_TERMS) + 1)
