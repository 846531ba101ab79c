"""What the names of a spec mean at each moment of an episode: one scope a moment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, cast

from bbsd.expression import elaboration
from bbsd.expression.graph import Graph, Level, Node
from bbsd.expression.kinds import Kind
from bbsd.expression.scope import (
    Binding,
    Definition,
    Findings,
    Path,
    PerRobot,
    Scope,
    Shared,
    Unseen,
    Unusable,
    Value,
)
from bbsd.language.meaning.partitions import Partition, elaborate_partition, is_partition

if TYPE_CHECKING:
    from bbsd.language.field_types import Expression
    from bbsd.language.meaning.constants import Constants
    from bbsd.language.models import Spec

Stored = Mapping[str, tuple[Node, ...]]
"""The values of state (one a robot) and of the world (one) at some moment of a step."""

Slot = tuple[str, int | None, tuple[int, ...]]
"""What is kept from one step to the next: a name, the robot (None: the world's), the place in a list."""


@dataclass(frozen=True, slots=True)
class Names:
    """What is the same at every moment."""

    spec: Spec
    graph: Graph
    findings: Findings
    constants: Constants
    definitions: Mapping[str, Definition]
    unusable: Mapping[str, Unusable]
    """Names whose own mistakes were told already."""

    @property
    def robots(self) -> range:
        """The robots' indices."""
        return range(self.spec.environment.robots)

    @property
    def team(self) -> int | None:
        """The robot that a team-level expression is for: the only one, or none."""
        return 0 if len(self.robots) == 1 else None

    @property
    def step(self) -> Node:
        """The number of the present step."""
        return self.graph.leaf("step", None, Kind.NUMBER, Level.STEP)

    def scope(self, bindings: Mapping[str, Binding], step: Node) -> Scope:
        """The scope of a moment: constants, definitions and positions, then the moment's own names."""
        graph = self.graph
        names: dict[str, Binding] = {
            "step": Shared(step),
            "steps": Shared(graph.number(self.spec.environment.steps)),
            "robots": Shared(graph.number(len(self.robots))),
            "robot": PerRobot(graph.number),
            "generation": Unusable(
                "BB066", "generation is known only in constants", "make a constant of it and use that"
            ),
            **{name: Shared(leaves) for name, leaves in self.constants.leaves.items()},
            **self.definitions,
            **bindings,
            **self.unusable,
        }
        return Scope(graph, names, self.findings, robots=len(self.robots), static=self.constants.static)


@dataclass(slots=True)
class Moment:
    """A scope and the sensors in it, each evaluated when it is first used."""

    names: Names
    scope: Scope = field(init=False)
    values: dict[tuple[str, int], Value] = field(default_factory=dict)
    partitions: dict[tuple[str, int], Partition | None] = field(default_factory=dict)

    def value(self, name: str, robot: int) -> Value:
        """A plain sensor of one robot."""
        if (name, robot) not in self.values:
            written = cast("Expression", self.names.spec.environment.sensors[name])
            here = self.scope.at(("environment", "sensors", name), robot, draws=True)
            self.values[name, robot] = elaboration.value(written.tree, here)
        return self.values[name, robot]

    def partition(self, name: str, robot: int) -> Partition | None:
        """A sensor that is a partition, of one robot."""
        if (name, robot) not in self.partitions:
            path: Path = ("environment", "sensors", name)
            here = self.scope.at(path, robot, draws=True)
            self.partitions[name, robot] = elaborate_partition(
                self.names.spec.environment.sensors[name], here, path, robot
            )
        return self.partitions[name, robot]


def moment(names: Names, stored: Stored, step: Node, sensors: Moment | None = None) -> Moment:
    """A moment at which stored values are as given; its sensors are evaluated anew, or another moment's."""
    made = Moment(names) if sensors is None else replace(sensors)
    sensed = {
        name: _partitioned(name) if is_partition(written) else PerRobot(partial(made.value, name))
        for name, written in names.spec.environment.sensors.items()
    }
    made.scope = names.scope(_stored_names(stored, names) | sensed, step)
    return made


def alone(moment: Moment, behavior: str) -> Scope:
    """The scope of a behavior at a moment: its own robot's state and sensors."""
    hidden: dict[str, Binding] = dict.fromkeys(moment.names.spec.environment.world, Unseen())
    names = {**moment.scope.names, **hidden, **moment.names.unusable}
    return replace(moment.scope, names=names, behavior=behavior, memo={}, unseen={})


def _stored_names(stored: Stored, names: Names) -> dict[str, Binding]:
    world = names.spec.environment.world
    return {
        name: Shared(values[0]) if name in world else PerRobot(values.__getitem__)
        for name, values in stored.items()
    }


def _partitioned(name: str) -> Unusable:
    advice = "only behaviors' inputs use partitions; use the value that it cuts"
    return Unusable("BB067", f"{name} is a partition, not a value", advice)


def slots_of(name: str, robot: int | None, shape: Value, graph: Graph, place: tuple[int, ...] = ()) -> Value:
    """Leaves that read a stored value of the same shape as `shape`."""
    if isinstance(shape, tuple):
        return tuple(slots_of(name, robot, item, graph, (*place, index)) for index, item in enumerate(shape))
    return slot((name, robot, place), shape, graph)


def slot(data: Slot, like: Node, graph: Graph) -> Node:
    """The leaf that reads a stored value of the same kind as `like`."""
    return like if like.kind is Kind.UNKNOWN else graph.leaf("slot", data, like.kind, Level.LANE)


def flat(value: Value, name: str, robot: int | None, place: tuple[int, ...] = ()) -> dict[Slot, Node]:
    """The scalars of a value by the slots that store them."""
    if isinstance(value, tuple):
        return {
            slot: node
            for index, item in enumerate(value)
            for slot, node in flat(item, name, robot, (*place, index)).items()
        }
    return {(name, robot, place): value}
