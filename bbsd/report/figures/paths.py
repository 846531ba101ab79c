"""Paths of robots from above, in the colors of the behaviors in control, with the robots at their start and end."""

from __future__ import annotations

from itertools import groupby
from math import atan2, cos, isfinite, pi, radians, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.report.figures.plane import INK, OVER_PATHS, PAPER, draw_circle, drawable, halo

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy.typing as npt
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from bbsd.evaluation import Scene
    from bbsd.report.figures.plane import Limits

    Floats = npt.NDArray[np.float64]

PATH_WIDTH = 2.2
"""In points."""
MIN_LENGTH, DOT_SIZE = 0.006, 3.6
"""A stretch shorter than this share of the width shown is drawn as a dot of this size in points."""
BACK_ANGLE, NOSE_LENGTH = radians(55), 1.9
"""The outline of a robot: the angle from its nose at which its round back begins, its nose from its center in radii."""
ROBOT_SIZE, NUMBERED_ROBOT_SIZE = 7.0, 11.0
"""Sizes of robots in points, without and with a number in them."""


def draw_path(
    panel: Axes, places: Floats, controlling: Sequence[str], colors: Mapping[str, str], limits: Limits
) -> None:
    """Draw a robot's path, each stretch in the color of the behavior in control; later stretches cover earlier ones.

    A stretch too short to see is drawn as a dot; dots of behaviors that controlled less cover those of others.
    """
    from matplotlib.collections import LineCollection

    stretches = stretches_of(places[:, :2], controlling)
    lines = LineCollection(
        [points for _, points in stretches],
        colors=[colors[name] for name, _ in stretches],
        linewidths=PATH_WIDTH,
        capstyle="round",
        joinstyle="round",
        path_effects=[halo(PATH_WIDTH)],
        zorder=2,
    )
    panel.add_collection(lines)
    for name in sorted(colors, key=controlling.count, reverse=True):
        short = [
            points[-1]
            for who, points in stretches
            if who == name and _length(points) < MIN_LENGTH * limits.width
        ]
        dots = drawable(np.reshape(short, (-1, 2)))
        panel.plot(*dots.T, ls="", marker="o", ms=DOT_SIZE, mew=0, color=colors[name], zorder=3)


def stretches_of(points: Floats, controlling: Sequence[str]) -> list[tuple[str, Floats]]:
    """Return the behaviors that controlled in turn, each with its points (n, 2), the one where it began included."""
    stretches, first = [], 0
    for name, group in groupby(controlling):
        last = first + len(list(group))
        stretches.append((name, points[first : last + 1]))
        first = last
    return stretches


def _length(points: Floats) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def draw_ends(panel: Axes, scene: Scene, robot: int, limits: Limits) -> None:
    """Draw a robot at its start, hollow, and at its end, filled, with its body to scale and its heading."""
    first, last = scene.places[robot, 0], scene.places[robot, -1]
    name = str(robot) if len(scene.places) > 1 else ""
    _draw_robot(panel, first, None, name, PAPER, INK)
    draw_circle(panel, last, fc=PAPER, ec=INK, lw=1.0, zorder=OVER_PATHS)
    _draw_robot(panel, last, _angle(scene, robot, limits), name, INK, PAPER)


def _draw_robot(panel: Axes, place: Floats, angle: float | None, name: str, fill: str, ink: str) -> None:
    if not np.isfinite(place[:2]).all():
        return
    size = (NUMBERED_ROBOT_SIZE if name else ROBOT_SIZE) * (1 if angle is None else NOSE_LENGTH)
    panel.plot(*place[:2], marker=_outline(angle), ms=size, mfc=fill, mec=INK, mew=1, zorder=OVER_PATHS + 1)
    point = (place[0], place[1])
    panel.annotate(
        name, point, ha="center", va="center_baseline", fontsize=7, color=ink, zorder=OVER_PATHS + 1
    )


def _outline(angle: float | None) -> Any:  # noqa: ANN401 - as matplotlib types markers
    """Return a round marker, with a nose in the direction of the heading if there is one."""
    from matplotlib.markers import MarkerStyle
    from matplotlib.transforms import Affine2D

    if angle is None:
        return "o"
    back = [(cos(at), sin(at)) for at in np.linspace(BACK_ANGLE, 2 * pi - BACK_ANGLE, 25)]
    return MarkerStyle([(NOSE_LENGTH, 0.0), *back, (NOSE_LENGTH, 0.0)], transform=Affine2D().rotate(angle))


def _angle(scene: Scene, robot: int, limits: Limits) -> float | None:
    """Return a robot's last heading on the page, in radians counterclockwise from the right; None if unknown."""
    heading = float("nan") if scene.headings is None else float(scene.headings[robot, -1])
    if not isfinite(heading):
        return None
    x, y = limits.signs
    return atan2(y * sin(heading), x * cos(heading))


def legend_of(scene: Scene, colors: Mapping[str, str]) -> list[Artist]:
    """Return the entries of the legend: behaviors by color, start and end."""
    from matplotlib.lines import Line2D

    faces = scene.headings is not None
    outline, size = _outline(0.0 if faces else None), ROBOT_SIZE * (NOSE_LENGTH if faces else 1)
    return [
        *(Line2D([], [], color=color, lw=PATH_WIDTH, label=name) for name, color in colors.items()),
        Line2D([], [], ls="", marker="o", ms=ROBOT_SIZE, mfc=PAPER, mec=INK, label="start"),
        Line2D([], [], ls="", marker=outline, ms=size, mfc=INK, mec=INK, label="end"),
    ]
