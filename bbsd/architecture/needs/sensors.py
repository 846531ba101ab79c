"""Sensors as they follow from what is stored: world, state, other sensors, and what was before."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from bbsd.architecture.needs.naming import before
from bbsd.expression.graph import Graph, Level
from bbsd.expression.scope import Named
from bbsd.language.field_types import Expression
from bbsd.language.meaning.episode.outcome import definitions_at, scalars_defined
from bbsd.language.meaning.episode.starting import starting_values
from bbsd.language.meaning.episode.stored import slots_read, stored_sensors
from bbsd.language.meaning.moments import Moment, Sensed
from bbsd.language.meaning.naming.names import Names, refilled, scalars_by_slot
from bbsd.language.meaning.naming.order import dependency_order, names_used_in, uses_among, within_definitions
from bbsd.language.meaning.partitions import is_partition
from bbsd.language.meaning.situation import names_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.expression.scope import Value
    from bbsd.language.meaning import Meaning
    from bbsd.language.models import PartitionText, Spec

    IsGiven = Callable[[str, Mapping[Slot, Node]], bool]
    """Whether a sensor must be given, by its name and the nodes that compute it for each robot."""


@dataclass(frozen=True, slots=True)
class Sensors:
    """The nodes of each sensor's values (of a partition: of its cell), in a graph of their own.

    They read slots of world, state and of the sensors in `given`; where they say `before`, slots that keep what these
    were at the decision before. In the first step there was none, and `before(e)` is e. Sensors read the step
    that is to come, less one.
    """

    graph: Graph
    nodes: Mapping[Slot, Node]
    given: frozenset[str]
    definitions: Mapping[Slot, Node]
    """Definitions without parameters, if they were asked for."""


def sensors_of(meaning: Meaning, is_given: IsGiven, *, definitions: bool = False) -> Sensors:
    """Return the sensors of a decision, those that must be given as leaves that read their slots."""
    names = names_of(meaning)
    names.graph.bounded = False
    return _Resolver(names, is_given).resolved(definitions=definitions)


@dataclass(slots=True)
class _Resolver:
    """Elaborates one sensor after the other, each after those that it uses."""

    names: Names
    is_given: IsGiven
    nodes: dict[Slot, Node] = field(default_factory=dict)
    given: set[str] = field(default_factory=set)

    def resolved(self, *, definitions: bool) -> Sensors:
        names, graph = self.names, self.names.graph
        first = starting_values(names)
        now = slots_read(first, names)
        start = Moment(names, first, graph.number(0), starting=True)
        stored = stored_sensors(start, names.spec.environment.sensors)
        earlier = graph.apply("-", names.step, graph.number(1))
        scope = Moment(
            names,
            {name: tuple(map(self._value_before, values)) for name, values in now.items()},
            earlier,
            sensed=Sensed({key: self._value_before(value) for key, value in stored.values.items()}),
        ).scope
        later = Moment(names, now, earlier, before=scope)
        first_time = Moment(names, now, earlier, starting=True)
        for name in sensor_order(names.spec):
            own = {
                robot: self._combined(_elaborated(later, name, robot), _elaborated(first_time, name, robot))
                for robot in names.robots
            }
            if self.is_given(name, {slot: node for nodes in own.values() for slot, node in nodes.items()}):
                self.given.add(name)
                own = {robot: _by_slot(stored, name, robot) for robot in names.robots}
            for robot, nodes in own.items():
                self.nodes.update(nodes)
                for moment in (later, first_time):
                    _set(moment.sensed, name, robot, [*nodes.values()])
        defined = scalars_defined(definitions_at(later)) if definitions else {}
        return Sensors(graph, self.nodes, frozenset(self.given), defined)

    def _combined(self, later: Mapping[Slot, Node], first: Mapping[Slot, Node]) -> dict[Slot, Node]:
        """Return the values of a sensor in any step, given those in later steps and in the first one."""
        graph = self.names.graph
        is_first = graph.apply("==", self.names.step, graph.number(1))
        return {slot: graph.apply("select", is_first, first[slot], node) for slot, node in later.items()}

    def _before(self, leaf: Node) -> Node:
        return self.names.graph.leaf("slot", before(leaf.slot), leaf.kind, Level.LANE)

    def _value_before(self, value: Value) -> Value:
        if isinstance(value, tuple):
            return tuple(map(self._value_before, value))
        return value.with_nodes(self._before) if isinstance(value, Named) else self._before(value)


def _elaborated(moment: Moment, name: str, robot: int) -> dict[Slot, Node]:
    """Return the scalars of a robot's sensor at a moment, of a partition the index of its cell."""
    is_cut = is_partition(moment.names.spec.environment.sensors[name])
    (moment.partition if is_cut else moment.value)(name, robot)
    return _by_slot(moment.sensed, name, robot)


def _set(sensed: Sensed, name: str, robot: int, nodes: Sequence[Node]) -> None:
    """Let what uses a sensor use these nodes of its scalars."""
    partition = sensed.partitions.get((name, robot))
    if partition is not None:
        sensed.partitions[name, robot] = replace(partition, index=nodes[0])
    else:
        sensed.values[name, robot] = refilled(sensed.values[name, robot], iter(nodes))


def _by_slot(sensed: Sensed, name: str, robot: int) -> dict[Slot, Node]:
    partition = sensed.partitions.get((name, robot))
    value = sensed.values[name, robot] if partition is None else partition.index
    return scalars_by_slot(value, name, robot)


def sensor_order(spec: Spec) -> list[str]:
    """Return the sensors, each after those that it uses."""
    environment = spec.environment
    uses = {name: _names_in(sensor, environment.definitions) for name, sensor in environment.sensors.items()}
    return dependency_order(uses_among(uses))


def _names_in(sensor: PartitionText, definitions: Mapping[str, Expression]) -> frozenset[str]:
    """Return the names that a sensor uses, also within definitions."""
    own = [sensor] if isinstance(sensor, Expression) else [*sensor.values()]
    return names_used_in(within_definitions(own, definitions))
