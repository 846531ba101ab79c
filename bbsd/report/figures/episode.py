"""The figure of an episode over its steps, as in the paper's Fig. 22."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.report.figures.files import color, legend, panels_in_file
from bbsd.report.figures.panels import MAX_PANELS, behavior_rows, draw_control, draw_lines, panels_of

if TYPE_CHECKING:
    from pathlib import Path

    from bbsd.evaluation import Trace
    from bbsd.language.models import Spec

PANEL_HEIGHT, ROW_HEIGHT = 1.35, 0.3
"""Heights in inches: of the panel of a value, and of the row of a behavior."""


def draw_episode(trace: Trace, spec: Spec, path: Path) -> None:
    """Draw the values of an episode after each step, and the behavior in control of each robot.

    A state has a panel with a line for each robot; a value of the world, and a sensor that is a number and equal
    for all robots, have a panel with one line. There are at most eight panels of values, in the spec's order. If the
    spec has a view, the episode is drawn from above, with these panels beside it. Raises FigureError for an unknown
    kind of file, and OSError if the file cannot be written.
    """
    if trace.scene is None:
        _draw_lines_only(trace, spec, path)
    else:
        from bbsd.report.figures.scene import draw_with_scene

        draw_with_scene(trace, spec, trace.scene, path)


def _draw_lines_only(trace: Trace, spec: Spec, path: Path) -> None:
    values = dict(list(panels_of(trace, spec).items())[:MAX_PANELS])
    behaviors = behavior_rows(trace, spec)
    heights = [PANEL_HEIGHT] * len(values) + [0.7 + ROW_HEIGHT * len(behaviors)]
    with panels_in_file(path, 8.0, heights) as panels:
        for panel, (name, lines) in zip(panels, values.items(), strict=False):
            draw_lines(panel, trace, name, lines)
        draw_control(panels[-1], trace, behaviors, [color(robot) for robot in range(trace.robots)])
        legend(panels[0])
