"""What an episode exchanges with an environment that is stepped in Python, as slots and leaves of the graph."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, Level, Node
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.language.outside import EARNED, ENDED

if TYPE_CHECKING:
    from bbsd.language.models import Environment

ONLY_OUTSIDE = "the environment alone sets it; keep a value of your own in state, and compute that"
"""What to do instead of setting a name that an environment in Python sets."""


def names_outside(environment: Environment) -> tuple[str, ...]:
    """Return the names that an environment in Python sets for each robot; none where the world is the spec's own."""
    return environment.outside.names if environment.outside else ()


def size_of_field(environment: Environment, name: str) -> int | None:
    """Return the size of an observed field that has two values or more; None for other names."""
    fields = environment.outside.fields if environment.outside else ()
    return next((field.size for field in fields if field.name == name and (field.size or 0) > 1), None)


def what_sets(name: str) -> str:
    """Return what a message says of a name that an environment in Python sets."""
    return f"{name} is {'what the environment rewards' if name == EARNED else 'an observation'}"


def value_outside(name: str, robot: int, graph: Graph) -> Node:
    """Return the leaf that holds what the environment gave last: at the start by its reset, in a step by that step."""
    return graph.leaf("outside", Slot(name, robot), Kind.NUMBER, Level.LANE)


def has_ended(graph: Graph) -> Node:
    """Return the leaf that says whether the environment ended in this step."""
    return graph.leaf("outside", Slot(ENDED), Kind.TRUTH, Level.LANE)


def rows_of_outside(environment: Environment) -> tuple[Slot, ...]:
    """Return what an environment gives at each step: its fields, what it rewards, robots in order; whether it ended."""
    names = names_outside(environment)
    rows = tuple(Slot(name, robot) for name in names for robot in range(environment.robots))
    return (*rows, Slot(ENDED)) if rows else ()


def rows_of_sent(environment: Environment) -> tuple[Slot, ...]:
    """Return what an environment is told at each step: state by name, robots in order."""
    actions = environment.outside.actions if environment.outside else ()
    return tuple(Slot(name, robot) for name in actions for robot in range(environment.robots))


def fractions_outside(environment: Environment) -> frozenset[Slot]:
    """Return what an environment gives that need not be a whole number."""
    whole = (
        {field.name for field in environment.outside.fields if field.size} if environment.outside else set()
    )
    return frozenset(row for row in rows_of_outside(environment) if row.name not in whole)
