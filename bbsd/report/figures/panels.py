"""Panels of an episode over its steps: values, and the behaviors in control."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import groupby
from typing import TYPE_CHECKING, Any

from bbsd.report.figures.files import color, marker

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from bbsd.evaluation import Trace
    from bbsd.expression.node_data import Slot
    from bbsd.language.models import Spec

    Lines = dict[str, list[float]]
    Stretches = dict[str, list[tuple[float, float]]]

NOBODY = "nobody"
MAX_PANELS = 8
ROBOT_STYLES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1, 1)), (0, (5, 1.5, 1, 1.5)))
GRAYS = ("#222222", "#6a6a6a", "#9a9a9a")
"""Styles and grays that distinguish robots where colors stand for behaviors."""
CROSS: Mapping[str, Any] = {"ls": "", "marker": "x", "ms": 3.5}
OUTLINE_AND_INK: tuple[Any, ...] = ({"color": "#ffffff", "mew": 1.8}, {"color": "#222222", "mew": 0.8})
"""The pens of a cross: first a light outline, then dark ink, so that it is visible on every color."""


def panels_of(trace: Trace, spec: Spec) -> dict[str, Lines]:
    """Return the lines of each panel by label; a value that all robots share has one line, without a label."""
    environment = spec.environment
    own = {name: lines for name in environment.state if (lines := _lines(trace, name))}
    common = {name: _common(trace, name) for name in (*environment.world, *environment.sensors)}
    return {**own, **{name: {"": line} for name, line in common.items() if line}}


def _lines(trace: Trace, name: str) -> Lines:
    """Return the values of a name by robot and element; none if they are cells of a partition."""
    return {
        _label(slot, trace.robots): [float(value) for value in values]
        for slot, values in trace.values.items()
        if slot.name == name and not any(isinstance(value, str) for value in values)
    }


def _label(slot: Slot, robots: int) -> str:
    robot = f"robot {slot.robot}" if slot.robot is not None and robots > 1 else ""
    return robot + "".join(f"[{index}]" for index in slot.place)


def _common(trace: Trace, name: str) -> list[float]:
    """Return the values of a name if they are equal for all robots; none for truth values, which are 0 and 1."""
    lines = list(_lines(trace, name).values())
    if not lines or any(line != lines[0] for line in lines) or {*lines[0]} <= {0.0, 1.0}:
        return []
    return lines[0]


def draw_lines(panel: Axes, trace: Trace, name: str, lines: Lines, *, in_gray: bool = False) -> None:
    """Draw the lines of a value, in the robots' colors, or in gray where colors stand for behaviors."""
    for index, (label, values) in enumerate(lines.items()):
        line_color = "#333333" if not label else GRAYS[index % len(GRAYS)] if in_gray else color(index)
        style, width = (ROBOT_STYLES[index % len(ROBOT_STYLES)], 1.0) if in_gray else ("-", None)
        panel.plot(
            trace.steps, values, label=label, color=line_color, ls=style, marker=marker(len(values)), lw=width
        )
    distinct = {value for values in lines.values() for value in values}
    if in_gray and distinct <= {0.0, 1.0}:
        panel.set(ylim=(-0.15, 1.15), yticks=(0, 1))
    panel.set_title(name)


def behavior_rows(trace: Trace, spec: Spec) -> list[str]:
    """Return the behaviors that can be in control, highest layer first, then nobody if that happened."""
    behaviors = [name for name in spec.structure or spec.behaviors if name in spec.behaviors]
    in_control = {name for robot in trace.controlling for name in robot}
    return [
        *behaviors,
        *sorted(in_control - {*behaviors, NOBODY}),
        *([NOBODY] if NOBODY in in_control else []),
    ]


def draw_control(
    panel: Axes, trace: Trace, behaviors: Sequence[str], colors: Sequence[str] | Mapping[str, str]
) -> None:
    """Draw when each behavior controlled each robot; `colors` are those of robots, or of behaviors by name."""
    height = 0.8 / trace.robots
    for robot, controlling in enumerate(trace.controlling):
        for name, stretches in _stretches(controlling).items():
            top = behaviors.index(name) - 0.4 + robot * height
            bar_color = colors[name] if isinstance(colors, Mapping) else colors[robot]
            panel.broken_barh(stretches, (top, height), facecolors=bar_color, linewidth=0)
    failed = failures(trace, behaviors)
    for pen in OUTLINE_AND_INK if failed else ():
        panel.plot(*zip(*failed, strict=True), **CROSS, **pen)
    panel.set_yticks(range(len(behaviors)), behaviors)
    title = "in control, × where an expectation failed" if failed else "in control"
    panel.set(ylim=(len(behaviors) - 0.4, -0.6), xlabel="step", title=title)
    panel.locator_params(axis="x", integer=True)


def failures(trace: Trace, behaviors: Sequence[str]) -> list[tuple[int, float]]:
    """Return the points on a panel of control where an expectation failed: step, and middle of the robot's bar."""
    height = 0.8 / trace.robots
    return [
        (step, behaviors.index(name) - 0.4 + (robot + 0.5) * height)
        for robot, outcomes in enumerate(trace.expectations)
        for step, name, outcome in zip(trace.steps.tolist(), trace.controlling[robot], outcomes, strict=True)
        if outcome == "failed"
    ]


def _stretches(controlling: Sequence[str]) -> Stretches:
    """Return for each behavior the starts and lengths of its control; step k is drawn from k - 1/2 to k + 1/2."""
    stretches: Stretches = {}
    begin = 0.5
    for name, group in groupby(controlling):
        length = len(list(group))
        stretches.setdefault(name, []).append((begin, length))
        begin += length
    return stretches
