"""Values and behaviors at a single moment: at the start of an episode, or in a situation that somebody describes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.scope import Findings
from bbsd.expression.vocabulary import DRAWS
from bbsd.language.field_types import Expression
from bbsd.language.meaning.episode.acting import modules_at
from bbsd.language.meaning.episode.outcome import definitions_at, scalars_defined
from bbsd.language.meaning.episode.starting import forms_of, starting_values
from bbsd.language.meaning.episode.stored import decision_at, slots_read, stored_sensors
from bbsd.language.meaning.moments import Moment
from bbsd.language.meaning.naming.definitions import read_definitions
from bbsd.language.meaning.naming.names import Names
from bbsd.language.meaning.naming.order import functions_called_in, within_definitions
from bbsd.language.meaning.partitions import is_partition

if TYPE_CHECKING:
    from collections.abc import Collection

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.meaning.meaning import Meaning
    from bbsd.language.models import Spec


def modules_in_a_situation(meaning: Meaning, given: Collection[str]) -> tuple[Module, ...]:
    """Return the behaviors with nodes that read world, state, the step, and no sensors but those that must be given.

    These are the sensors named in `given`, and all that draw or look at the step before. The nodes are of a graph of
    their own.
    """
    names = names_of(meaning)
    first = starting_values(names)
    beginning, now = Moment(names, first, names.graph.number(0), starting=True), slots_read(first, names)
    sensed = stored_sensors(beginning, {*given, *uncertain_sensors(meaning.spec)})
    # A decision reads what was sensed after the step before, which had the number before.
    earlier = names.graph.apply("-", names.step, names.graph.number(1))
    after = Moment(names, now, earlier, sensed=sensed)
    for name, sensor in meaning.spec.environment.sensors.items():
        for robot in names.robots:
            (after.partition if is_partition(sensor) else after.value)(name, robot)
    decision = Moment(names, now, names.step, sensed=after.sensed)
    return tuple(modules_at(names, decision, forms_of(first)))


def definitions_at_the_start(meaning: Meaning) -> dict[Slot, Node]:
    """Return definitions without parameters as nodes that read what is stored at the start, where before(e) is e."""
    names = names_of(meaning)
    first = starting_values(names)
    beginning = Moment(names, first, names.graph.number(0), starting=True)
    sensed = decision_at(slots_read(first, names), beginning, names).sensed
    stored = slots_read(first, names)
    start = Moment(names, stored, names.graph.number(0), sensed=sensed, starting=True)
    return scalars_defined(definitions_at(start))


def uncertain_sensors(spec: Spec) -> set[str]:
    """Return the sensors whose values do not follow from world and state alone: they draw, or use `before`."""
    environment = spec.environment
    uncertain = set[str]()
    for name, sensor in environment.sensors.items():
        own = [sensor] if isinstance(sensor, Expression) else [*sensor.values()]
        if functions_called_in(within_definitions(own, environment.definitions)) & {*DRAWS, "before"}:
            uncertain.add(name)
    return uncertain


def names_of(meaning: Meaning) -> Names:
    """Return what a spec's names stand for, in a fork of its graph; it has no mistakes, so that none are found."""
    findings = Findings()
    definitions = read_definitions(meaning.spec.environment.definitions, findings)
    return Names(meaning.spec, meaning.graph.fork(), findings, meaning.constants, definitions, {})
