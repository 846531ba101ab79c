"""The figure of an episode without a view: panels over its steps, one below the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.report.figures.choice import choice_of
from bbsd.report.figures.control import (
    behavior_colors,
    behavior_rows,
    control_height,
    draw_control_by_behavior,
    draw_control_by_robot,
)
from bbsd.report.figures.files import color, legend, stack_panels
from bbsd.report.figures.layout import (
    PANEL_HEIGHT,
    draw_panels,
    reward_height,
    title_of,
    titled_figure,
    value_height,
)
from bbsd.report.figures.panels import MOST_IN_COLOR

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from matplotlib.axes import Axes

    from bbsd.evaluation import Trace
    from bbsd.language.models import Spec

WIDTH = 8.0
"""In inches."""


def draw_over_steps(trace: Trace, spec: Spec, path: Path, episode: int | None, show: Sequence[str]) -> None:
    """Draw values, what was earned, and who was in control; robots have colors, or behaviors where robots are many."""
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
            _name_patches(last, colors)
        else:
            draw_control_by_behavior(last, trace, behaviors, [color(robot) for robot in range(trace.robots)])
            if trace.robots > 1:
                _name_patches(last, {f"robot {robot}": color(robot) for robot in range(trace.robots)})


def _name_patches(panel: Axes, colors: Mapping[str, str]) -> None:
    """Put the names of colors to the right of a panel."""
    for name, each in colors.items():
        panel.plot([], [], ls="", marker="s", ms=6, color=each, label=name)
    legend(panel)
