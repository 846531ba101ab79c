"""How an episode starts: the values of world and state, each evaluated when another one needs it, and their forms."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from bbsd.expression.elaboration import elaboration
from bbsd.expression.elaboration.naming import one_reading
from bbsd.expression.kinds import Kind
from bbsd.expression.scope import Binding, Deferred, Path, PerRobot, Unusable, Value
from bbsd.expression.syntax.mistakes import WHOLE
from bbsd.language.meaning.forms import Form, form_of, regular
from bbsd.language.meaning.outside.exchange import names_outside, value_outside
from bbsd.language.meaning.partitions import is_partition
from bbsd.language.outside import EARNED

if TYPE_CHECKING:
    from bbsd.language.meaning.moments import Moment
    from bbsd.language.meaning.naming.names import Names, Stored


def starting_values(names: Names) -> Stored:
    """Return the starting values of world and state, each evaluated when another one or the episode needs it.

    What an environment in Python sets are its reset's observation, and 0 as what it rewards.
    """
    environment, graph = names.spec.environment, names.graph
    given = names_outside(environment)
    starts: dict[tuple[str, int], Value] = {}

    def start(name: str, robot: int) -> Value:
        if name == EARNED and name in given:
            return graph.number(0)
        if name in given:
            return value_outside(name, robot, graph)
        if (name, robot) not in starts:
            block, owner = ("world", names.team) if name in environment.world else ("state", robot)
            inner = scope.at(("environment", block, name), owner, draws=True)
            tree = getattr(environment, block)[name].tree
            value = one_reading(elaboration.value(tree, inner), tree.span, inner)
            starts[name, robot] = regular(value, tree.span, inner)
        return starts[name, robot]

    bindings: dict[str, Binding] = {
        name: Unusable("BB066", f"{name} is not known yet when values start") for name in environment.sensors
    }
    bindings |= {name: Deferred(partial(start, name, 0)) for name in environment.world}
    bindings |= {name: PerRobot(partial(start, name)) for name in (*environment.state, *given)}
    scope = names.scope(bindings, names.graph.number(0))
    robots = dict.fromkeys((*environment.state, *given), names.robots) | {
        name: range(1) for name in environment.world
    }
    return {
        name: tuple(graph.unknown if name in names.unusable else start(name, robot) for robot in robots[name])
        for name in (*environment.world, *environment.state, *given)
    }


def forms_of(stored: Stored) -> dict[str, Form]:
    """Return the form of each stored value; unknown where it could not be understood."""
    return {name: form_of(values[0]) or Form(Kind.UNKNOWN) for name, values in stored.items()}


def report_lengths_by_robot(first: Stored, beginning: Moment) -> None:
    """Report state and sensors that are lists of other lengths for other robots: all have the same slots."""
    names = beginning.names
    values: dict[Path, list[Value]] = {
        ("environment", "state", name): [*first[name]] for name in names.spec.environment.state
    }
    for name, sensor in names.spec.environment.sensors.items():
        if not is_partition(sensor) and name not in names.unusable:
            values["environment", "sensors", name] = [beginning.value(name, robot) for robot in names.robots]
    for path, of_robots in values.items():
        if len(set(map(_shape, of_robots))) > 1:
            message, advice = (
                "this list's length would differ from robot to robot",
                "let it be the same for all",
            )
            names.findings.report(path, "BB127", message, WHOLE, advice)


def _shape(value: Value) -> tuple[object, ...]:
    """Return the lengths of nested lists, () for a single value."""
    return tuple(map(_shape, value)) if isinstance(value, tuple) else ()
