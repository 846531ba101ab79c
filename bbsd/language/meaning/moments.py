"""The moments of an episode at which expressions are evaluated: start, decision, after the actions, after the step."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, cast

from bbsd.expression.elaboration import elaboration
from bbsd.expression.elaboration.naming import one_reading
from bbsd.expression.scope import Binding, Path, PerRobot, Scope, Shared, Unseen, Unusable, Value
from bbsd.language.meaning.partitions import Partition, conditions_of_cells, elaborate_partition, is_partition

if TYPE_CHECKING:
    from bbsd.expression.graph import Node
    from bbsd.language.field_types import Expression
    from bbsd.language.meaning.naming.names import Names, Stored
    from bbsd.language.models import PartitionText


@dataclass(frozen=True, slots=True)
class Sensed:
    """Sensors by name and robot: values, and partitions (None after a mistake)."""

    values: dict[tuple[str, int], Value] = field(default_factory=dict)
    partitions: dict[tuple[str, int], Partition | None] = field(default_factory=dict)


class Moment:
    """A scope and the sensors in it, each evaluated when it is first used, unless it is among those `sensed`."""

    def __init__(
        self,
        names: Names,
        stored: Stored,
        step: Node,
        *,
        sensed: Sensed | None = None,
        starting: bool = False,
        before: Scope | None = None,
    ) -> None:
        self.names = names
        self.sensed = Sensed() if sensed is None else sensed
        bindings = _stored_names(stored, names) | self._sensor_names()
        self.scope = names.scope(bindings, step, starting=starting, before=before)

    def value(self, name: str, robot: int) -> Value:
        """Return the value of a sensor that is no partition, of one robot."""
        values = self.sensed.values
        if (name, robot) not in values:
            sensor = cast("Expression", self.names.spec.environment.sensors[name])
            scope = self.scope.at(("environment", "sensors", name), robot, draws=True)
            values[name, robot] = one_reading(elaboration.value(sensor.tree, scope), sensor.tree.span, scope)
        return values[name, robot]

    def partition(self, name: str, robot: int) -> Partition | None:
        """Return a sensor that is a partition, of one robot; None after a mistake."""
        partitions = self.sensed.partitions
        if (name, robot) not in partitions:
            path: Path = ("environment", "sensors", name)
            scope = self.scope.at(path, robot, draws=True)
            sensor = self.names.spec.environment.sensors[name]
            partitions[name, robot] = elaborate_partition(sensor, scope, path, robot)
        return partitions[name, robot]

    def behavior_scope(self, behavior: str) -> Scope:
        """Return the scope of a behavior, which knows only its own robot's state and sensors."""
        hidden: dict[str, Binding] = dict.fromkeys(self.names.spec.environment.world, Unseen())
        names = {**self.scope.names, **hidden, **self.names.unusable}
        return replace(self.scope, names=names, behavior=behavior, memo={}, unseen={})

    def _sensor_names(self) -> dict[str, Binding]:
        return {
            name: _partition_name(name, sensor)
            if is_partition(sensor)
            else PerRobot(partial(self.value, name))
            for name, sensor in self.names.spec.environment.sensors.items()
        }


def _stored_names(stored: Stored, names: Names) -> dict[str, Binding]:
    world = names.spec.environment.world
    return {
        name: Shared(values[0]) if name in world else PerRobot(values.__getitem__)
        for name, values in stored.items()
    }


def _partition_name(name: str, sensor: PartitionText) -> Unusable:
    advice = "only behaviors' inputs use partitions; use the value that it cuts"
    return Unusable("BB067", f"{name} is a partition, not a value", advice, conditions_of_cells(sensor))
