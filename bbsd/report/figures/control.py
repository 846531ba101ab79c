"""The panel of who was in control: a row for each behavior, or for each robot."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import groupby
from typing import TYPE_CHECKING, Any

from bbsd.report.figures.files import color

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from bbsd.evaluation import Trace
    from bbsd.language.models import Spec

    Stretches = dict[str, list[tuple[float, float]]]

NOBODY = "nobody"
NOBODY_COLOR = "#9a9a9a"
BEHAVIOR_ROW, ROBOT_ROW, AROUND_ROWS = 0.26, 0.17, 0.7
"""Heights in inches: of the row of a behavior, of a robot, and of the title and axis around them."""
CROSS: Mapping[str, Any] = {"ls": "", "marker": "x", "ms": 3.5}
OUTLINE_AND_INK: tuple[Any, ...] = ({"color": "#ffffff", "mew": 1.8}, {"color": "#222222", "mew": 0.8})
"""The pens of a cross: first a light outline, then dark ink, so that it is visible on every color."""


def behavior_rows(trace: Trace) -> list[str]:
    """Return the behaviors that can be in control, highest layer first, then nobody if that happened."""
    in_control = {name for robot in trace.controlling for name in robot}
    return [*(layer.behavior for layer in trace.layers), *([NOBODY] if NOBODY in in_control else [])]


def behavior_colors(behaviors: Sequence[str], spec: Spec) -> dict[str, str]:
    """Return the color of each behavior, by its place in the spec."""
    order = [*spec.behaviors]
    return {name: NOBODY_COLOR if name == NOBODY else color(order.index(name)) for name in behaviors}


def control_height(trace: Trace, behaviors: Sequence[str], *, by_robot: bool) -> float:
    """Return the height of the panel in inches."""
    rows = max(trace.robots, 3) * ROBOT_ROW if by_robot else len(behaviors) * BEHAVIOR_ROW
    return AROUND_ROWS + rows


def draw_control_by_behavior(
    panel: Axes, trace: Trace, behaviors: Sequence[str], colors: Sequence[str] | Mapping[str, str]
) -> None:
    """Draw a row for each behavior, in it a bar for each robot; `colors` are those of robots, or of behaviors."""
    height = 0.8 / trace.robots
    for robot, controlling in enumerate(trace.controlling):
        for name, stretches in stretches_of_control(controlling).items():
            top = behaviors.index(name) - 0.4 + robot * height
            bar_color = colors[name] if isinstance(colors, Mapping) else colors[robot]
            panel.broken_barh(stretches, (top, height), facecolors=bar_color, linewidth=0)
    failed = [
        (step, behaviors.index(name) - 0.4 + (robot + 0.5) * height) for step, name, robot in failures(trace)
    ]
    panel.set_yticks(range(len(behaviors)), behaviors)
    panel.set_ylim(len(behaviors) - 0.4, -0.6)
    _finish(panel, failed, "in control")


def draw_control_by_robot(panel: Axes, trace: Trace, colors: Mapping[str, str]) -> None:
    """Draw a row for each robot, in the colors of the behaviors in control."""
    for robot, controlling in enumerate(trace.controlling):
        for name, stretches in stretches_of_control(controlling).items():
            panel.broken_barh(stretches, (robot - 0.42, 0.84), facecolors=colors[name], linewidth=0)
    every = -(-trace.robots // 20)
    panel.set_yticks(
        range(0, trace.robots, every), [str(robot) for robot in range(0, trace.robots, every)], fontsize=7
    )
    panel.set_ylabel("robot", fontsize=7.5)
    panel.set_ylim(trace.robots - 0.4, -0.6)
    panel.grid(visible=False, axis="y")
    _finish(panel, [(step, robot) for step, _, robot in failures(trace)], "in control of each robot")


def _finish(panel: Axes, failed: Sequence[tuple[int, float]], title: str) -> None:
    for pen in OUTLINE_AND_INK if failed else ():
        panel.plot(*zip(*failed, strict=True), **CROSS, **pen)
    panel.set(xlabel="step", title=f"{title}, × where an expectation failed" if failed else title)
    panel.locator_params(axis="x", integer=True)


def failures(trace: Trace) -> list[tuple[int, str, int]]:
    """Return where an expectation failed: the step, the behavior in control, and the robot."""
    return [
        (step, name, robot)
        for robot, outcomes in enumerate(trace.expectations)
        for step, name, outcome in zip(trace.steps.tolist(), trace.controlling[robot], outcomes, strict=True)
        if outcome == "failed"
    ]


def stretches_of_control(controlling: Sequence[str]) -> Stretches:
    """Return for each behavior the starts and lengths of its control; step k is drawn from k - 1/2 to k + 1/2."""
    stretches: Stretches = {}
    begin = 0.5
    for name, group in groupby(controlling):
        length = len(list(group))
        stretches.setdefault(name, []).append((begin, length))
        begin += length
    return stretches
