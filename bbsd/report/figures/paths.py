"""Robots on their way: paths in the colors of what controlled, where they started and where they face at the end."""

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

PATH = 2.2
"""Width in points."""
SHORT, DOT = 0.006, 3.6
"""What is shorter, in parts of the width shown, is drawn as a dot of so many points."""
ROUND, NOSE = radians(55), 1.9
"""Of a robot that faces to the right: where its round back begins and ends, and its nose, in its radii."""
SIZE, NUMBERED = 7.0, 11.0
"""Widths of robots in points, without and with a number in them."""


def draw_path(
    panel: Axes, places: Floats, controlling: Sequence[str], colors: Mapping[str, str], limits: Limits
) -> None:
    """Draw a line from the start on, each stretch in the color of what controlled; later ones pass over earlier.

    A stretch too short to be seen is a dot. Of dots in one place those of who controlled least are on top.
    """
    from matplotlib.collections import LineCollection

    stretches = stretches_of(places[:, :2], controlling)
    lines = LineCollection(
        [points for _, points in stretches],
        colors=[colors[name] for name, _ in stretches],
        linewidths=PATH,
        capstyle="round",
        joinstyle="round",
        path_effects=[halo(PATH)],
        zorder=2,
    )
    panel.add_collection(lines)
    for name in sorted(colors, key=controlling.count, reverse=True):
        short = [
            points[-1] for who, points in stretches if who == name and _length(points) < SHORT * limits.width
        ]
        dots = drawable(np.reshape(short, (-1, 2)))
        panel.plot(*dots.T, ls="", marker="o", ms=DOT, mew=0, color=colors[name], zorder=3)


def stretches_of(points: Floats, controlling: Sequence[str]) -> list[tuple[str, Floats]]:
    """Return who controlled in turn, and the points on the way, the one where that began included."""
    found, first = [], 0
    for name, group in groupby(controlling):
        last = first + len(list(group))
        found.append((name, points[first : last + 1]))
        first = last
    return found


def _length(points: Floats) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def draw_ends(panel: Axes, scene: Scene, robot: int, limits: Limits) -> None:
    """Draw a robot at the start, hollow, and at the end, with its body to scale and where it faces."""
    first, last = scene.places[robot, 0], scene.places[robot, -1]
    name = str(robot) if len(scene.places) > 1 else ""
    _draw_robot(panel, first, None, name, PAPER, INK)
    draw_circle(panel, last, fc=PAPER, ec=INK, lw=1.0, zorder=OVER_PATHS)
    _draw_robot(panel, last, _angle(scene, robot, limits), name, INK, PAPER)


def _draw_robot(panel: Axes, place: Floats, angle: float | None, name: str, fill: str, ink: str) -> None:
    if not np.isfinite(place[:2]).all():
        return
    size = (NUMBERED if name else SIZE) * (1 if angle is None else NOSE)
    panel.plot(*place[:2], marker=_outline(angle), ms=size, mfc=fill, mec=INK, mew=1, zorder=OVER_PATHS + 1)
    point = (place[0], place[1])
    panel.annotate(
        name, point, ha="center", va="center_baseline", fontsize=7, color=ink, zorder=OVER_PATHS + 1
    )


def _outline(angle: float | None) -> Any:  # noqa: ANN401 - what matplotlib takes for a marker
    """Return a round marker, with a nose where a robot faces."""
    from matplotlib.markers import MarkerStyle
    from matplotlib.transforms import Affine2D

    if angle is None:
        return "o"
    back = [(cos(at), sin(at)) for at in np.linspace(ROUND, 2 * pi - ROUND, 25)]
    return MarkerStyle([(NOSE, 0.0), *back, (NOSE, 0.0)], transform=Affine2D().rotate(angle))


def _angle(scene: Scene, robot: int, limits: Limits) -> float | None:
    """Return where a robot faces at the end on the page, in radians to the left; None where that is not said."""
    heading = float("nan") if scene.headings is None else float(scene.headings[robot, -1])
    if not isfinite(heading):
        return None
    x, y = limits.signs
    return atan2(y * sin(heading), x * cos(heading))


def legend_of(scene: Scene, colors: Mapping[str, str]) -> list[Artist]:
    """Return what explains lines of these colors, starts and ends."""
    from matplotlib.lines import Line2D

    faces = scene.headings is not None
    outline, size = _outline(0.0 if faces else None), SIZE * (NOSE if faces else 1)
    return [
        *(Line2D([], [], color=color, lw=PATH, label=name) for name, color in colors.items()),
        Line2D([], [], ls="", marker="o", ms=SIZE, mfc=PAPER, mec=INK, label="start"),
        Line2D([], [], ls="", marker=outline, ms=size, mfc=INK, mec=INK, label="end"),
    ]
