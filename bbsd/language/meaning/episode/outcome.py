"""What follows from a step: definitions, reward, the end, and what behaviors expect."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.expression.elaboration import elaboration
from bbsd.language.meaning.naming.names import Stored, names_in, scalars_by_slot
from bbsd.language.meaning.outside.exchange import has_ended

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.expression.scope import Value
    from bbsd.language.meaning.moments import Moment


def definitions_at(outcome: Moment) -> dict[tuple[str, int], Value]:
    """Return definitions without parameters, robot by robot; look through the others only for mistakes."""
    names = outcome.names
    values: dict[tuple[str, int], Value] = {}
    for name, definition in names.definitions.items():
        for robot in names.robots:
            unknown = dict.fromkeys(definition.parameters, names.graph.unknown)
            scope = replace(outcome.scope.at(definition.path, robot), local=unknown)
            value = elaboration.value(definition.expression, scope)
            if not definition.parameters:
                values[name, robot] = value
    return values


def scalars_defined(defined: Mapping[tuple[str, int], Value]) -> dict[Slot, Node]:
    """Return the scalars of what is defined, robot by robot."""
    return {
        slot: node
        for (name, robot), value in defined.items()
        for slot, node in scalars_by_slot(value, name, robot).items()
    }


def named_values(
    first: Stored, sensed: Mapping[tuple[str, int], Value], defined: Mapping[tuple[str, int], Value]
) -> dict[str, tuple[str, ...]]:
    """Return the names of all values that have some, by what has them."""
    values = {name: of_robots[0] for name, of_robots in first.items()}
    values |= {name: value for (name, robot), value in (*sensed.items(), *defined.items()) if not robot}
    return {name: names for name, value in values.items() if (names := names_in(value))}


def reward_at(outcome: Moment) -> dict[str, tuple[Node, ...]]:
    """Return each reward term, robot by robot."""
    return {
        term: tuple(
            elaboration.number(expression.tree, outcome.scope.at(("reward", term), robot))
            for robot in outcome.names.robots
        )
        for term, expression in outcome.names.spec.reward.items()
    }


def ends_at(outcome: Moment) -> Node | None:
    """Return whether the episode ends with the step; None where only its number of steps ends it."""
    names = outcome.names
    environment = names.spec.environment
    conditions = [has_ended(names.graph)] if environment.outside else []
    if environment.ends is not None:
        scope = outcome.scope.at(("environment", "ends"), names.team)
        conditions.insert(0, elaboration.truth(environment.ends.tree, scope))
    return names.graph.fold("|", conditions) if conditions else None


def expectations_at(outcome: Moment, decision: Moment) -> dict[str, tuple[Node, ...]]:
    """Return what behaviors expect after the step, of what they may know; `before(e)` is e at the decision.

    Elaborated last, so that the numbers of all other nodes, and with them the solver's kernel, are the same without.
    """
    names = outcome.names
    expectations: dict[str, tuple[Node, ...]] = {}
    for name, behavior in names.spec.behaviors.items():
        if behavior.expects is not None:
            scope = replace(outcome.behavior_scope(name), before=decision.behavior_scope(name))
            path = ("behaviors", name, "expects")
            expectations[name] = tuple(
                elaboration.truth(behavior.expects.tree, scope.at(path, robot)) for robot in names.robots
            )
    return expectations
