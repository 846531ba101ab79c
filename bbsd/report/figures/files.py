"""Files of figures, their panels, and the style that all figures share."""

from __future__ import annotations

from contextlib import contextmanager
from importlib.util import find_spec
from io import BytesIO
from math import isnan
from typing import TYPE_CHECKING, Any
from warnings import catch_warnings, filterwarnings

from bbsd.errors import UsageError, escape
from bbsd.runs.storage.lock import write_result

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, FigureBase

COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d31", "#000000")
"""The colors of Okabe and Ito, distinguishable for people with color blindness; their faint yellow is replaced."""

MOST_NAMES_IN_COLUMN = 12
"""Of a legend beside a panel."""
TITLE_HEIGHT = 0.35
"""The height of a figure's title in inches."""
LETTER_HEIGHT = 0.15
"""Inches from one line of small text to the next."""
LONGEST_LABEL = 22
"""Letters of a label that names several lines."""

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
    """Return the color of the robot or behavior of that index: after the first eight, lighter and then darker ones."""
    base = COLORS[index % len(COLORS)]
    match index // len(COLORS) % 3:
        case 1:
            return _mixed(base, 255, 0.5)
        case 2:
            return _mixed(base, 0, 0.45) if base != COLORS[-1] else "#b8b8b8"
    return base


def _mixed(hexadecimal: str, other: int, share: float) -> str:
    """Return a color with a share of white (255) or black (0)."""
    parts = (int(hexadecimal[place : place + 2], 16) for place in (1, 3, 5))
    return "#" + "".join(f"{round((1 - share) * part + share * other):02x}" for part in parts)


@contextmanager
def panels_in_file(path: Path, width: float, heights: list[float], title: str = "") -> Iterator[list[Axes]]:
    """Yield panels below each other with a common horizontal axis; write them to a file at the end.

    Width and heights are in inches. Raises FigureError if no figure can be drawn.
    """
    with figure_in_file(path, width, sum(heights) + (TITLE_HEIGHT if title else 0.0)) as figure:
        if title:
            set_title(figure, title)
        yield stack_panels(figure, heights)


def set_title(figure: Figure, title: str) -> None:
    """Write the title of a whole figure."""
    figure.suptitle(escape(title), x=0.01, ha="left", fontsize=10, parse_math=False)


@contextmanager
def figure_in_file(path: Path, width: float, height: float) -> Iterator[Figure]:
    """Yield a figure, its size in inches; write it to a file at the end. Raises FigureError if none can be drawn."""
    require_figure(path)
    from matplotlib import style
    from matplotlib.figure import Figure

    with style.context(["default", STYLE]), catch_warnings():
        filterwarnings(
            "ignore", message="Glyph .* missing"
        )  # a name may have signs that the font does not have
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
    write_result(path, drawn.getvalue())


def legend(panel: Axes) -> None:
    """Put the names of a panel's lines, if they have any, to its right, where they cover nothing."""
    if names := panel.get_legend_handles_labels()[1]:
        columns = -(-len(names) // MOST_NAMES_IN_COLUMN)
        panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), ncols=columns, handlelength=1.4)


def label_ends(panel: Axes, ends: Sequence[tuple[str, float]], height: float) -> None:
    """Write names to the right of a panel beside the last values of its lines, none over another.

    Lines that end at the same height have one label. `height` is that of the panel in inches.
    """
    low, high = panel.get_ylim()
    places = dict[float, list[str]]()
    for name, value in ends:
        if not isnan(value):
            places.setdefault(round(min(max((value - low) / (high - low), 0.0), 1.0), 2), []).append(name)
    labels = [(place, name) for place, names in places.items() for name in _lines_of(names)]
    for place, name in _apart(labels, LETTER_HEIGHT / height):
        panel.annotate(
            escape(name),
            (1.01, place),
            xycoords="axes fraction",
            va="center",
            fontsize=7.5,
            annotation_clip=False,
            parse_math=False,
        )


def _lines_of(names: Sequence[str]) -> list[str]:
    """Return names joined to as few lines as their length allows."""
    lines = [names[0]]
    for name in names[1:]:
        joined = f"{lines[-1]}, {name}"
        lines[-1:] = [joined] if len(joined) <= LONGEST_LABEL else [lines[-1], name]
    return lines


def _apart(places: Sequence[tuple[float, str]], room: float) -> list[tuple[float, str]]:
    """Return places moved as little as needed for each to be `room` above the next lower one, from 0 to 1 if they fit.

    Places that are too near to each other become a group around their middle, which may join the group below.
    """
    groups = list[list[tuple[float, str]]]()
    for place in sorted(places):
        groups.append([place])
        while (
            len(groups) > 1
            and _middle(groups[-1]) - _middle(groups[-2]) < room * (len(groups[-1]) + len(groups[-2])) / 2
        ):
            groups[-2:] = [groups[-2] + groups[-1]]
    apart = list[tuple[float, str]]()
    for group in groups:
        lowest = min(_middle(group) - room * (len(group) - 1) / 2, 1.0 - room * (len(group) - 1))
        lowest = max(lowest, apart[-1][0] + room if apart else 0.0)
        apart += [(lowest + room * index, name) for index, (_, name) in enumerate(group)]
    return apart


def _middle(group: Sequence[tuple[float, str]]) -> float:
    return sum(place for place, _ in group) / len(group)


def marker(n_points: int) -> str:
    """Return the marker of points, '' unless there are so few of them that their line would be invisible."""
    return "." if n_points < 4 else ""
