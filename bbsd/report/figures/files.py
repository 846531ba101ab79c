"""Where figures go, and the one style that they are drawn in."""

from __future__ import annotations

from contextlib import contextmanager
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from bbsd.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, FigureBase

COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d31", "#000000")
"""Okabe and Ito's colors, that can be told apart without seeing red or green; but for the faint yellow."""

METADATA: dict[str, dict[str, Any]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}
"""What to leave out of a file, so that it depends on the data only."""

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
    """Why a figure cannot be drawn, and what to do about it."""


def require_figure(path: Path) -> None:
    """Raise FigureError where a figure could not be written to such a file, whatever it shows."""
    if path.suffix.lower() not in METADATA:
        raise FigureError(f"{path}: a figure is a {', '.join(METADATA)} file")
    if find_spec("matplotlib") is None:
        raise FigureError('figures are drawn by matplotlib, which is not installed: pip install "bbsd[plot]"')


def color(index: int) -> str:
    """Return the color of the robot or behavior of that index."""
    return COLORS[index % len(COLORS)]


@contextmanager
def panels_in_file(path: Path, width: float, heights: list[float]) -> Iterator[list[Axes]]:
    """Give panels below each other that share the horizontal axis; write the file when they are drawn.

    Width and heights are inches. Raises FigureError where that cannot be done.
    """
    with figure_in_file(path, width, sum(heights)) as figure:
        yield stack_panels(figure, heights)


@contextmanager
def figure_in_file(path: Path, width: float, height: float) -> Iterator[Figure]:
    """Give a figure of that size in inches, and write the file when it is drawn; FigureError as `drawn`."""
    require_figure(path)
    from matplotlib import style
    from matplotlib.figure import Figure

    with style.context(["default", STYLE]):
        figure = Figure(figsize=(width, height), layout="constrained")
        yield figure
        _save(figure, path)


def stack_panels(figure: FigureBase, heights: list[float]) -> list[Axes]:
    """Return panels below each other that share the horizontal axis."""
    panels = figure.subplots(len(heights), sharex=True, squeeze=False, height_ratios=heights)
    return list(panels[:, 0])


def _save(figure: Figure, path: Path) -> None:
    suffix = path.suffix.lower()
    figure.savefig(path, format=suffix[1:], dpi=150, metadata=METADATA[suffix])


def legend(panel: Axes) -> None:
    """Put the names of a panel's lines, if they have any, to its right, where they hide nothing."""
    if panel.get_legend_handles_labels()[1]:
        panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def marker(n_points: int) -> str:
    """Return how points are marked: only where there are so few that their line could not be seen."""
    return "." if n_points < 4 else ""
