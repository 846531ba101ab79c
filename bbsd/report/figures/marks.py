"""Marks of a view, such as a lamp, food or an evader: their places, trails and names."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from bbsd.report.figures.plane import FAINT, INK, OVER_PATHS, PAPER, draw_circle, drawable, halo

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from bbsd.report.figures.plane import Limits

    Floats = npt.NDArray[np.float64]

FILL = "#f0e442"
TRAIL_WIDTH = 1.0
"""In points."""
LABEL_DISTANCE, LETTER_WIDTH = 0.02, 0.016
"""The distance of a label from its mark, and the width of its letters, as shares of the width shown."""


def draw_mark(panel: Axes, name: str, track: Floats, occupied: Floats, limits: Limits) -> None:
    """Draw a mark at its last place, with a trail if it moves often, else with the places where it rested before.

    `track` is (n_moments, 2 or 3). The name is written far from the `occupied` points (n, 2).
    """
    points, last = track[:, :2], track[-1]
    moved = _moved(points)
    is_moving = moved.mean() > 0.5
    if is_moving:
        panel.plot(*points.T, color=FAINT, lw=TRAIL_WIDTH, ls=(0, (3, 1.5)), zorder=1.5)
    earlier = points[:1] if is_moving else points[:-1][moved]
    panel.plot(*drawable(earlier).T, ls="", marker="D", ms=6, mfc=PAPER, mec=FAINT, zorder=OVER_PATHS)
    if np.isfinite(last[:2]).all():
        panel.plot(*last[:2], marker="D", ms=10, mfc=FILL, mec=INK, zorder=OVER_PATHS)
        draw_circle(panel, last, fill=False, ec=FAINT, lw=0.9, ls=(0, (2, 2)))
        _write(panel, name, last[:2], occupied, limits)


def draw_names(panel: Axes, paths: Mapping[str, Floats], occupied: Floats, limits: Limits) -> None:
    """Write the names of lines beside their first points that can be drawn."""
    for name, path in paths.items():
        if len(points := drawable(path)):
            _write(panel, name, points[0], occupied, limits)


def _moved(points: Floats) -> npt.NDArray[np.bool_]:
    """Return for each step whether the point moved (n_moments - 1,); one that is never finite does not."""
    before, after = np.nan_to_num(points[:-1]), np.nan_to_num(points[1:])
    is_moved: npt.NDArray[np.bool_] = (before != after).any(axis=1)
    return is_moved


def _write(panel: Axes, text: str, point: Floats, occupied: Floats, limits: Limits) -> None:
    """Write a text beside a point, on the side with most room."""
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
    """Return the distance of a label on a side of a point from occupied points; -1 if it crosses a border."""
    along = np.linspace(LABEL_DISTANCE, LABEL_DISTANCE + LETTER_WIDTH * length, 5)
    off = np.stack([along, np.full(5, LABEL_DISTANCE)], axis=1) * sides * limits.signs * limits.width
    label = point + off
    low, high = np.sort(limits, axis=1).T
    if not ((label > low) & (label < high)).all():
        return -1.0
    return float(np.hypot(*(occupied[:, None] - label).reshape(-1, 2).T).min())
