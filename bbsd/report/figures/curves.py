"""The figure of a design: fitness over the generations, as in the paper's Fig. 14, and diversity of the pools."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Any

from bbsd.errors import escape
from bbsd.report.figures.files import color, label_ends, legend, marker, panels_in_file
from bbsd.report.wording.numbers import number

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from matplotlib.axes import Axes

    Line = Mapping[str, Any]

WIDTH = 7.5
"""In inches."""
MOST_BESIDE = 10
"""Pools whose names stand beside the panel of their diversity; of more they stand below it."""
FARTHEST = 0.75
"""How far a return to compare with may be from the curves, in heights of the panel."""

FITNESS: tuple[tuple[str, str, dict[str, Any]], ...] = (
    ("best", "best agent", {"color": "#999999", "linewidth": 1.0}),
    ("mean", "mean of the agents", {"color": color(0), "linewidth": 1.8}),
    ("lifetime", "mean lifetime fitness", {"color": color(0), "linestyle": (0, (4, 2))}),
)
"""Key in the metrics, label and style. As in the paper, solid is the fitness (14), dashed that of whole lifetimes."""


def draw_curves(
    metrics: Sequence[Line], path: Path, *, title: str = "", beside: Mapping[str, float] | None = None
) -> None:
    """Draw the lines of `metrics.jsonl`: fitness above, and the diversity of each behavior's pool below.

    Of a search that has no generations the best so far is drawn, over the episodes. With several runs, a curve is
    their mean, and the mean fitness of each run is drawn faintly. `beside` are mean returns to compare with, by name:
    each is a line across, or a note at the border where it is far from all curves.

    Raises:
        FigureError: the kind of file is unknown.
        OSError: the file cannot be written.
    """
    if any("generation" not in line for line in metrics):
        with panels_in_file(path, WIDTH, [3.4], title) as (panel,):
            _draw_best_so_far(panel, metrics)
            _draw_beside(panel, beside or {})
            _name_lines(panel)
        return
    pools = list(metrics[0]["diversity"]) if metrics else []
    heights = [3.4, 1.8 + _legend_height(pools)]
    with panels_in_file(path, WIDTH, heights, title) as (fitness, diversity):
        _draw_fitness(fitness, metrics)
        _draw_beside(fitness, beside or {})
        _name_lines(fitness)
        _draw_diversity(diversity, metrics)


def _name_lines(panel: Axes) -> None:
    """Put the names of lines where they cover least."""
    if panel.get_legend_handles_labels()[1]:
        panel.legend(loc="best", frameon=True, framealpha=0.85, edgecolor="none")


def _draw_beside(panel: Axes, beside: Mapping[str, float]) -> None:
    """Draw returns to compare with across a panel; where one is so far that curves would be flat, name it only."""
    low, high = panel.get_ylim()
    span = high - low
    shown, notes = list[tuple[str, float]](), list[str]()
    for name, value in beside.items():
        if not isfinite(value):
            continue
        text = f"{name} {number(value)}"
        if low - FARTHEST * span <= value <= high + FARTHEST * span:
            panel.axhline(value, color="#666666", lw=0.9, ls=(0, (2, 2)), zorder=1.5)
            shown.append((text, value))
        else:
            notes.append(f"{text}, {'far below' if value < low else 'far above'}")
    if notes:
        panel.set_title(escape("; ".join(notes)), fontsize=8, color="#666666", loc="right", parse_math=False)
    label_ends(panel, shown, 3.0)


def _draw_best_so_far(panel: Axes, metrics: Sequence[Line]) -> None:
    runs = sorted({line["run"] for line in metrics})
    for index, run in enumerate(runs):
        lines = [line for line in metrics if line["run"] == run]
        label = "best so far" if len(runs) < 2 else f"best so far, run {run}"
        episodes, means = [line["episodes"] for line in lines], [line["mean"] for line in lines]
        panel.plot(episodes, means, label=label, color=color(index), linewidth=1.4, marker=marker(len(lines)))
        answers = [line for line in lines if line["stage"] == "answer"]
        panel.plot(
            [line["episodes"] for line in answers],
            [line["mean"] for line in answers],
            label="" if index else "answer",
            color=color(index),
            linestyle="",
            marker="o",
        )
    panel.set(xlabel="episodes", ylabel="mean return in new episodes")


def _draw_fitness(panel: Axes, metrics: Sequence[Line]) -> None:
    runs = sorted({line["run"] for line in metrics})
    for run in runs if len(runs) > 1 else []:
        panel.plot(*_points(metrics, ("mean",), run), color=color(0), linewidth=0.7, alpha=0.35)
    for key, label, style in FITNESS:
        generations, values = _points(metrics, (key,))
        panel.plot(generations, values, label=label, marker=marker(len(values)), **style)
    panel.set_ylabel("fitness" if len(runs) < 2 else f"fitness, mean of {len(runs)} runs")


def _draw_diversity(panel: Axes, metrics: Sequence[Line]) -> None:
    for index, name in enumerate(metrics[0]["diversity"] if metrics else ()):
        generations, values = _points(metrics, ("diversity", name))
        panel.plot(
            generations, values, label=name, color=color(index), linewidth=1.1, marker=marker(len(values))
        )
    panel.set(xlabel="generation", ylabel="diversity")
    panel.set_ylim(bottom=0)
    panel.locator_params(axis="x", integer=True)
    names = panel.get_legend_handles_labels()[1]
    if len(names) <= MOST_BESIDE:
        legend(panel)
    else:
        columns, _ = _legend_shape(names)
        panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.3), ncols=columns, fontsize=7)


def _legend_shape(names: Sequence[str]) -> tuple[int, int]:
    """Return the columns and lines of a legend below a panel."""
    columns = max(1, int(WIDTH * 14) // (max(map(len, names)) + 7))
    return columns, -(-len(names) // columns)


def _legend_height(names: Sequence[str]) -> float:
    """Return the height in inches of the legend below the panel of diversity; none where it is beside it."""
    return 0.0 if len(names) <= MOST_BESIDE else 0.2 + 0.16 * _legend_shape(names)[1]


def _points(
    metrics: Sequence[Line], keys: tuple[str, ...], run: int | None = None
) -> tuple[list[int], list[float]]:
    """Return generations and values of one run, or the means over the runs that have reached each generation."""
    by_generation: dict[int, list[float]] = {}
    for line in metrics:
        if run in {None, line["run"]}:
            by_generation.setdefault(line["generation"], []).append(_value(line, keys))
    return list(by_generation), [sum(values) / len(values) for values in by_generation.values()]


def _value(line: Line, keys: tuple[str, ...]) -> float:
    value: Any = line
    for key in keys:
        value = value[key]
    return float(value)
