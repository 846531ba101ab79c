"""Files of figures, their panels, and the style that all figures share."""

from __future__ import annotations

from contextlib import contextmanager
from importlib.util import find_spec
from io import BytesIO
from typing import TYPE_CHECKING, Any

from bbsd.errors import UsageError
from bbsd.files import write_whole

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, FigureBase

COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d31", "#000000")
"""The colors of Okabe and Ito, distinguishable for people with color blindness; their faint yellow is replaced."""

METADATA: dict[str, dict[str, Any]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}
"""Entries that are left out of a file, so that its bytes depend only on the data."""

STYLE: dict[str, Any] = {
    "svg.hashsalt": "bbsd",
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.xmargin": 0.01,
    "axes.titlesize": 9,
    "axes.titlelocation": "left",
    "grid.alpha": 0.25,
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.4,
    "legend.frameon": False,
    "legend.fontsize": 8,
}


class FigureError(UsageError):
    """A figure cannot be drawn; the message says why and what to do."""


def require_figure(path: Path) -> None:
    """Raise FigureError if no figure can be drawn into a file of this kind."""
    if path.suffix.lower() not in METADATA:
        raise FigureError(f"{path}: the name of a figure's file ends with one of {', '.join(METADATA)}")
    if find_spec("matplotlib") is None:
        raise FigureError('figures are drawn by matplotlib, which is not installed: pip install "bbsd[plot]"')


def color(index: int) -> str:
    """Return the color of the robot or behavior of that index."""
    return COLORS[index % len(COLORS)]


@contextmanager
def panels_in_file(path: Path, width: float, heights: list[float]) -> Iterator[list[Axes]]:
    """Yield panels below each other with a common horizontal axis; write them to a file at the end.

    Width and heights are in inches. Raises FigureError if no figure can be drawn.
    """
    with figure_in_file(path, width, sum(heights)) as figure:
        yield stack_panels(figure, heights)


@contextmanager
def figure_in_file(path: Path, width: float, height: float) -> Iterator[Figure]:
    """Yield a figure, its size in inches; write it to a file at the end. Raises FigureError if none can be drawn."""
    require_figure(path)
    from matplotlib import style
    from matplotlib.figure import Figure

    with style.context(["default", STYLE]):
        figure = Figure(figsize=(width, height), layout="constrained")
        yield figure
        _save(figure, path)


def stack_panels(figure: FigureBase, heights: list[float]) -> list[Axes]:
    """Return panels below each other with a common horizontal axis."""
    panels = figure.subplots(len(heights), sharex=True, squeeze=False, height_ratios=heights)
    return list(panels[:, 0])


def _save(figure: Figure, path: Path) -> None:
    suffix = path.suffix.lower()
    drawn = BytesIO()
    figure.savefig(drawn, format=suffix[1:], dpi=150, metadata=METADATA[suffix])
    write_whole(path, drawn.getvalue(), through_links=True)


def legend(panel: Axes) -> None:
    """Put the names of a panel's lines, if they have any, to its right, where they cover nothing."""
    if panel.get_legend_handles_labels()[1]:
        panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def marker(n_points: int) -> str:
    """Return the marker of points, '' unless there are so few of them that their line would be invisible."""
    return "." if n_points < 4 else ""
