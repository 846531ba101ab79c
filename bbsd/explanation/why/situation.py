"""A situation of one robot: whether each behavior is excited, the cell it is in, and the values behind that."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

from bbsd.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.evaluation import Trace
    from bbsd.expression.node_data import Slot

Value: TypeAlias = "float | int | bool | str"


class NoSuchMoment(UsageError):
    """A step or a robot was asked for that an episode does not have."""


@dataclass(frozen=True, slots=True)
class Situation:
    """What one robot's behaviors perceive before a step, behaviors in the spec's order."""

    excited: tuple[bool, ...]
    cells: tuple[int, ...]
    """Each behavior's cell in its own table, also where it is not excited."""
    values: Mapping[str, Value | tuple[Value, ...]] = field(default_factory=dict)
    """The robot's own state, its sensors, and the world, by name, as they were; those that are known."""


def situation_in(trace: Trace, step: int, robot: int) -> Situation:
    """Return the situation of a robot before a step of an episode, counted from 1.

    Raises:
        NoSuchMoment: the episode has no such step, or the team no such robot.
    """
    if not 0 <= robot < trace.robots:
        raise NoSuchMoment(f"there is no robot {robot}: robots are counted from 0 to {trace.robots - 1}")
    if not 1 <= step <= len(trace.steps):
        raise NoSuchMoment(f"there is no step {step}: the episode has steps 1 to {len(trace.steps)}")
    decisions = trace.decisions
    return Situation(
        tuple(decisions.excited[step - 1, robot].tolist()),
        tuple(decisions.cells[step - 1, robot].tolist()),
        values_of_robot(trace.before(step), robot),
    )


def values_of_robot(stored: Mapping[Slot, Value], robot: int) -> dict[str, Value | tuple[Value, ...]]:
    """Return the values that are a robot's own or the world's, by name; those of a list together."""
    by_name: dict[str, list[Value]] = {}
    is_list = {slot.name: bool(slot.place) for slot in stored}
    for slot, value in stored.items():
        if slot.robot in (None, robot):
            by_name.setdefault(slot.name, []).append(value)
    return {name: tuple(values) if is_list[name] else values[0] for name, values in by_name.items()}


def plain_values(values: Mapping[str, Value | tuple[Value, ...]]) -> dict[str, Value | Sequence[Value]]:
    """Return values for JSON."""
    return {name: [*value] if isinstance(value, tuple) else value for name, value in values.items()}
