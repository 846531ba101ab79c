"""What of the plane an episode is drawn on, and what stands in it."""

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
"""Around all that is shown, in parts of its larger side."""
OVER_PATHS = 4
"""The layer of what must not be hidden by a path."""


class Limits(NamedTuple):
    """What of the plane is shown: each axis runs from its first number to its second."""

    x: tuple[float, float]
    y: tuple[float, float]

    @property
    def width(self) -> float:
        """How far it is from the left to the right."""
        return abs(self.x[1] - self.x[0])

    @property
    def shape(self) -> float:
        """Height divided by width."""
        return abs(self.y[1] - self.y[0]) / self.width

    @property
    def signs(self) -> tuple[float, float]:
        """For each axis 1 if it grows to the right or upwards, else -1."""
        return (1.0 if self.x[0] < self.x[1] else -1.0), (1.0 if self.y[0] < self.y[1] else -1.0)


def limits_of(scene: Scene) -> Limits:
    """Return the limits that show everything: what is around, and where anything was."""
    corners = _corners(scene)
    around = [scene.circles[:, :2] + side * scene.circles[:, 2:] for side in (-1, 1)]
    points = drawable(np.concatenate([corners, *around, *_tracks(scene)]))
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(2), np.zeros(2))
    margin = MARGIN * float(max(high - low)) or 1.0
    axes = [(float(a) - margin, float(b) + margin) for a, b in zip(low, high, strict=True)]
    turned = corners[0] > corners[1] if len(corners) else (False, False)
    x, y = (axis[::-1] if is_turned else axis for axis, is_turned in zip(axes, turned, strict=True))
    return Limits(x, y)


def occupied(scene: Scene) -> Floats:
    """Return the points at which robots and marks ever were, and circles are; (n, 2)."""
    return drawable(np.concatenate([*_tracks(scene), scene.circles[:, :2]]))


def drawable(points: Floats) -> Floats:
    """Return those points that can be drawn."""
    return points[np.isfinite(points).all(axis=-1)]


def draw_surroundings(panel: Axes, scene: Scene) -> None:
    """Draw the walls around, the grid, and circles."""
    from matplotlib.patches import Rectangle

    corners = _corners(scene)
    if scene.area is not None and len(corners):
        panel.add_patch(Rectangle(tuple(corners[0]), *(corners[1] - corners[0]), fill=False, ec=INK, lw=2))
    for row, column in np.argwhere(scene.grid != 0) if scene.grid is not None else ():
        panel.add_patch(Rectangle((column - 0.5, row - 0.5), 1, 1, fc=SOLID, ec=SOLID, lw=0.5))
    for circle in scene.circles:
        draw_circle(panel, circle, fc=SOLID, ec=FAINT, lw=0.8)


def draw_circle(panel: Axes, place: Floats, **style: Any) -> None:  # noqa: ANN401 - as matplotlib has them
    """Draw the radius of a place, if it has one, to scale."""
    from matplotlib.patches import Circle

    if len(place) > 2 and np.isfinite(place).all():
        panel.add_patch(Circle((place[0], place[1]), max(place[2], 0), **style))


def halo(width: float = 0.0) -> Any:  # noqa: ANN401 - what matplotlib takes for an effect
    """Return an effect that sets off a line or a text from what it passes over; a line's ends stay as they are."""
    from matplotlib.patheffects import withStroke

    return withStroke(linewidth=width + 1.6, foreground=PAPER, capstyle="butt")


def _tracks(scene: Scene) -> list[Floats]:
    return [track[:, :2] for track in (*scene.places, *scene.marks.values())]


def _corners(scene: Scene) -> Floats:
    """Return the corners of what is around, at bottom left and top right; none where nothing is said, (0, 2)."""
    found = np.empty((0, 2)) if scene.area is None else scene.area.reshape(2, 2)
    if scene.area is None and scene.grid is not None:
        rows, columns = scene.grid.shape
        found = np.array([[-0.5, rows - 0.5], [columns - 0.5, -0.5]])
    return found if np.isfinite(found).all() else np.empty((0, 2))
