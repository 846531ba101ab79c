"""The figure of an episode over its steps, as in the paper's Fig. 22."""

from __future__ import annotations

from contextlib import contextmanager
from textwrap import shorten, wrap
from typing import TYPE_CHECKING

import numpy as np

from bbsd.report.figures.choice import choice_of
from bbsd.report.figures.control import (
    behavior_colors,
    behavior_rows,
    control_height,
    draw_control_by_behavior,
    draw_control_by_robot,
)
from bbsd.report.figures.files import (
    LETTER_HEIGHT,
    TITLE_HEIGHT,
    color,
    figure_in_file,
    legend,
    set_title,
    stack_panels,
)
from bbsd.report.figures.panels import MOST_IN_COLOR, MOST_TERMS, draw_reward, draw_values, is_strip
from bbsd.report.numbers import column

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from bbsd.evaluation import Trace
    from bbsd.language.models import Spec
    from bbsd.report.figures.choice import Choice, ValuePanel

WIDTH = 8.0
PANEL_HEIGHT, STRIP = 1.35, 0.1
"""Heights in inches: of the panel of a value, and of a strip in it if there are many."""
AROUND_PANEL = 0.45
"""The part of a panel's height that its title and ticks take, in inches."""
NOTE_LINE = 0.16
"""The height of a line of the note below in inches."""
LETTERS_PER_INCH = 17
"""Of the note's small letters."""
MOST_NOTE_LINES = 3


def draw_episode(
    trace: Trace, spec: Spec, path: Path, *, episode: int | None = None, show: Sequence[str] = ()
) -> None:
    """Draw the values of an episode at its start and after each step, what it earned, and who was in control.

    Shown are state and world, and sensors that are numbers and equal for all robots, eight values at most in the
    spec's order, or those that `show` names; what is left out is named below. With many robots a value is a strip for
    each. If the spec has a view, the episode is drawn from above, with these panels beside it. Raises FigureError for
    an unknown kind of file or name, and OSError if the file cannot be written.
    """
    if trace.scene is None:
        _draw_panels_only(trace, spec, path, episode, show)
    else:
        from bbsd.report.figures.scene import draw_with_scene

        draw_with_scene(trace, spec, trace.scene, path, episode, show)


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
    with_legend = False
    for panel, shown in zip(panels, choice.panels, strict=False):
        draw_values(panel, shown, in_gray=in_gray)
        if not with_legend and not is_strip(shown, in_gray=in_gray) and any(c.label for c in shown.curves):
            legend(panel)
            with_legend = True
    if choice.reward:
        place = len(choice.panels)
        draw_reward(panels[place], trace, heights[place] - AROUND_PANEL)


def value_height(shown: ValuePanel, *, in_gray: bool) -> float:
    """Return the height of the panel of a value in inches."""
    if is_strip(shown, in_gray=in_gray):
        return max(PANEL_HEIGHT, AROUND_PANEL + STRIP * len(shown.curves))
    return PANEL_HEIGHT + 0.12 * max(0, len(shown.cells) - 4)


def reward_height(trace: Trace) -> float:
    """Return the height in inches that the panel of the reward needs for the names of its lines."""
    return AROUND_PANEL + LETTER_HEIGHT * (min(len(trace.rewards), MOST_TERMS) + 1)


def _draw_panels_only(trace: Trace, spec: Spec, path: Path, episode: int | None, show: Sequence[str]) -> None:
    choice, behaviors = choice_of(trace, spec, show=show), behavior_rows(trace)
    by_robot = trace.robots > MOST_IN_COLOR
    heights = [value_height(shown, in_gray=False) for shown in choice.panels]
    heights += [max(PANEL_HEIGHT, reward_height(trace))] if choice.reward else []
    heights.append(control_height(trace, behaviors, by_robot=by_robot))
    with titled_figure(path, WIDTH, sum(heights), title_of(trace, spec, episode), choice.left_out) as figure:
        *panels, last = stack_panels(figure, heights)
        draw_panels(panels, choice, trace, heights, in_gray=False)
        if by_robot:
            colors = behavior_colors(behaviors, spec)
            draw_control_by_robot(last, trace, colors)
            name_patches(last, colors)
        else:
            draw_control_by_behavior(last, trace, behaviors, [color(robot) for robot in range(trace.robots)])
            if trace.robots > 1:
                name_patches(last, {f"robot {robot}": color(robot) for robot in range(trace.robots)})


def name_patches(panel: Axes, colors: Mapping[str, str]) -> None:
    """Put the names of colors to the right of a panel."""
    for name, each in colors.items():
        panel.plot([], [], ls="", marker="s", ms=6, color=each, label=name)
    legend(panel)
