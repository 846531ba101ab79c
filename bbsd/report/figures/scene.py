"""The figure of an episode from above: surroundings, marks, and the robots' paths, with panels beside it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.tree import Name
from bbsd.language.field_types import expressions_in
from bbsd.report.figures.choice import choice_of
from bbsd.report.figures.control import (
    behavior_colors,
    behavior_rows,
    control_height,
    draw_control_by_behavior,
    draw_control_by_robot,
)
from bbsd.report.figures.files import stack_panels
from bbsd.report.figures.layout import draw_panels, reward_height, title_of, titled_figure, value_height
from bbsd.report.figures.marks import draw_mark, draw_names
from bbsd.report.figures.panels import is_strip
from bbsd.report.figures.paths import draw_ends, draw_path, legend_of
from bbsd.report.figures.plane import draw_surroundings, limits_of, occupied

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from matplotlib.axes import Axes

    from bbsd.evaluation import Scene, Trace
    from bbsd.language.models import Spec
    from bbsd.language.view import View
    from bbsd.report.figures.choice import Choice

MIN_PANEL_HEIGHT = 0.68
"""The height in inches of the panel of a value at least."""
SCENE_WIDTH, PANELS_WIDTH = 5.2, 4.4
"""Widths in inches: of a scene, and of the panels beside it."""
MIN_HEIGHT, MAX_HEIGHT, TITLE_HEIGHT, LEGEND_LINE = 2.5, 7.0, 0.7, 0.2
"""Heights in inches: of a scene at least and at most, of its title and axis, of a line of its legend."""
LETTERS_OF_LEGEND, MOST_COLUMNS = 66, 3
"""Letters beside each other in a scene's legend, those that an entry's line takes included, and columns at most."""


def draw_with_scene(
    trace: Trace, spec: Spec, scene: Scene, path: Path, episode: int | None, show: Sequence[str]
) -> None:
    """Draw the scene on the left, and values that it does not show on the right; colors stand for behaviors."""
    behaviors = behavior_rows(trace)
    choice = choice_of(trace, spec, _names_in_view(spec.view), show)
    colors = behavior_colors(behaviors, spec)
    heights = _heights(trace, scene, choice, behaviors)
    width = SCENE_WIDTH + PANELS_WIDTH
    with titled_figure(path, width, sum(heights), title_of(trace, spec, episode), choice.left_out) as figure:
        left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=[SCENE_WIDTH, PANELS_WIDTH])[0]
        draw_scene(left.subplots(), trace, scene, colors)
        *panels, last = stack_panels(right, heights)
        draw_panels(panels, choice, trace, heights, in_gray=True)
        if trace.robots > 1:
            draw_control_by_robot(last, trace, colors)
        else:
            draw_control_by_behavior(last, trace, behaviors, colors)


def _heights(trace: Trace, scene: Scene, choice: Choice, behaviors: Sequence[str]) -> list[float]:
    """Return the heights in inches of the panels beside a scene, together at least as high as the scene."""
    last = control_height(trace, behaviors, by_robot=trace.robots > 1)
    whole = min(max(SCENE_WIDTH * limits_of(scene).shape, MIN_HEIGHT), MAX_HEIGHT) + TITLE_HEIGHT
    whole += LEGEND_LINE * legend_lines(behaviors)
    least = [
        value_height(shown, in_gray=True) if is_strip(shown, in_gray=True) else MIN_PANEL_HEIGHT
        for shown in choice.panels
    ]
    least += [max(1.4 * MIN_PANEL_HEIGHT, reward_height(trace))] if choice.reward else []
    spare = max(whole - last - sum(least), 0.0)
    heights = [height + spare * height / sum(least) for height in least]
    return [*heights, last if heights else max(last, whole)]


def _names_in_view(view: View | None) -> set[str]:
    """Return the names that a view consists of: their values are visible in the scene."""
    written = [view.at, *([view.heading] if view.heading else ()), *view.marks.values()] if view else []
    trees = [expression.tree for value in written for expression in expressions_in(value)]
    return {tree.name for tree in trees if isinstance(tree, Name)}


def legend_columns(behaviors: Sequence[str]) -> int:
    """Return the number of columns of a scene's legend, fewer where names are long."""
    longest = max(map(len, behaviors), default=0) + 8
    return max(1, min(MOST_COLUMNS, LETTERS_OF_LEGEND // longest))


def legend_lines(behaviors: Sequence[str]) -> int:
    """Return the number of lines of the legend, which has an entry for each behavior, the start and the end."""
    return -(-(len(behaviors) + 2) // legend_columns(behaviors))


def draw_scene(panel: Axes, trace: Trace, scene: Scene, colors: Mapping[str, str]) -> None:
    """Draw an episode from above; `colors` of the behaviors and of nobody are in the order of the legend."""
    limits = limits_of(scene)
    panel.set(xlim=limits.x, ylim=limits.y, aspect="equal", anchor="N")
    panel.set_title("from above")
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
        handles=handles,
        loc="upper center",
        bbox_to_anchor=(0.5, 0),
        borderaxespad=2.8,
        ncols=legend_columns([*colors]),
    )
