"""Which values of an episode a figure shows, and which it leaves out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from bbsd.errors import did_you_mean
from bbsd.report.figures.files import FigureError

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from bbsd.evaluation import Trace
    from bbsd.evaluation.tracing.traced import Value
    from bbsd.expression.node_data import Slot
    from bbsd.language.models import Spec

    Kind = Literal["number", "whole", "truth", "cell"]

MAX_PANELS = 8
"""Values that are shown where none are chosen."""
REWARD = "reward"
"""The name of the panel of the reinforcement."""


@dataclass(frozen=True, slots=True)
class Curve:
    """A value of one robot or of all, at the start and after each step; cells as their places in the panel's labels."""

    label: str
    values: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class ValuePanel:
    """What one panel shows: a value of each robot and of each element, or one curve where all are the same."""

    name: str
    kind: Kind
    curves: tuple[Curve, ...]
    cells: tuple[str, ...] = ()
    alike: bool = False
    """Whether there are several robots, and the value is the same for all of them."""

    @property
    def title(self) -> str:
        """The panel's title."""
        return f"{self.name}, the same for all robots" if self.alike else self.name


@dataclass(frozen=True, slots=True)
class Choice:
    """The panels of a figure in their order, whether one of the reward is among them, and what is left out, by name."""

    panels: tuple[ValuePanel, ...]
    reward: bool
    left_out: tuple[str, ...]


def choice_of(trace: Trace, spec: Spec, in_view: Collection[str] = (), show: Sequence[str] = ()) -> Choice:
    """Choose what is shown: what `show` names, or the state, the world, and numbers that all robots sense alike.

    What a view shows already is not shown again, and not left out either. Raises FigureError for an unknown name.
    """
    values = _by_name(trace)
    if show:
        require_names(show, [*values, REWARD])
        panels = tuple(_panel(name, values[name], trace) for name in show if name != REWARD)
        return Choice(panels, REWARD in show, ())
    environment = spec.environment
    panels = tuple(_panel(name, slots, trace) for name, slots in values.items() if name not in in_view)
    own = {*environment.of_each_robot, *environment.world}
    order = [*environment.of_each_robot, *environment.world]
    chosen = [
        panel
        for panel in panels
        if panel.name in own
        or (panel.name in environment.sensors and _is_common(panel) and panel.kind in ("number", "whole"))
    ]
    chosen.sort(key=lambda panel: order.index(panel.name) if panel.name in own else len(order))
    shown = chosen[:MAX_PANELS]
    return Choice(
        tuple(shown), reward=True, left_out=tuple(panel.name for panel in panels if panel not in shown)
    )


def _is_common(panel: ValuePanel) -> bool:
    return panel.alike or len(panel.curves) == 1


def require_names(show: Sequence[str], known: Sequence[str]) -> None:
    """Raise FigureError where one of the names that are to be shown is unknown."""
    for name in show:
        if name not in known:
            hint = did_you_mean(name, known)
            raise FigureError(f"--show {name}: an episode has no value of that name{hint}")


def names_to_show(spec: Spec) -> list[str]:
    """Return all names that a figure can show: state, world, sensors, definitions without parameters, the reward."""
    environment = spec.environment
    definitions = [name for name in environment.definitions if "(" not in name]
    return [*environment.of_each_robot, *environment.world, *environment.sensors, *definitions, REWARD]


def _by_name(trace: Trace) -> dict[str, dict[Slot, list[Value]]]:
    by_name: dict[str, dict[Slot, list[Value]]] = {}
    for slot, column in trace.values.items():
        by_name.setdefault(slot.name, {})[slot] = [trace.start[slot], *column]
    return by_name


def _panel(name: str, slots: dict[Slot, list[Value]], trace: Trace) -> ValuePanel:
    kind = _kind([value for column in slots.values() for value in column])
    cells = _cells(name, slots, trace) if kind == "cell" else ()
    numbers = {
        slot: tuple(float(cells.index(str(value)) if cells else value) for value in column)
        for slot, column in slots.items()
    }
    robots = len({slot.robot for slot in numbers})
    alike = robots > 1 and all(values == numbers[slot._replace(robot=0)] for slot, values in numbers.items())
    curves = tuple(
        Curve(_label(slot, 1 if alike else robots), values)
        for slot, values in numbers.items()
        if not alike or slot.robot == 0
    )
    return ValuePanel(name, kind, curves, cells, alike=alike)


def _kind(values: Sequence[Value]) -> Kind:
    if any(isinstance(value, str) for value in values):
        return "cell"
    if all(isinstance(value, bool) for value in values):
        return "truth"
    return "whole" if all(isinstance(value, int) for value in values) else "number"


def _cells(name: str, slots: dict[Slot, list[Value]], trace: Trace) -> tuple[str, ...]:
    """Return the names that a value can be one of, or the cells of a sensor.

    These are all where a behavior has it as an input, else those that it was in, in turn.
    """
    if name in trace.named:
        return trace.named[name]
    for layer in trace.layers:
        if name in layer.inputs:
            return tuple(layer.inputs[name])
    return tuple(dict.fromkeys(str(value) for column in slots.values() for value in column))


def _label(slot: Slot, robots: int) -> str:
    robot = f"robot {slot.robot}" if slot.robot is not None and robots > 1 else ""
    return robot + "".join(f"[{index}]" for index in slot.place)
