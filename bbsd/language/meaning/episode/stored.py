"""What is stored from one step to the next: leaves that read it, and the values that slots get."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import Level, Node
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.language.meaning.moments import Moment, Sensed
from bbsd.language.meaning.naming.names import Names, Stored, read_slots, scalars_by_slot
from bbsd.language.meaning.partitions import Partition, is_partition

if TYPE_CHECKING:
    from collections.abc import Callable, Collection


def slots_read(stored: Stored, names: Names) -> Stored:
    """Return the leaves that read the slots of stored values."""
    world = names.spec.environment.world
    return {
        name: tuple(
            read_slots(name, None if name in world else robot, value, names.graph)
            for robot, value in enumerate(values)
        )
        for name, values in stored.items()
    }


def decision_at(now: Stored, beginning: Moment, names: Names) -> Moment:
    """Return the snapshot: state and sensors are read from where the step before, or the start, stored them."""
    return Moment(names, now, names.step, sensed=stored_sensors(beginning, names.spec.environment.sensors))


def stored_sensors(
    beginning: Moment, sensors: Collection[str], stored_as: Callable[[str], str] = lambda sensor: sensor
) -> Sensed:
    """Return the leaves that read sensors from where the step before, or the start, stored them, by what names."""
    names, sensed = beginning.names, Sensed()
    for name, sensor in names.spec.environment.sensors.items():
        for robot in names.robots if name in sensors and name not in names.unusable else ():
            if is_partition(sensor):
                partition = beginning.partition(name, robot)
                slot = names.graph.leaf("slot", Slot(stored_as(name), robot), Kind.CELL, Level.LANE)
                sensed.partitions[name, robot] = partition and Partition(partition.cells, slot)
            else:
                value = beginning.value(name, robot)
                sensed.values[name, robot] = read_slots(stored_as(name), robot, value, names.graph)
    return sensed


def slots_of_state(stored: Stored, names: Names) -> dict[Slot, Node]:
    """Return the scalars of state and world by the slots that store them."""
    world = names.spec.environment.world
    return {
        slot: node
        for name, values in stored.items()
        for robot, value in enumerate(values)
        for slot, node in scalars_by_slot(value, name, None if name in world else robot).items()
    }


def slots_of_sensors(
    moment: Moment, stored_as: Callable[[str], str] = lambda sensor: sensor
) -> dict[Slot, Node]:
    """Return the scalars of sensors, and the cells of those that are partitions, by the slots that store them."""
    names = moment.names
    nodes: dict[Slot, Node] = {}
    for name, sensor in names.spec.environment.sensors.items():
        for robot in names.robots if name not in names.unusable else ():
            if is_partition(sensor):
                partition = moment.partition(name, robot)
                nodes |= {} if partition is None else {Slot(stored_as(name), robot): partition.index}
            else:
                nodes |= scalars_by_slot(moment.value(name, robot), stored_as(name), robot)
    return nodes
