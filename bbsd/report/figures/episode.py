"""One episode of a team over its steps, as in the paper's Fig. 22."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import groupby
from typing import TYPE_CHECKING

from bbsd.expression.tree import Name
from bbsd.report.figures.files import color, drawn, drawn_whole, legend, marker, stacked
from bbsd.report.figures.plane import limits_of
from bbsd.report.figures.scene import draw_scene, legend_lines
from bbsd.spec.written import expressions_in

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from matplotlib.axes import Axes

    from bbsd.evaluation import Scene, Trace
    from bbsd.spec.meaning.names import Slot
    from bbsd.spec.models import Spec
    from bbsd.spec.view import View

    Lines = dict[str, list[float]]
    Stretches = dict[str, list[tuple[float, float]]]

NOBODY = "nobody"
MAX_PANELS = 8
PANEL, ROW = 1.35, 0.3
"""Heights in inches: of a value, and of a behavior."""
SMALL_PANEL, SMALL_ROW = 0.68, 0.24
"""The same beside a scene."""
SCENE, BESIDE = 5.2, 4.0
"""Widths in inches: of a scene, and of the panels beside it."""
LOWEST, HIGHEST, AROUND, LEGEND_LINE = 2.5, 7.0, 0.7, 0.2
"""Heights in inches: a scene's at least and at most, its title and axis, a line of its legend."""
NOBODY_COLOR = "#9a9a9a"
ROBOT_STYLES = ("-", (0, (5, 1.5)), (0, (1, 1)), (0, (5, 1.5, 1, 1.5)))
GRAYS = ("#222222", "#6a6a6a", "#9a9a9a")
"""How robots are told apart where colors stand for behaviors."""
MAX_NAMED = 8
"""Robots at most whose lines are: of more nobody could."""


def episode(trace: Trace, spec: Spec, path: Path) -> None:
    """Draw the robots' states, what all of them sensed alike, and which behavior controlled each robot.

    The values are those after each step: a panel for each state with a line for each robot, one for each
    value of the world and for each sensor that is a number and the same for all robots; at most eight
    panels, in the spec's order. A spec with a view is drawn from above, with these panels beside it. Raises
    FigureError for a kind of file that cannot be drawn, and OSError where it cannot be written.
    """
    if trace.scene is None:
        _draw_lines_only(trace, spec, path)
    else:
        _draw_with_scene(trace, spec, trace.scene, path)


def _draw_lines_only(trace: Trace, spec: Spec, path: Path) -> None:
    shown = dict(list(_panels(trace, spec).items())[:MAX_PANELS])
    behaviors = _rows(trace, spec)
    heights = [PANEL] * len(shown) + [0.7 + ROW * len(behaviors)]
    with drawn(path, 8.0, heights) as panels:
        for panel, (name, lines) in zip(panels, shown.items(), strict=False):
            _draw_lines(panel, trace, name, lines)
        _draw_control(panels[-1], trace, behaviors, [color(robot) for robot in range(trace.robots)])
        legend(panels[0])


def _draw_with_scene(trace: Trace, spec: Spec, scene: Scene, path: Path) -> None:
    """Draw the scene on the left, and what it does not show on the right; colors are those of the behaviors."""
    seen = _names_seen(spec.view)
    panels = {name: lines for name, lines in _panels(trace, spec).items() if name not in seen}
    shown = dict(list(panels.items())[:MAX_PANELS])
    behaviors = _rows(trace, spec)
    order = [*spec.behaviors]
    colors = {name: NOBODY_COLOR if name == NOBODY else color(order.index(name)) for name in behaviors}
    control = 0.6 + SMALL_ROW * len(behaviors)
    scene_height = min(max(SCENE * limits_of(scene).shape, LOWEST), HIGHEST)
    below = AROUND + LEGEND_LINE * legend_lines(len(behaviors))
    height = max(scene_height + below, SMALL_PANEL * len(shown) + control)
    line = (height - control) / len(shown) if shown else 0.0
    with drawn_whole(path, SCENE + BESIDE, height) as figure:
        left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=[SCENE, BESIDE])[0]
        draw_scene(left.subplots(), trace, scene, colors)
        beside = stacked(right, [line] * len(shown) + [control])
        for panel, (name, lines) in zip(beside, shown.items(), strict=False):
            _draw_lines(panel, trace, name, lines, in_gray=True)
        _draw_control(beside[-1], trace, behaviors, colors)
        if trace.robots <= MAX_NAMED:
            legend(beside[0])


def _names_seen(view: View | None) -> set[str]:
    """Return the names that stand alone in a view: what they hold can be seen in the scene."""
    written = [view.at, *([view.heading] if view.heading else ()), *view.marks.values()] if view else []
    trees = [each.tree for value in written for each in expressions_in(value)]
    return {tree.name for tree in trees if isinstance(tree, Name)}


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


def _draw_lines(panel: Axes, trace: Trace, name: str, lines: Lines, *, in_gray: bool = False) -> None:
    for index, (label, values) in enumerate(lines.items()):
        chosen = "#333333" if not label else GRAYS[index % len(GRAYS)] if in_gray else color(index)
        style, width = (ROBOT_STYLES[index % len(ROBOT_STYLES)], 1.0) if in_gray else ("-", None)
        panel.plot(
            trace.steps, values, label=label, color=chosen, ls=style, marker=marker(len(values)), lw=width
        )
    every = {value for values in lines.values() for value in values}
    if every <= {0.0, 1.0}:
        panel.set(ylim=(-0.15, 1.15), yticks=(0, 1))
    panel.set_title(name)


def _rows(trace: Trace, spec: Spec) -> list[str]:
    """Return who can be in control, the highest layer first, and nobody where that happened."""
    named = [name for name in spec.structure or spec.behaviors if name in spec.behaviors]
    in_control = {name for robot in trace.controlling for name in robot}
    return [*named, *sorted(in_control - {*named, NOBODY}), *([NOBODY] if NOBODY in in_control else [])]


def _draw_control(
    panel: Axes, trace: Trace, behaviors: Sequence[str], colors: Sequence[str] | Mapping[str, str]
) -> None:
    """Draw when each behavior controlled which robot; colors are of robots, or of behaviors by name."""
    height = 0.8 / trace.robots
    for robot, controlling in enumerate(trace.controlling):
        for name, stretches in _stretches(controlling).items():
            top = behaviors.index(name) - 0.4 + robot * height
            chosen = colors[name] if isinstance(colors, Mapping) else colors[robot]
            panel.broken_barh(stretches, (top, height), facecolors=chosen, linewidth=0)
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
