"""What behaviors perceive where a sensor is faulty: reward, dynamics and expectations still go by what is true."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Literal, NamedTuple

from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.scope import Named
from bbsd.kernel.streams import name_word
from bbsd.language.meaning.episode.stored import slots_of_sensors, stored_sensors
from bbsd.language.meaning.moments import Moment

if TYPE_CHECKING:
    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Scope, Value
    from bbsd.language.meaning.naming.names import Names, Stored
    from bbsd.language.meaning.partitions import Partition


class SensorFault(NamedTuple):
    """A fault of a sensor of all robots, from the decision of step `since` on, counted from 1.

    With `noise` a normal draw of standard deviation `size` is added, a `frozen` sensor keeps the value of that step, a
    `lost` one has 0, false, or the first cell.
    """

    sensor: str
    kind: Literal["noise", "frozen", "lost"]
    since: int
    size: float = 0.0


class Perceived(Moment):
    """A moment as robots with a faulty sensor perceive it; sensors that read the faulty one go wrong with it."""

    def __init__(
        self,
        names: Names,
        stored: Stored,
        step: Node,
        fault: SensorFault,
        *,
        starting: bool = False,
        before: Scope | None = None,
    ) -> None:
        self._fault, self._step = fault, step
        super().__init__(names, stored, step, starting=starting, before=before)

    def value(self, name: str, robot: int) -> Value:
        """Return what is perceived of a sensor that is no partition."""
        known = (name, robot) in self.sensed.values
        value = super().value(name, robot)
        if name == self._fault.sensor and not known:
            value = self.sensed.values[name, robot] = self._faulty(value, robot, ())
        return value

    def partition(self, name: str, robot: int) -> Partition | None:
        """Return what is perceived of a sensor that is a partition."""
        known = (name, robot) in self.sensed.partitions
        partition = super().partition(name, robot)
        if name == self._fault.sensor and partition is not None and not known:
            index = self._scalar(partition.index, Slot(perceived_name(self.names, name), robot))
            partition = self.sensed.partitions[name, robot] = replace(partition, index=index)
        return partition

    def slots(self) -> dict[Slot, Node]:
        """Return all that is perceived, by the slots that keep it until the decision."""
        return slots_of_sensors(self, partial(perceived_name, self.names))

    def _faulty(self, value: Value, robot: int, place: tuple[int, ...]) -> Value:
        if isinstance(value, tuple):
            return tuple(self._faulty(item, robot, (*place, index)) for index, item in enumerate(value))
        if isinstance(value, Named):
            slot = Slot(perceived_name(self.names, self._fault.sensor), robot, place)
            return value.with_nodes(lambda node: self._scalar(node, slot))
        return self._scalar(value, Slot(perceived_name(self.names, self._fault.sensor), robot, place))

    def _scalar(self, true: Node, slot: Slot) -> Node:
        """Return what is perceived of one value; a decision perceives what was sensed after the step before it."""
        graph, fault = self.names.graph, self._fault
        if fault.kind == "frozen":
            is_late = graph.apply(">", self._step, graph.number(fault.since - 1))
            return graph.apply("select", is_late, graph.leaf("slot", slot, true.kind, Level.LANE), true)
        is_faulty = graph.apply(">=", self._step, graph.number(fault.since - 1))
        return graph.apply(
            "select", is_faulty, self._lost(true) if fault.kind == "lost" else self._noisy(true, slot), true
        )

    def _lost(self, true: Node) -> Node:
        graph = self.names.graph
        match true.kind:
            case Kind.TRUTH:
                return graph.truth(value=False)
            case Kind.CELL:
                return graph.cell(0)
        return graph.number(0.0)

    def _noisy(self, true: Node, slot: Slot) -> Node:
        """Return a value with noise, each robot's and each element's drawn from a stream of its own."""
        graph = self.names.graph
        word = name_word(f"noise of the sensor {self._fault.sensor}, robot {slot.robot}, place {slot.place}")
        noise = graph.draw("normal", word, (graph.number(0.0), graph.number(self._fault.size)))
        return graph.apply("+", true, noise)


def perceived_name(names: Names, sensor: str) -> str:
    """Return the name of the slots that keep what is perceived of a sensor, which nothing else has."""
    environment = names.spec.environment
    taken = {*environment.sensors, *environment.state, *environment.world}
    name = f"perceived_{sensor}"
    while name in taken:
        name += "_"
    return name


def decision_perceived(now: Stored, beginning: Perceived, names: Names) -> Moment:
    """Return the snapshot as it is perceived, read from where the step before, or the start, stored it."""
    sensors = names.spec.environment.sensors
    sensed = stored_sensors(beginning, sensors, partial(perceived_name, names))
    return Moment(names, now, names.step, sensed=sensed)
