"""An episode from above: what is around, what is marked, and each robot's path in the colors of its behaviors."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.report.figures.marks import draw_mark
from bbsd.report.figures.paths import draw_ends, draw_path, legend_of
from bbsd.report.figures.plane import draw_surroundings, limits_of, taken

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes

    from bbsd.evaluation import Scene, Trace

LEGEND_COLUMNS = 3


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
        draw_mark(panel, name, track, taken(scene), limits)
    for robot in range(trace.robots):
        draw_ends(panel, scene, robot, limits)
    in_control = {name for robot in trace.controlling for name in robot}
    handles = legend_of(scene, {name: color for name, color in colors.items() if name in in_control})
    panel.legend(
        handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=2.8, ncols=LEGEND_COLUMNS
    )
