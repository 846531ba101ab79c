"""Panels of an episode over its steps: values, and the reinforcement."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.report.figures.files import color, label_ends, marker

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from bbsd.evaluation import Trace
    from bbsd.report.figures.choice import ValuePanel

    Floats = npt.NDArray[np.float64]

ROBOT_STYLES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1, 1)))
GRAYS = ("#222222", "#6a6a6a", "#9a9a9a")
"""Styles and grays that distinguish lines where colors stand for behaviors."""
MOST_IN_GRAY, MOST_IN_COLOR = len(GRAYS), 8
"""Curves that are drawn as lines; of more each is a strip, dark where the value is high."""
MOST_TERMS = 6
"""Reward terms that have a line of their own."""
INK = "#222222"


def is_strip(panel: ValuePanel, *, in_gray: bool) -> bool:
    """Return whether a value has too many curves for lines."""
    return len(panel.curves) > (MOST_IN_GRAY if in_gray else MOST_IN_COLOR)


def draw_values(panel: Axes, shown: ValuePanel, *, in_gray: bool = False) -> None:
    """Draw a value as lines in the robots' colors, or in gray where colors stand for behaviors; as strips if many.

    Whole numbers, truths and cells are steps: they hold until they change.
    """
    if is_strip(shown, in_gray=in_gray):
        _draw_strips(panel, shown)
    else:
        _draw_lines(panel, shown, in_gray=in_gray)
    finite = any(isfinite(value) for curve in shown.curves for value in curve.values)
    panel.set_title(shown.title if finite else f"{shown.title}: no finite value")


def _draw_lines(panel: Axes, shown: ValuePanel, *, in_gray: bool) -> None:
    for index, curve in enumerate(shown.curves):
        line_color = GRAYS[index % len(GRAYS)] if in_gray else color(index)
        panel.plot(
            range(len(curve.values)),
            curve.values,
            label=curve.label,
            color=INK if not curve.label else line_color,
            ls=ROBOT_STYLES[index % len(ROBOT_STYLES)] if in_gray else "-",
            lw=1.0 if in_gray else None,
            drawstyle="default" if shown.kind == "number" else "steps-mid",
            marker=marker(len(curve.values)),
        )
    names = {"truth": ("false", "true"), "cell": shown.cells}.get(shown.kind)
    if names:
        panel.set(ylim=(-0.15, len(names) - 0.85))
        panel.set_yticks(range(len(names)), names)
    elif shown.kind == "whole":
        panel.locator_params(axis="y", integer=True)


def _draw_strips(panel: Axes, shown: ValuePanel) -> None:
    """Draw a strip for each curve, one below the other, and a scale beside them."""
    values = np.ma.masked_invalid([curve.values for curve in shown.curves])
    n_curves, n_moments = values.shape
    image = panel.imshow(
        values,
        aspect="auto",
        interpolation="nearest",
        cmap="Greys",
        extent=(-0.5, n_moments - 0.5, n_curves - 0.5, -0.5),
    )
    panel.grid(visible=False)
    every = -(-n_curves // 8)
    rows = range(0, n_curves, every)
    panel.set_yticks(rows, [shown.curves[row].label.removeprefix("robot ") for row in rows], fontsize=7)
    panel.set_ylabel("robot" if shown.curves[0].label.startswith("robot") else "", fontsize=7.5)
    scale = panel.inset_axes((1.015, 0.0, 0.018, 1.0))
    bar = panel.get_figure(root=True).colorbar(image, cax=scale)  # type: ignore[union-attr]  # it is in one
    bar.ax.tick_params(labelsize=7, length=2)
    if shown.kind in ("truth", "cell"):
        names = ("false", "true") if shown.kind == "truth" else shown.cells
        bar.set_ticks(range(len(names)), labels=names)
        image.set_clim(0, len(names) - 1)
    elif shown.kind == "whole":
        bar.locator = _whole_locator()
        bar.update_ticks()


def _whole_locator() -> Any:  # noqa: ANN401 - as matplotlib types locators
    from matplotlib.ticker import MaxNLocator

    return MaxNLocator(nbins=4, integer=True)


def earned_so_far(trace: Trace) -> dict[str, Floats]:
    """Return what each reward term has given up to each step, the mean over robots, and their sum as `return`.

    Of many terms those that gave most are named, and the others are summed.
    """
    terms = {name: np.mean(robots, axis=0) for name, robots in trace.rewards.items()}
    order = sorted(terms, key=lambda name: -float(np.abs(np.nan_to_num(terms[name])).sum()))
    named = order if len(order) <= MOST_TERMS else order[: MOST_TERMS - 1]
    lines = {name: terms[name] for name in terms if name in named}
    if others := [terms[name] for name in terms if name not in named]:
        lines[f"{len(others)} other terms"] = np.sum(others, axis=0)
    lines["return"] = np.sum([*terms.values()], axis=0) if terms else np.zeros(len(trace.steps))
    return {name: np.concatenate([[0.0], np.cumsum(gains)]) for name, gains in lines.items()}


def draw_reward(panel: Axes, trace: Trace, height: float) -> None:
    """Draw what was earned up to each step, as a whole and by reward term; the panel's height in inches."""
    lines = earned_so_far(trace)
    if len(lines) == 2:
        del lines[next(iter(lines))]
    shades = dict(zip(lines, _shades(len(lines) - 1), strict=False))
    for name, values in lines.items():
        is_sum = name == "return"
        panel.plot(
            range(len(values)),
            values,
            color=INK if is_sum else shades[name],
            lw=1.8 if is_sum else 0.9,
            ls="-" if is_sum else (0, (4, 1.5)),
            zorder=3 if is_sum else 2,
        )
    panel.set_title("earned so far" if len(lines) == 1 else "earned so far, by reward term")
    label_ends(panel, [(name, float(values[-1])) for name, values in lines.items()], height)


def _shades(count: int) -> Sequence[str]:
    return [
        f"#{shade:02x}{shade:02x}{shade:02x}" for shade in np.linspace(0x55, 0xA0, max(count, 1)).astype(int)
    ]
