"""What a view marks: a lamp, some food, an evader; where it was, and its name where there is room."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from bbsd.report.figures.plane import FAINT, INK, OVER_PATHS, PAPER, draw_circle, drawable, halo

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes

    from bbsd.report.figures.plane import Limits

    Floats = npt.NDArray[np.float64]

FILL = "#f0e442"
TRAIL = 1.0
"""Width in points."""
NEAR, LETTER = 0.02, 0.016
"""How far a label is from what it names, and how wide its letters are, in parts of the width shown."""


def draw_mark(panel: Axes, name: str, track: Floats, occupied: Floats, limits: Limits) -> None:
    """Draw where a mark is at the end, and how it came there: a trail if it moves, else the places it rested at.

    `track` is (n_moments, 2 or 3); the name is written where it is far from the points that are `taken`.
    """
    points, last = track[:, :2], track[-1]
    moved = _moved(points)
    is_moving = moved.mean() > 0.5
    if is_moving:
        panel.plot(*points.T, color=FAINT, lw=TRAIL, ls=(0, (3, 1.5)), zorder=1.5)
    earlier = points[:1] if is_moving else points[:-1][moved]
    panel.plot(*drawable(earlier).T, ls="", marker="D", ms=6, mfc=PAPER, mec=FAINT, zorder=OVER_PATHS)
    if np.isfinite(last[:2]).all():
        panel.plot(*last[:2], marker="D", ms=10, mfc=FILL, mec=INK, zorder=OVER_PATHS)
        draw_circle(panel, last, fill=False, ec=FAINT, lw=0.9, ls=(0, (2, 2)))
        _write(panel, name, last[:2], occupied, limits)


def _moved(points: Floats) -> npt.NDArray[np.bool_]:
    """Return for each step whether it ended elsewhere; what stays not finite has not moved."""
    before, after = np.nan_to_num(points[:-1]), np.nan_to_num(points[1:])
    found: npt.NDArray[np.bool_] = (before != after).any(axis=1)
    return found


def _write(panel: Axes, text: str, point: Floats, occupied: Floats, limits: Limits) -> None:
    """Write beside a point, on the side with most room."""
    sides = [(side, above) for above in (1, -1) for side in (1, -1)]
    side, above = max(sides, key=partial(_room, point, len(text), occupied, limits))
    panel.annotate(
        text,
        (point[0], point[1]),
        (7 * side, 3 * above),
        textcoords="offset points",
        ha="left" if side > 0 else "right",
        va="bottom" if above > 0 else "top",
        color=INK,
        path_effects=[halo()],
        zorder=OVER_PATHS + 2,
    )


def _room(point: Floats, length: int, occupied: Floats, limits: Limits, sides: tuple[int, int]) -> float:
    """Return how far a label to a side of a point is from all that is taken; -1 where it crosses a border."""
    along = np.linspace(NEAR, NEAR + LETTER * length, 5)
    off = np.stack([along, np.full(5, NEAR)], axis=1) * sides * limits.signs * limits.width
    label = point + off
    low, high = np.sort(limits, axis=1).T
    if not ((label > low) & (label < high)).all():
        return -1.0
    return float(np.hypot(*(occupied[:, None] - label).reshape(-1, 2).T).min())
