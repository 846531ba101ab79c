"""An episode from above: what is around, what is marked, and each robot's path in the colors of its behaviors."""

from __future__ import annotations

from functools import partial
from itertools import groupby
from math import atan2, cos, isfinite, pi, radians, sin
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy.typing as npt
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from bbsd.evaluation import Scene, Trace

    Floats = npt.NDArray[np.float64]

INK, FAINT, WALL, PAPER, MARK = "#333333", "#777777", "#c4c4c4", "#ffffff", "#f0e442"
MARGIN = 0.03
"""Around all that is shown, in parts of its larger side."""
PATH, TRAIL = 2.2, 1.0
"""Widths of lines in points: of a robot's path, and of what else moves."""
ROUND, NOSE = radians(55), 1.9
"""Of a robot that faces to the right: where its round back begins and ends, and its nose, in its radii."""
SIZE, NUMBERED = 7.0, 11.0
"""Widths of robots in points, without and with a number in them."""
NEAR, LETTER = 0.02, 0.016
"""How far a label is from what it names, and how wide its letters are, in parts of the width shown."""
SHORT, DOT = 0.006, 3.6
"""What is shorter, in parts of the width shown, is drawn as a dot of so many points."""
LEGEND_COLUMNS = 3
OVER_PATHS = 4
"""The layer of what must not be hidden by a path."""


class Limits(NamedTuple):
    """What of the plane is shown: each axis runs from its first number to its second."""

    x: tuple[float, float]
    y: tuple[float, float]

    @property
    def shape(self) -> float:
        """Height divided by width."""
        return abs(self.y[1] - self.y[0]) / abs(self.x[1] - self.x[0])


def limits_of(scene: Scene) -> Limits:
    """Return the limits that show everything: what is around, and where anything was."""
    corners = _corners(scene)
    around = [scene.circles[:, :2] + side * scene.circles[:, 2:] for side in (-1, 1)]
    tracks = [scene.places[..., :2].reshape(-1, 2), *(track[:, :2] for track in scene.marks.values())]
    points = np.concatenate([corners, *around, *tracks])
    points = points[np.isfinite(points).all(axis=1)]
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(2), np.zeros(2))
    margin = MARGIN * float(max(high - low)) or 1.0
    axes = [(float(a) - margin, float(b) + margin) for a, b in zip(low, high, strict=True)]
    turned = corners[0] > corners[1] if len(corners) else (False, False)
    x, y = (axis[::-1] if is_turned else axis for axis, is_turned in zip(axes, turned, strict=True))
    return Limits(x, y)


def _corners(scene: Scene) -> Floats:
    """Return the corners of what is around, at bottom left and top right; none where nothing is said, (0, 2)."""
    found = np.empty((0, 2)) if scene.area is None else scene.area.reshape(2, 2)
    if scene.area is None and scene.grid is not None:
        rows, columns = scene.grid.shape
        found = np.array([[-0.5, rows - 0.5], [columns - 0.5, -0.5]])
    return found if np.isfinite(found).all() else np.empty((0, 2))


def draw_scene(panel: Axes, trace: Trace, scene: Scene, colors: Mapping[str, str]) -> None:
    """Draw an episode from above; `colors` are those of whatever controlled, in the order of the legend."""
    limits = limits_of(scene)
    panel.set(xlim=limits.x, ylim=limits.y, aspect="equal", anchor="N")
    panel.set_title(f"from above, {len(trace.steps)} steps")
    panel.grid(visible=False)
    panel.spines[:].set_visible(False)
    panel.tick_params(length=0)
    _draw_surroundings(panel, scene)
    for places, controlling in zip(scene.places, trace.controlling, strict=True):
        _draw_path(panel, places, controlling, colors, limits)
    for name, track in scene.marks.items():
        _draw_mark(panel, track)
        _write(panel, name, track[-1], scene, limits)
    for robot, places in enumerate(scene.places):
        name = str(robot) if trace.robots > 1 else ""
        _draw_robot(panel, places[0], None, name, PAPER, INK)
        _draw_body(panel, places[-1])
        _draw_robot(panel, places[-1], _angle(scene, robot, limits), name, INK, PAPER)
    in_control = {name for robot in trace.controlling for name in robot}
    lines = [_line(color, name) for name, color in colors.items() if name in in_control]
    handles = [*lines, *_ends_explained(scene)]
    panel.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.05), ncols=LEGEND_COLUMNS)


def _draw_surroundings(panel: Axes, scene: Scene) -> None:
    from matplotlib.patches import Circle, Rectangle

    corners = _corners(scene)
    if scene.area is not None and len(corners):
        panel.add_patch(Rectangle(tuple(corners[0]), *(corners[1] - corners[0]), fill=False, ec=INK, lw=2))
    for row, column in np.argwhere(scene.grid != 0) if scene.grid is not None else ():
        panel.add_patch(Rectangle((column - 0.5, row - 0.5), 1, 1, fc=WALL, ec=WALL, lw=0.5))
    for x, y, radius in scene.circles:
        panel.add_patch(Circle((x, y), max(radius, 0), fc=WALL, ec=FAINT, lw=0.8))


def _draw_mark(panel: Axes, track: Floats) -> None:
    """Draw where a mark is at the end, and how it came there: a trail if it moves, else the places it rested at."""
    from matplotlib.patches import Circle

    points, last = track[:, :2], track[-1]
    moved = (points[1:] != points[:-1]).any(axis=1)
    is_moving = moved.mean() > 0.5
    if is_moving:
        panel.plot(*points.T, color=FAINT, lw=TRAIL, ls=(0, (3, 1.5)), zorder=1.5)
    earlier = points[:1] if is_moving else points[:-1][moved]
    panel.plot(*earlier.T, ls="", marker="D", ms=6, mfc=PAPER, mec=FAINT, zorder=OVER_PATHS)
    panel.plot(*last[:2], marker="D", ms=10, mfc=MARK, mec=INK, zorder=OVER_PATHS)
    if len(last) > 2:
        panel.add_patch(
            Circle((last[0], last[1]), max(last[2], 0), fill=False, ec=FAINT, lw=0.9, ls=(0, (2, 2)))
        )


def _write(panel: Axes, text: str, place: Floats, scene: Scene, limits: Limits) -> None:
    """Write beside a place, on the side that is farthest from where robots and marks were."""
    free = partial(_free, place, len(text), scene, limits)
    side, above = max(((side, above) for above in (1, -1) for side in (1, -1)), key=free)
    panel.annotate(
        text,
        (place[0], place[1]),
        (7 * side, 3 * above),
        textcoords="offset points",
        ha="left" if side > 0 else "right",
        va="bottom" if above > 0 else "top",
        color=INK,
        path_effects=[_halo()],
        zorder=OVER_PATHS + 2,
    )


def _free(place: Floats, length: int, scene: Scene, limits: Limits, sides: tuple[int, int]) -> float:
    """Return how far a label on a side of a place is from anything else; less than 0 where it crosses a border."""
    (left, right), (bottom, top) = limits
    unit = np.array([right - left, abs(right - left) * np.sign(top - bottom)]) * sides
    along = np.linspace(NEAR, NEAR + LETTER * length, 5)
    label = place[:2] + unit * np.stack([along, np.full(5, NEAR)], axis=1)
    inside = (label - (left, bottom)) / (right - left, top - bottom)
    if not ((inside > 0) & (inside < 1)).all():
        return -1.0
    others = np.concatenate([track[:, :2] for track in (*scene.places, *scene.marks.values(), scene.circles)])
    others = others[np.isfinite(others).all(axis=1)]
    return float(np.hypot(*(others[:, None] - label).reshape(-1, 2).T).min())


def _draw_path(
    panel: Axes, places: Floats, controlling: Sequence[str], colors: Mapping[str, str], limits: Limits
) -> None:
    """Draw a line from the start on, each stretch in the color of what controlled; later ones pass over earlier.

    A stretch too short to be seen is a dot. Of dots in one place those of who controlled least are on top.
    """
    from matplotlib.collections import LineCollection

    stretches = _stretches(places[:, :2], controlling)
    panel.add_collection(
        LineCollection(
            [points for _, points in stretches],
            colors=[colors[name] for name, _ in stretches],
            linewidths=PATH,
            capstyle="round",
            joinstyle="round",
            path_effects=[_halo(PATH)],
            zorder=2,
        )
    )
    short = SHORT * abs(limits.x[1] - limits.x[0])
    for name in sorted(colors, key=controlling.count, reverse=True):
        dots = [points[-1] for who, points in stretches if who == name and _length(points) < short]
        panel.plot(
            *np.reshape(dots, (-1, 2)).T, ls="", marker="o", ms=DOT, mew=0, color=colors[name], zorder=3
        )


def _stretches(points: Floats, controlling: Sequence[str]) -> list[tuple[str, Floats]]:
    """Return who controlled in turn, and the points on the way, the one where that began included."""
    found, first = [], 0
    for name, group in groupby(controlling):
        last = first + len(list(group))
        found.append((name, points[first : last + 1]))
        first = last
    return found


def _length(points: Floats) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def _draw_robot(panel: Axes, place: Floats, angle: float | None, name: str, fill: str, edge: str) -> None:
    size = NUMBERED if name else SIZE
    size = size if angle is None else size * NOSE
    panel.plot(*place[:2], marker=_outline(angle), ms=size, mfc=fill, mec=INK, mew=1.0, zorder=OVER_PATHS + 1)
    panel.annotate(
        name,
        (place[0], place[1]),
        ha="center",
        va="center_baseline",
        fontsize=7,
        color=edge,
        zorder=OVER_PATHS + 1,
    )


def _draw_body(panel: Axes, place: Floats) -> None:
    """Draw a robot's radius, if it has one, to scale."""
    from matplotlib.patches import Circle

    if len(place) > 2:
        panel.add_patch(
            Circle((place[0], place[1]), max(place[2], 0), fc=PAPER, ec=INK, lw=1.0, zorder=OVER_PATHS)
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
    (left, right), (bottom, top) = limits
    return atan2(sin(heading) * np.sign(top - bottom), cos(heading) * np.sign(right - left))


def _halo(width: float = 0.0) -> Any:  # noqa: ANN401 - what matplotlib takes for an effect
    """Return an effect that sets off a line or a text from what it passes over; a line's ends stay as they are."""
    from matplotlib.patheffects import withStroke

    return withStroke(linewidth=width + 1.6, foreground=PAPER, capstyle="butt")


def _line(chosen: str, label: str) -> Artist:
    from matplotlib.lines import Line2D

    return Line2D([], [], color=chosen, lw=PATH, label=label)


def _ends_explained(scene: Scene) -> list[Artist]:
    from matplotlib.lines import Line2D

    faces = scene.headings is not None
    outline, size = _outline(0.0 if faces else None), SIZE * (NOSE if faces else 1)
    return [
        Line2D([], [], ls="", marker="o", ms=SIZE, mfc=PAPER, mec=INK, label="start"),
        Line2D([], [], ls="", marker=outline, ms=size, mfc=INK, mec=INK, label="end"),
    ]
