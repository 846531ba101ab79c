"""An episode from above: what is around, what is marked, and each robot's path in the colors of its behaviors."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.tree import Name
from bbsd.language.field_types import expressions_in
from bbsd.report.figures.files import color, figure_in_file, legend, stack_panels
from bbsd.report.figures.marks import draw_mark
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

PANEL, ROW = 0.68, 0.24
"""Least heights in inches beside a scene: of a value, and of a behavior."""
SCENE, BESIDE = 5.2, 4.0
"""Widths in inches: of a scene, and of the panels beside it."""
LOWEST, HIGHEST, AROUND, LEGEND_LINE = 2.5, 7.0, 0.7, 0.2
"""Heights in inches: a scene's at least and at most, its title and axis, a line of its legend."""
NOBODY_COLOR = "#9a9a9a"
MAX_NAMED = 8
"""Robots at most whose lines are: of more nobody could."""
LEGEND_COLUMNS = 3


def draw_with_scene(trace: Trace, spec: Spec, scene: Scene, path: Path) -> None:
    """Draw the scene on the left, and what it does not show on the right; colors are those of the behaviors."""
    seen, behaviors, order = _names_seen(spec.view), behavior_rows(trace, spec), [*spec.behaviors]
    unseen = [(name, lines) for name, lines in panels_of(trace, spec).items() if name not in seen]
    colors = {name: NOBODY_COLOR if name == NOBODY else color(order.index(name)) for name in behaviors}
    heights = _heights(scene, len(unseen[:MAX_PANELS]), len(behaviors))
    with figure_in_file(path, SCENE + BESIDE, sum(heights)) as figure:
        left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=[SCENE, BESIDE])[0]
        draw_scene(left.subplots(), trace, scene, colors)
        *panels, last = stack_panels(right, heights)
        for panel, (name, lines) in zip(panels, unseen, strict=False):
            draw_lines(panel, trace, name, lines, in_gray=True)
        draw_control(last, trace, behaviors, colors)
        if trace.robots <= MAX_NAMED and panels:
            legend(panels[0])


def _heights(scene: Scene, n_values: int, n_behaviors: int) -> list[float]:
    """Return the heights of the panels beside a scene, in inches; together at least as high as the scene."""
    last = 0.6 + ROW * n_behaviors
    whole = min(max(SCENE * limits_of(scene).shape, LOWEST), HIGHEST) + AROUND
    whole = max(whole + LEGEND_LINE * legend_lines(n_behaviors), PANEL * n_values + last)
    return [*[(whole - last) / max(n_values, 1)] * n_values, last if n_values else whole]


def _names_seen(view: View | None) -> set[str]:
    """Return the names that stand alone in a view: what they hold can be seen in the scene."""
    written = [view.at, *([view.heading] if view.heading else ()), *view.marks.values()] if view else []
    trees = [each.tree for value in written for each in expressions_in(value)]
    return {tree.name for tree in trees if isinstance(tree, Name)}


def legend_lines(n_behaviors: int) -> int:
    """Return of how many lines the legend is, with one entry for a behavior and two for the ends of paths."""
    return -(-(n_behaviors + 2) // LEGEND_COLUMNS)


def draw_scene(panel: Axes, trace: Trace, scene: Scene, colors: Mapping[str, str]) -> None:
    """Draw an episode from above; `colors` are those of whatever controlled, in the order of the legend."""
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
    for robot in range(trace.robots):
        draw_ends(panel, scene, robot, limits)
    in_control = {name for robot in trace.controlling for name in robot}
    handles = legend_of(scene, {name: color for name, color in colors.items() if name in in_control})
    panel.legend(
        handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=2.8, ncols=LEGEND_COLUMNS
    )
