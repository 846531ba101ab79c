"""The figure of an episode from above: surroundings, marks, and the robots' paths, with panels beside it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.tree import Name
from bbsd.language.field_types import expressions_in
from bbsd.report.figures.files import color, figure_in_file, legend, stack_panels
from bbsd.report.figures.marks import draw_mark, draw_names
from bbsd.report.figures.panels import MAX_PANELS, NOBODY, behavior_rows, draw_control, draw_lines, panels_of
from bbsd.report.figures.paths import draw_ends, draw_path, legend_of
from bbsd.report.figures.plane import draw_surroundings, limits_of, occupied

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from matplotlib.axes import Axes

    from bbsd.evaluation import Scene, Trace
    from bbsd.language.models import Spec
    from bbsd.language.view import View

MIN_PANEL_HEIGHT, ROW_HEIGHT = 0.68, 0.24
"""Heights in inches: of the panel of a value at least, and of the row of a behavior."""
SCENE_WIDTH, PANELS_WIDTH = 5.2, 4.0
"""Widths in inches: of a scene, and of the panels beside it."""
MIN_HEIGHT, MAX_HEIGHT, TITLE_HEIGHT, LEGEND_LINE = 2.5, 7.0, 0.7, 0.2
"""Heights in inches: of a scene at least and at most, of its title and axis, of a line of its legend."""
NOBODY_COLOR = "#9a9a9a"
MAX_ROBOTS_IN_LEGEND = 8
"""The number of robots up to which their lines have a legend; nobody could distinguish more."""
LEGEND_COLUMNS = 3


def draw_with_scene(trace: Trace, spec: Spec, scene: Scene, path: Path) -> None:
    """Draw the scene on the left, and values that it does not show on the right; colors stand for behaviors."""
    in_view, behaviors, order = _names_in_view(spec.view), behavior_rows(trace, spec), [*spec.behaviors]
    values = [(name, lines) for name, lines in panels_of(trace, spec).items() if name not in in_view]
    colors = {name: NOBODY_COLOR if name == NOBODY else color(order.index(name)) for name in behaviors}
    heights = _heights(scene, len(values[:MAX_PANELS]), len(behaviors))
    with figure_in_file(path, SCENE_WIDTH + PANELS_WIDTH, sum(heights)) as figure:
        left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=[SCENE_WIDTH, PANELS_WIDTH])[0]
        draw_scene(left.subplots(), trace, scene, colors)
        *panels, last = stack_panels(right, heights)
        for panel, (name, lines) in zip(panels, values, strict=False):
            draw_lines(panel, trace, name, lines, in_gray=True)
        draw_control(last, trace, behaviors, colors)
        if trace.robots <= MAX_ROBOTS_IN_LEGEND and panels:
            legend(panels[0])


def _heights(scene: Scene, n_values: int, n_behaviors: int) -> list[float]:
    """Return the heights in inches of the panels beside a scene, together at least as high as the scene."""
    last = 0.6 + ROW_HEIGHT * n_behaviors
    whole = min(max(SCENE_WIDTH * limits_of(scene).shape, MIN_HEIGHT), MAX_HEIGHT) + TITLE_HEIGHT
    whole = max(whole + LEGEND_LINE * legend_lines(n_behaviors), MIN_PANEL_HEIGHT * n_values + last)
    return [*[(whole - last) / max(n_values, 1)] * n_values, last if n_values else whole]


def _names_in_view(view: View | None) -> set[str]:
    """Return the names that a view consists of: their values are visible in the scene."""
    written = [view.at, *([view.heading] if view.heading else ()), *view.marks.values()] if view else []
    trees = [expression.tree for value in written for expression in expressions_in(value)]
    return {tree.name for tree in trees if isinstance(tree, Name)}


def legend_lines(n_behaviors: int) -> int:
    """Return the number of lines of the legend, which has an entry for each behavior, the start and the end."""
    return -(-(n_behaviors + 2) // LEGEND_COLUMNS)


def draw_scene(panel: Axes, trace: Trace, scene: Scene, colors: Mapping[str, str]) -> None:
    """Draw an episode from above; `colors` of the behaviors and of nobody are in the order of the legend."""
    limits = limits_of(scene)
    panel.set(xlim=limits.x, ylim=limits.y, aspect="equal", anchor="N")
    panel.set_title(f"from above, {len(trace.steps):,} step{'s' * (len(trace.steps) > 1)}")
    panel.grid(visible=False)
    panel.spines[:].set_visible(False)
    panel.tick_params(length=0)
    draw_surroundings(panel, scene)
    for places, controlling in zip(scene.places, trace.controlling, strict=True):
        draw_path(panel, places, controlling, colors, limits)
    for name, track in scene.marks.items():
        draw_mark(panel, name, track, occupied(scene), limits)
    draw_names(panel, scene.paths, occupied(scene), limits)
    for robot in range(trace.robots):
        draw_ends(panel, scene, robot, limits)
    in_control = {name for robot in trace.controlling for name in robot}
    handles = legend_of(scene, {name: color for name, color in colors.items() if name in in_control})
    panel.legend(
        handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=2.8, ncols=LEGEND_COLUMNS
    )
