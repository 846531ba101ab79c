"""The plane that an episode is drawn on: its limits and its surroundings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes

    from bbsd.evaluation import Scene

    Floats = npt.NDArray[np.float64]

INK, FAINT, SOLID, PAPER = "#333333", "#777777", "#c4c4c4", "#ffffff"
MARGIN = 0.03
"""The margin around everything, as a share of the larger side."""
LINE_WIDTH = 2.0
"""Of the view's own lines, in points."""
OVER_PATHS = 4
"""The drawing order (zorder) of what no path may cover."""


class Limits(NamedTuple):
    """The part of the plane that is shown; each axis runs from its first number to its second."""

    x: tuple[float, float]
    y: tuple[float, float]

    @property
    def width(self) -> float:
        """The width shown."""
        return abs(self.x[1] - self.x[0])

    @property
    def shape(self) -> float:
        """Height divided by width."""
        return abs(self.y[1] - self.y[0]) / self.width

    @property
    def signs(self) -> tuple[float, float]:
        """For each axis, 1 if it grows to the right or upward, else -1."""
        return (1.0 if self.x[0] < self.x[1] else -1.0), (1.0 if self.y[0] < self.y[1] else -1.0)


def limits_of(scene: Scene) -> Limits:
    """Return the limits that show everything: the surroundings, and all places of robots and marks."""
    corners = _corners(scene)
    around = [scene.circles[:, :2] + side * scene.circles[:, 2:] for side in (-1, 1)]
    points = drawable(np.concatenate([corners, *around, *scene.paths.values(), *_tracks(scene)]))
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(2), np.zeros(2))
    margin = MARGIN * float(max(high - low)) or 1.0
    axes = [(float(a) - margin, float(b) + margin) for a, b in zip(low, high, strict=True)]
    reversals = corners[0] > corners[1] if len(corners) else (False, False)
    x, y = (axis[::-1] if is_reversed else axis for axis, is_reversed in zip(axes, reversals, strict=True))
    return Limits(x, y)


def occupied(scene: Scene) -> Floats:
    """Return all places of robots and marks, the centers of circles, and the points of lines (n, 2)."""
    return drawable(np.concatenate([*_tracks(scene), scene.circles[:, :2], *scene.paths.values()]))


def drawable(points: Floats) -> Floats:
    """Return the points whose coordinates are finite."""
    return points[np.isfinite(points).all(axis=-1)]


def draw_surroundings(panel: Axes, scene: Scene) -> None:
    """Draw the outer walls, the grid, the circles and the lines."""
    from matplotlib.patches import Rectangle

    corners = _corners(scene)
    if scene.area is not None and len(corners):
        panel.add_patch(Rectangle(tuple(corners[0]), *(corners[1] - corners[0]), fill=False, ec=INK, lw=2))
    for row, column in np.argwhere(scene.grid != 0) if scene.grid is not None else ():
        panel.add_patch(Rectangle((column - 0.5, row - 0.5), 1, 1, fc=SOLID, ec=SOLID, lw=0.5))
    for circle in scene.circles:
        draw_circle(panel, circle, fc=SOLID, ec=FAINT, lw=0.8)
    for path in scene.paths.values():
        panel.plot(*path.T, color=FAINT, lw=LINE_WIDTH, solid_joinstyle="round", zorder=1.2)


def draw_circle(panel: Axes, place: Floats, **style: Any) -> None:  # noqa: ANN401 - as matplotlib types styles
    """Draw a place with a radius as a circle to scale; one without is not drawn."""
    from matplotlib.patches import Circle

    if len(place) > 2 and np.isfinite(place).all():
        panel.add_patch(Circle((place[0], place[1]), max(place[2], 0), **style))


def halo(width: float = 0.0) -> Any:  # noqa: ANN401 - as matplotlib types effects
    """Return an effect that outlines a line or a text, but not the ends of a line, to set it off from what is below."""
    from matplotlib.patheffects import withStroke

    return withStroke(linewidth=width + 1.6, foreground=PAPER, capstyle="butt")


def _tracks(scene: Scene) -> list[Floats]:
    return [track[:, :2] for track in (*scene.places, *scene.marks.values())]


def _corners(scene: Scene) -> Floats:
    """Return the bottom left and top right corners of the surroundings (2, 2), or none (0, 2) if they are unknown."""
    corners = np.empty((0, 2)) if scene.area is None else scene.area.reshape(2, 2)
    if scene.area is None and scene.grid is not None:
        rows, columns = scene.grid.shape
        corners = np.array([[-0.5, rows - 0.5], [columns - 0.5, -0.5]])
    return corners if np.isfinite(corners).all() else np.empty((0, 2))
