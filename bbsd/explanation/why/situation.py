"""A situation of one robot: whether each behavior is excited, the cell it is in, and the values behind that."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from bbsd.errors import UsageError
from bbsd.expression.nesting import by_name, lengths_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.evaluation import Trace
    from bbsd.evaluation.tracing.traced import Value
    from bbsd.expression.node_data import Slot, Variable

Listed: TypeAlias = "Value | tuple[Listed, ...]"
"""A value, or those of a list, which may hold lists."""


class NoSuchMoment(UsageError):
    """A step or a robot was asked for that an episode does not have."""


@dataclass(frozen=True, slots=True)
class Situation:
    """What one robot's behaviors perceive before a step, behaviors in the spec's order."""

    excited: tuple[bool, ...]
    cells: tuple[int, ...]
    """Each behavior's cell in its own table, also where it is not excited."""
    values: Mapping[str, Listed]
    """The robot's own state, its sensors, and the world, by name; those that are known."""


def situation_in(trace: Trace, step: int, robot: int) -> Situation:
    """Return the situation of a robot before a step of an episode, counted from 1.

    Raises:
        NoSuchMoment: the episode has no such step, or the team no such robot.
    """
    require_robot(robot, trace.robots)
    if not 1 <= step <= len(trace.steps):
        raise NoSuchMoment(f"there is no step {step}: the episode has steps 1 to {len(trace.steps)}")
    decisions = trace.decisions
    return Situation(
        tuple(decisions.excited[step - 1, robot].tolist()),
        tuple(decisions.cells[step - 1, robot].tolist()),
        values_of_robot(trace.before(step), robot),
    )


def require_robot(robot: int, robots: int) -> None:
    """Raise NoSuchMoment where a team of so many robots does not have a robot of that index."""
    if not 0 <= robot < robots:
        known = f"robots are counted from 0 to {robots - 1}" if robots > 1 else "there is only robot 0"
        raise NoSuchMoment(f"there is no robot {robot}: {known}")


def values_of_robot(stored: Mapping[Slot, Value], robot: int) -> dict[str, Listed]:
    """Return the values that are a robot's own or the world's, by name; those of lists as nested tuples."""
    own: dict[Variable, Listed] = {
        slot.variable: value for slot, value in stored.items() if slot.robot in (None, robot)
    }
    return by_name([*own], [*own.values()], lengths_of(own), tuple)
