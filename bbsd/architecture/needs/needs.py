"""What a robot needs to decide for itself, as values: what it is given, what it keeps, its decision from both.

The nodes here read, by their leaves: slots of what is given (world, state, sensors), slots of the robot's memory, among
them `before` slots; the step; draws of assignments; and in what is kept, `acted` slots.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.expression.graph import Graph, Node
    from bbsd.expression.node_data import Slot, Variable


@dataclass(frozen=True, slots=True)
class Given:
    """A value that a robot must be given before each decision.

    `slots` are its scalars: of the world, of the robot itself, or of every robot of the team where `of_team`.
    """

    name: str
    block: str
    """The block of the spec that it belongs to: world, state, observation (`earned` too) or sensors."""
    of_team: bool
    slots: tuple[Slot, ...]
    """Of robot 0, or of the team in the robots' order."""


@dataclass(frozen=True, slots=True)
class RobotNeeds:
    """One robot's decision as nodes."""

    cells: Mapping[int, Node]
    """For each dimension of the controller that a layer uses, the index of its present cell, or a truth."""
    sets: Mapping[int, Mapping[Variable, Node]]
    """For each action that a table contains, by its number, what it sets: state, or each element that it may set."""
    held: Mapping[Variable, Node]
    """What each state variable that actions set, and each element of one, has before they do."""
    start: Mapping[Slot, Node]
    """What is kept, and its value before the first step; only constants occur in it."""
    next: Mapping[Slot, Node]
    """What is kept for the next step; the state that actions set is read as `acted`."""

    @property
    def set_values(self) -> list[Node]:
        """The values that actions set."""
        return [node for sets in self.sets.values() for node in sets.values()]

    @property
    def outputs(self) -> list[Node]:
        """All nodes that are computed in a step."""
        return [*self.cells.values(), *self.set_values, *self.held.values(), *self.next.values()]


@dataclass(frozen=True, slots=True)
class Needs:
    """What is given, what is kept, and each robot's decision from it."""

    graph: Graph
    given: tuple[Given, ...]
    memory: tuple[str, ...]
    """The state variables that the robot itself keeps."""
    robots: tuple[RobotNeeds, ...]
    named: Mapping[Slot, Node]
    """Sensors that are computed, of all robots; and definitions without parameters, if they were asked for."""

    @property
    def outputs(self) -> list[Node]:
        """All nodes that are computed in a step, of all robots."""
        return [node for robot in self.robots for node in robot.outputs]


class NotRemembered(UsageError):
    """A value was to be remembered by the robot that it cannot know."""

    advice = "a robot remembers state whose start and changes it knows: no draws, nothing of the world or of others"


class NotMeasured(UsageError):
    """A value was to be measured that is neither a sensor nor state."""

    advice = "name sensors or state of the spec"
