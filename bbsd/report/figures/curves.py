"""The figure of a design: fitness over the generations, as in the paper's Fig. 14, and diversity of the pools."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bbsd.report.figures.files import color, legend, marker, panels_in_file

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from matplotlib.axes import Axes

    Line = Mapping[str, Any]

FITNESS: tuple[tuple[str, str, dict[str, Any]], ...] = (
    ("best", "best agent", {"color": "#999999", "linewidth": 1.0}),
    ("mean", "mean of the agents", {"color": color(0), "linewidth": 1.8}),
    ("lifetime", "mean lifetime fitness", {"color": color(0), "linestyle": (0, (4, 2))}),
)
"""Key in the metrics, label and style. As in the paper, solid is the fitness (14), dashed that of whole lifetimes."""


def draw_curves(metrics: Sequence[Line], path: Path) -> None:
    """Draw the lines of `metrics.jsonl`: fitness above, and the diversity of each behavior's pool below.

    Of a search that has no generations the best so far is drawn, over the episodes. With several runs, a curve is
    their mean, and the mean fitness of each run is drawn faintly.

    Raises:
        FigureError: the kind of file is unknown.
        OSError: the file cannot be written.
    """
    if any("generation" not in line for line in metrics):
        with panels_in_file(path, 7.5, [3.4]) as (panel,):
            _draw_best_so_far(panel, metrics)
        return
    with panels_in_file(path, 7.5, [3.4, 1.8]) as (fitness, diversity):
        _draw_fitness(fitness, metrics)
        _draw_diversity(diversity, metrics)


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
    legend(panel)


def _draw_fitness(panel: Axes, metrics: Sequence[Line]) -> None:
    runs = sorted({line["run"] for line in metrics})
    for run in runs if len(runs) > 1 else []:
        panel.plot(*_points(metrics, ("mean",), run), color=color(0), linewidth=0.7, alpha=0.35)
    for key, label, style in FITNESS:
        generations, values = _points(metrics, (key,))
        panel.plot(generations, values, label=label, marker=marker(len(values)), **style)
    panel.set_ylabel("fitness" if len(runs) < 2 else f"fitness, mean of {len(runs)} runs")
    legend(panel)


def _draw_diversity(panel: Axes, metrics: Sequence[Line]) -> None:
    for index, name in enumerate(metrics[0]["diversity"] if metrics else ()):
        generations, values = _points(metrics, ("diversity", name))
        panel.plot(
            generations, values, label=name, color=color(index), linewidth=1.1, marker=marker(len(values))
        )
    panel.set(xlabel="generation", ylabel="diversity")
    panel.set_ylim(bottom=0)
    panel.locator_params(axis="x", integer=True)
    legend(panel)


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
