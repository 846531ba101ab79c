"""What a behavior module means: its table's cells, where it is excited, and what its actions set."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import count
from math import prod
from typing import TYPE_CHECKING

from bbsd.errors import did_you_mean
from bbsd.expression.elaboration import elaboration
from bbsd.expression.forms import kind_by_form
from bbsd.expression.kinds import Kind
from bbsd.expression.scope import Named
from bbsd.expression.syntax.mistakes import KEY, WHOLE, Rewriting
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Call, Name, Span
from bbsd.language.field_types import Expression
from bbsd.language.meaning.outside.exchange import names_outside, size_of_field
from bbsd.language.meaning.partitions import (
    MAX_CELLS,
    TRUTH_CELLS,
    Partition,
    cells_of_names,
    cells_of_numbers,
    elaborate_partition,
    is_partition,
)
from bbsd.language.meaning.setting.assignments import assignments
from bbsd.language.meaning.tables.rules import table_of_rules
from bbsd.language.meaning.tables.symbols import table_of_text
from bbsd.language.models import When

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Variable
    from bbsd.expression.scope import Path, Scope
    from bbsd.language.meaning.forms import Form
    from bbsd.language.meaning.moments import Moment
    from bbsd.language.meaning.naming.names import Names
    from bbsd.language.meaning.tables.table import Inputs, Table
    from bbsd.language.models import Behavior, Environment, PartitionText

MAX_ACTIONS = 200
"""Actions of a behavior: a table's cell is a byte, and a table as text has a character for each action."""


@dataclass(frozen=True, slots=True)
class Module:
    """One behavior (1), for all robots.

    `inputs` names the cells of each input in the order of the table's dimensions, `cells[robot]` holds the index
    of the present cell of each, `excited[robot]` whether it is excited, `actions[action][variable][robot]` the value
    that a state or an element of one has after an action that may set it.
    """

    name: str
    inputs: Inputs
    cells: tuple[tuple[Node, ...], ...]
    excited: tuple[Node, ...]
    actions: Mapping[str, Mapping[Variable, tuple[Node, ...]]]
    table: Table

    @property
    def n_cells(self) -> int:
        """The number of cells of the behavior's table."""
        return prod(len(cells) for cells in self.inputs.values())

    @property
    def nodes(self) -> list[Node]:
        """The nodes that the decision depends on."""
        return [*(node for robot in self.cells for node in robot), *self.excited]

    def with_nodes(self, new: Callable[[Node], Node]) -> Module:
        """Return the same behavior with each of those nodes replaced."""
        return replace(
            self,
            cells=tuple(tuple(map(new, robot)) for robot in self.cells),
            excited=tuple(map(new, self.excited)),
        )


def elaborate_behavior(
    name: str, behavior: Behavior, decision: Moment, forms: Mapping[str, Form]
) -> Module | None:
    """Return what a behavior means at the decision; None where its inputs could not be understood."""
    names, path, scope = decision.names, ("behaviors", name), decision.behavior_scope(name)
    excited = tuple(_excited(behavior, scope, (*path, "excited"), robot) for robot in names.robots)
    actions = {
        action: assignments(sets, names, scope, (*path, "actions", action), forms)
        for action, sets in behavior.actions.items()
    }
    if not 0 < len(actions) <= MAX_ACTIONS and not (names.unusable and not actions):
        names.findings.report((*path, "actions"), "BB038", f"a behavior has 1 to {MAX_ACTIONS} actions", KEY)
    per_robot = [_inputs(behavior, decision, scope, (*path, "inputs"), robot) for robot in names.robots]
    inputs: Inputs = {key: partition.cells for key, partition in per_robot[0].items()}
    if prod(len(cells) for cells in inputs.values()) > MAX_CELLS:
        message, advice = f"this table would have more than {MAX_CELLS} cells", "cut the inputs more coarsely"
        names.findings.report((*path, "inputs"), "BB039", message, KEY, advice)
        return None
    unusable = {*names.unusable, *(set(behavior.inputs) - inputs.keys())}
    if isinstance(behavior.inputs, list) and names.findings.has_mistakes_below((*path, "inputs")):
        unusable |= (
            _inputs_in_rules(behavior) - inputs.keys()
        )  # one of them may be the name that was misspelled
    table = _given_table(behavior, inputs, path, names, unusable)
    if any(len(partitions) < len(behavior.inputs) for partitions in per_robot):
        return None
    cells = tuple(tuple(partition.index for partition in robot.values()) for robot in per_robot)
    return Module(name, inputs, cells, excited, actions, table)


def _inputs_in_rules(behavior: Behavior) -> set[str]:
    return {name for rule in behavior.rules or () if isinstance(rule, When) for name in rule.when}


def _given_table(
    behavior: Behavior, inputs: Inputs, path: Path, names: Names, unusable: Collection[str]
) -> Table:
    """Return the cells that rules or a table give; report no mistake in the use of names that are `unusable`."""
    actions, findings = list(behavior.actions), names.findings
    if behavior.table is None:
        return table_of_rules(
            behavior.rules, inputs, actions, (*path, "rules"), findings, unusable, names.spec
        )
    if behavior.rules is not None:
        advice = "keep one of them; what a spec extends is taken away by rules: null or table: null"
        findings.report((*path, "table"), "BB047", "this behavior has both rules and a table", KEY, advice)
    is_known = (
        len(inputs) == len(behavior.inputs)
        and not findings.has_mistakes_below((*path, "inputs"))
        and names.unusable.keys().isdisjoint({*behavior.inputs, *actions})
    )
    return table_of_text(behavior.table, inputs, actions, (*path, "table"), findings, is_known=is_known)


def _excited(behavior: Behavior, scope: Scope, path: Path, robot: int) -> Node:
    if behavior.excited is None:
        return scope.graph.truth(value=True)
    return elaboration.truth(behavior.excited.tree, scope.at(path, robot))


def _not_listed(name: str, names: Names) -> tuple[str, Span, str]:
    """Return message, span and advice for a name that inputs cannot list."""
    environment = names.spec.environment
    if name in names.definitions or name in names.spec.constants:
        kind = "a definition" if name in names.definitions else "a constant"
        advice = "make a sensor of it, or write inputs as a mapping: a name, then the partition"
        return f"{name} is {kind}; inputs lists sensors, and truths of the robot's state", WHOLE, advice
    candidates = [*environment.sensors, *environment.state, *names_outside(environment)]
    advice = "inputs lists sensors, and truths of the state; other partitions are a mapping: name, then what it cuts"
    return f'"{name}" is neither sensor nor state{did_you_mean(name, candidates)}', WHOLE, advice


def _inputs(
    behavior: Behavior, decision: Moment, scope: Scope, path: Path, robot: int
) -> dict[str, Partition]:
    """Return a robot's partitions by input, without those that could not be understood."""
    if isinstance(behavior.inputs, dict):
        partitions = {
            name: _own_partition(text, decision, scope, (*path, name), robot)
            for name, text in behavior.inputs.items()
        }
    else:
        partitions = {
            name: _shared_partition(name, decision, scope, (*path, index), robot)
            for index, name in enumerate(behavior.inputs)
        }
        for index, name in enumerate(behavior.inputs):
            if name in behavior.inputs[:index] and name not in decision.names.unusable:
                decision.names.findings.report((*path, index), "BB040", f"{name} is listed twice")
    return {name: partition for name, partition in partitions.items() if partition is not None}


def _own_partition(
    text: PartitionText, decision: Moment, scope: Scope, path: Path, robot: int
) -> Partition | None:
    """Return the partition that an input is written with; a sensor's bare name stands for the sensor's partition."""
    sensors = decision.names.spec.environment.sensors
    if isinstance(text, Expression) and isinstance(text.tree, Name) and text.tree.name in sensors:
        return _shared_partition(text.tree.name, decision, scope, path, robot)
    return elaborate_partition(text, scope.at(path, robot), path, robot)


def _kind_by_form(sensor: PartitionText | None, names: Names) -> Kind:
    """Return a sensor's kind by its form alone, even where the values in it could not be understood."""
    return kind_by_form(sensor.tree, names.definitions) if isinstance(sensor, Expression) else Kind.UNKNOWN


def _without_cells(
    name: str, environment: Environment, *, is_list: bool
) -> tuple[str, Span, str, Rewriting | None]:
    """Return what is said of an input that is a number or a list; the sensor that cuts it already is what to write."""
    what, cut = ("a list", f"{name}[0]") if is_list else ("a number", name)
    message = f"an input has cells, and {name} is {what} without any"
    for sensor, partition in environment.sensors.items():
        tree = None if isinstance(partition, dict) else partition.tree
        if (
            isinstance(tree, Call)
            and tree.function in ("cut", "values")
            and render(tree.arguments[0]) == name
        ):
            return message, WHOLE, f"{sensor} is {name} cut into cells", Rewriting(sensor, is_certain=False)
    taken = {*environment.sensors, *environment.state, *environment.world, *environment.definitions}
    new = next(word for n in count(1) if (word := f"{name}_zone{n if n > 1 else ''}") not in taken)
    advice = (
        f"add a sensor under another name, {new}: cut({cut}, ...) or {new}: values({cut}, first, last), "
        f"and write {new} here"
    )
    return message, WHOLE, advice, None


def _shared_partition(name: str, decision: Moment, scope: Scope, path: Path, robot: int) -> Partition | None:
    """Return the partition that a sensor is; a truth, sensed or in the robot's state, is one of two cells.

    What an environment in Python shows with a size has a cell for each of its values.
    """
    names, environment = decision.names, decision.names.spec.environment
    if name in names.unusable:
        return None
    if size := size_of_field(environment, name):
        number = elaboration.number(Name(name, WHOLE), scope.at(path, robot))
        return None if number.kind is Kind.UNKNOWN else cells_of_numbers(number, 0, size - 1, names.graph)
    if name in environment.sensors and is_partition(environment.sensors[name]):
        return decision.partition(name, robot)
    if not (
        name in environment.sensors
        or name in environment.state
        or name in environment.world
        or name in names_outside(environment)
    ):
        names.findings.report(path, "BB041", *_not_listed(name, names))
        return None
    value = elaboration.value(Name(name, WHOLE), scope.at(path, robot))
    if isinstance(value, Named):
        return cells_of_names(value, names.graph)
    if isinstance(value, tuple) or Kind.NUMBER in (
        value.kind,
        _kind_by_form(environment.sensors.get(name), names),
    ):
        names.findings.report(
            path, "BB030", *_without_cells(name, environment, is_list=isinstance(value, tuple))
        )
        return None
    return None if value.kind is Kind.UNKNOWN else Partition(TRUTH_CELLS, names.graph.apply("cell_of", value))
