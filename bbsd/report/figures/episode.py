"""One episode of a team over its steps, as in the paper's Fig. 22."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.report.figures.files import color, legend, panels_in_file
from bbsd.report.figures.panels import MAX_PANELS, behavior_rows, draw_control, draw_lines, panels_of

if TYPE_CHECKING:
    from pathlib import Path

    from bbsd.evaluation import Trace
    from bbsd.language.models import Spec

PANEL, ROW = 1.35, 0.3
"""Heights in inches: of a value, and of a behavior."""


def draw_episode(trace: Trace, spec: Spec, path: Path) -> None:
    """Draw the robots' states, what all of them sensed alike, and which behavior controlled each robot.

    The values are those after each step: a panel for each state with a line for each robot, one for each
    value of the world and for each sensor that is a number and the same for all robots; at most eight
    panels, in the spec's order. A spec with a view is drawn from above, with these panels beside it. Raises
    FigureError for a kind of file that cannot be drawn, and OSError where it cannot be written.
    """
    if trace.scene is None:
        _draw_lines_only(trace, spec, path)
    else:
        from bbsd.report.figures.scene import draw_with_scene

        draw_with_scene(trace, spec, trace.scene, path)


def _draw_lines_only(trace: Trace, spec: Spec, path: Path) -> None:
    shown = dict(list(panels_of(trace, spec).items())[:MAX_PANELS])
    behaviors = behavior_rows(trace, spec)
    heights = [PANEL] * len(shown) + [0.7 + ROW * len(behaviors)]
    with panels_in_file(path, 8.0, heights) as panels:
        for panel, (name, lines) in zip(panels, shown.items(), strict=False):
            draw_lines(panel, trace, name, lines)
        draw_control(panels[-1], trace, behaviors, [color(robot) for robot in range(trace.robots)])
        legend(panels[0])
