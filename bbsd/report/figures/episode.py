"""One episode of a team over its steps, as in the paper's Fig. 22."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from bbsd.report.figures.files import color, drawn, legend, marker

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from matplotlib.axes import Axes

    from bbsd.evaluation import Trace
    from bbsd.spec.meaning.names import Slot
    from bbsd.spec.models import Spec

    Lines = dict[str, list[float]]
    Stretches = dict[str, list[tuple[float, float]]]

NOBODY = "nobody"
MAX_PANELS = 8
PANEL, ROW = 1.35, 0.3
"""Heights in inches: of a value, and of a behavior."""


def episode(trace: Trace, spec: Spec, path: Path) -> None:
    """Draw the robots' states, what all of them sensed alike, and which behavior controlled each robot.

    The values are those after each step: a panel for each state with a line for each robot, one for each
    value of the world and for each sensor that is a number and the same for all robots; at most eight
    panels, in the spec's order. Raises FigureError for a kind of file that cannot be drawn, and OSError
    where it cannot be written.
    """
    shown = dict(list(_panels(trace, spec).items())[:MAX_PANELS])
    behaviors = _rows(trace, spec)
    heights = [PANEL] * len(shown) + [0.7 + ROW * len(behaviors)]
    with drawn(path, 8.0, heights) as panels:
        for panel, (name, lines) in zip(panels, shown.items(), strict=False):
            _draw_lines(panel, trace, name, lines)
        _draw_control(panels[-1], trace, behaviors)
        legend(panels[0])


def _panels(trace: Trace, spec: Spec) -> dict[str, Lines]:
    """Return the lines of each panel; a value that is not each robot's own has one line, without a label."""
    environment = spec.environment
    own = {name: lines for name in environment.state if (lines := _lines(trace, name))}
    common = {name: _common(trace, name) for name in (*environment.world, *environment.sensors)}
    return {**own, **{name: {"": line} for name, line in common.items() if line}}


def _lines(trace: Trace, name: str) -> Lines:
    """Return the numbers that a name had, by robot and element; nothing for the cells of a partition."""
    return {
        _label(slot, trace.robots): [float(value) for value in values]
        for slot, values in trace.values.items()
        if slot[0] == name and not any(isinstance(value, str) for value in values)
    }


def _label(slot: Slot, robots: int) -> str:
    _, robot, place = slot
    who = f"robot {robot}" if robot is not None and robots > 1 else ""
    return who + "".join(f"[{index}]" for index in place)


def _common(trace: Trace, name: str) -> list[float]:
    """Return the numbers that a name had for all robots alike; nothing for truths, that are 0 and 1 here."""
    lines = list(_lines(trace, name).values())
    if not lines or any(line != lines[0] for line in lines) or {*lines[0]} <= {0.0, 1.0}:
        return []
    return lines[0]


def _draw_lines(panel: Axes, trace: Trace, name: str, lines: Lines) -> None:
    for index, (label, values) in enumerate(lines.items()):
        chosen = color(index) if label else "#333333"
        panel.plot(trace.steps, values, label=label, color=chosen, marker=marker(len(values)))
    panel.set_title(name)


def _rows(trace: Trace, spec: Spec) -> list[str]:
    """Return who can be in control, the highest layer first, and nobody where that happened."""
    named = [name for name in spec.structure or spec.behaviors if name in spec.behaviors]
    in_control = {name for robot in trace.controlling for name in robot}
    return [*named, *sorted(in_control - {*named, NOBODY}), *([NOBODY] if NOBODY in in_control else [])]


def _draw_control(panel: Axes, trace: Trace, behaviors: Sequence[str]) -> None:
    height = 0.8 / trace.robots
    for robot, controlling in enumerate(trace.controlling):
        for name, stretches in _stretches(controlling).items():
            top = behaviors.index(name) - 0.4 + robot * height
            panel.broken_barh(stretches, (top, height), facecolors=color(robot), linewidth=0)
    panel.set_yticks(range(len(behaviors)), behaviors)
    panel.set(ylim=(len(behaviors) - 0.4, -0.6), xlabel="step", title="in control")
    panel.locator_params(axis="x", integer=True)


def _stretches(controlling: Sequence[str]) -> Stretches:
    """Return for each behavior when it began to control and for how long; step k is k - 1/2 to k + 1/2."""
    found: Stretches = {}
    begin = 0.5
    for name, group in groupby(controlling):
        length = len(list(group))
        found.setdefault(name, []).append((begin, length))
        begin += length
    return found
