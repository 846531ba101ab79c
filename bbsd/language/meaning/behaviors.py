"""What a behavior module means: its table's cells, where it is excited, and what its actions set."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import prod
from typing import TYPE_CHECKING

from bbsd.errors import did_you_mean
from bbsd.expression import elaboration
from bbsd.expression.forms import kind_by_form
from bbsd.expression.kinds import Kind
from bbsd.expression.mistakes import KEY, WHOLE
from bbsd.expression.tree import Name, Span
from bbsd.language.field_types import Expression
from bbsd.language.meaning.partitions import (
    MAX_CELLS,
    TRUTH_CELLS,
    Partition,
    elaborate_partition,
    is_partition,
)
from bbsd.language.meaning.tables.rules import table_of_rules
from bbsd.language.meaning.tables.symbols import table_of_text
from bbsd.language.models import When

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping

    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Path, Scope
    from bbsd.language.meaning.moments import Moment
    from bbsd.language.meaning.names import Names
    from bbsd.language.meaning.tables.table import Inputs, Table
    from bbsd.language.models import Behavior, PartitionText

MAX_ACTIONS = 200


@dataclass(frozen=True, slots=True)
class Module:
    """One behavior (1), for all robots.

    `inputs` are the cells of each input in the order of the table's dimensions, `cells[robot]` their indices,
    `excited[robot]` where it is excited, `actions[action][state][robot]` what an action sets.
    """

    name: str
    inputs: Inputs
    cells: tuple[tuple[Node, ...], ...]
    excited: tuple[Node, ...]
    actions: Mapping[str, Mapping[str, tuple[Node, ...]]]
    table: Table

    @property
    def n_cells(self) -> int:
        """The number of cells of the behavior's table."""
        return prod(len(cells) for cells in self.inputs.values())

    @property
    def nodes(self) -> list[Node]:
        """All that the decision depends on."""
        return [*(node for robot in self.cells for node in robot), *self.excited]

    def with_nodes(self, new: Callable[[Node], Node]) -> Module:
        """The same with another node for each of those."""
        return replace(
            self,
            cells=tuple(tuple(map(new, robot)) for robot in self.cells),
            excited=tuple(map(new, self.excited)),
        )


def elaborate_behavior(
    name: str, written: Behavior, decision: Moment, kinds: Mapping[str, Kind]
) -> Module | None:
    """The meaning of a behavior at the decision; None where its inputs could not be understood."""
    names, path, own = decision.names, ("behaviors", name), decision.behavior_scope(name)
    excited = tuple(_excited(written, own, (*path, "excited"), robot) for robot in names.robots)
    actions = {
        action: _action(sets, names, own, (*path, "actions", action), kinds)
        for action, sets in written.actions.items()
    }
    if not 0 < len(actions) <= MAX_ACTIONS and not (names.unusable and not actions):
        names.findings.tell((*path, "actions"), "BB038", f"a behavior has 1 to {MAX_ACTIONS} actions", KEY)
    per_robot = [_inputs(written, decision, own, (*path, "inputs"), robot) for robot in names.robots]
    inputs: Inputs = {key: found.cells for key, found in per_robot[0].items()}
    if prod(len(cells) for cells in inputs.values()) > MAX_CELLS:
        message, advice = f"this table would have more than {MAX_CELLS} cells", "cut the inputs more coarsely"
        names.findings.tell((*path, "inputs"), "BB039", message, KEY, advice)
        return None
    silent = {*names.unusable, *(set(written.inputs) - inputs.keys())}
    if isinstance(written.inputs, list) and names.findings.told_below((*path, "inputs")):
        silent |= _asked(written) - inputs.keys()
    given = _given(written, inputs, path, names, silent)
    if any(len(found) < len(written.inputs) for found in per_robot):
        return None
    cells = tuple(tuple(found.index for found in robot.values()) for robot in per_robot)
    return Module(name, inputs, cells, excited, actions, given)


def _asked(written: Behavior) -> set[str]:
    """What rules ask for; where a name in the list of inputs is wrong, it may be what was meant there."""
    return {name for rule in written.rules or () if isinstance(rule, When) for name in rule.when}


def _given(written: Behavior, inputs: Inputs, path: Path, names: Names, silent: Collection[str]) -> Table:
    """The cells that rules or a table give."""
    actions, findings = list(written.actions), names.findings
    if written.table is None:
        return table_of_rules(written.rules, inputs, actions, (*path, "rules"), findings, silent)
    if written.rules is not None:
        advice = "keep one of them; what a spec extends is taken away by rules: null or table: null"
        findings.tell((*path, "table"), "BB047", "this behavior has both rules and a table", KEY, advice)
    is_known = (
        len(inputs) == len(written.inputs)
        and not findings.told_below((*path, "inputs"))
        and names.unusable.keys().isdisjoint({*written.inputs, *actions})
    )
    return table_of_text(written.table, inputs, actions, (*path, "table"), findings, is_known=is_known)


def _excited(written: Behavior, own: Scope, path: Path, robot: int) -> Node:
    if written.excited is None:
        return own.graph.truth(value=True)
    return elaboration.truth(written.excited.tree, own.at(path, robot))


def _action(
    sets: Mapping[str, Expression], names: Names, own: Scope, path: Path, kinds: Mapping[str, Kind]
) -> dict[str, tuple[Node, ...]]:
    """What an action sets, for each robot; only the robot's own state can be set."""
    meant = {}
    for target, written in sets.items():
        here = (*path, target)
        if target not in names.spec.environment.state:
            if target not in names.unusable:
                message, advice = _not_state(target, names), "actions set a robot's own state"
                names.findings.tell(here, "BB033", message, KEY, advice)
            continue
        read = elaboration.truth if kinds[target] is Kind.TRUTH else elaboration.number
        values = tuple(read(written.tree, own.at(here, robot, draws=True)) for robot in names.robots)
        if target not in names.unusable:
            meant[target] = values
    return meant


def _not_state(target: str, names: Names) -> str:
    environment = names.spec.environment
    known: dict[str, Collection[str]] = {
        "a value of the world": environment.world,
        "a sensor": environment.sensors,
        "a constant": names.spec.constants,
        "a definition": names.definitions,
    }
    for what, those in known.items():
        if target in those:
            return f"{target} is {what}, and an action cannot set it"
    return f'"{target}" is not state{did_you_mean(target, environment.state)}'


def _not_listed(name: str, names: Names) -> tuple[str, Span, str]:
    """What is said of a name that inputs cannot list."""
    environment = names.spec.environment
    if name in names.definitions or name in names.spec.constants:
        what = "a definition" if name in names.definitions else "a constant"
        advice = "make a sensor of it, or write inputs as a mapping: a name, then the partition"
        return f"{name} is {what}; inputs lists sensors, and truths of the robot's state", WHOLE, advice
    known = [*environment.sensors, *environment.state]
    advice = "inputs lists sensors, and truths of the state; other partitions are a mapping: name, then what it cuts"
    return f'"{name}" is neither sensor nor state{did_you_mean(name, known)}', WHOLE, advice


def _inputs(written: Behavior, decision: Moment, own: Scope, path: Path, robot: int) -> dict[str, Partition]:
    """A robot's partitions by input, without those that could not be understood."""
    if isinstance(written.inputs, dict):
        found = {name: _own(cut, decision, own, (*path, name), robot) for name, cut in written.inputs.items()}
    else:
        found = {
            name: _shared(name, decision, own, (*path, place), robot)
            for place, name in enumerate(written.inputs)
        }
        for place, name in enumerate(written.inputs):
            if name in written.inputs[:place] and name not in decision.names.unusable:
                decision.names.findings.tell((*path, place), "BB040", f"{name} is listed twice")
    return {name: part for name, part in found.items() if part is not None}


def _own(cut: PartitionText, decision: Moment, own: Scope, path: Path, robot: int) -> Partition | None:
    """An input's own partition; the bare name of a sensor that is one stands for that."""
    sensors = decision.names.spec.environment.sensors
    if isinstance(cut, Expression) and isinstance(cut.tree, Name) and cut.tree.name in sensors:
        return _shared(cut.tree.name, decision, own, path, robot)
    return elaborate_partition(cut, own.at(path, robot), path, robot)


def _kind_by_form(written: PartitionText | None) -> Kind:
    """What a sensor is by its form alone, even where what it is made of could not be understood."""
    return kind_by_form(written.tree) if isinstance(written, Expression) else Kind.UNKNOWN


def _shared(name: str, decision: Moment, own: Scope, path: Path, robot: int) -> Partition | None:
    """The partition that a sensor is; a truth, sensed or in the robot's state, is one of two cells."""
    names, environment = decision.names, decision.names.spec.environment
    if name in names.unusable:
        return None
    if name in environment.sensors and is_partition(environment.sensors[name]):
        return decision.partition(name, robot)
    if not (name in environment.sensors or name in environment.state or name in environment.world):
        names.findings.tell(path, "BB041", *_not_listed(name, names))
        return None
    found = elaboration.value(Name(name, WHOLE), own.at(path, robot))
    if isinstance(found, tuple) or Kind.NUMBER in (found.kind, _kind_by_form(environment.sensors.get(name))):
        what = "a list" if isinstance(found, tuple) else "a number"
        advice = f"cut it: {name}: cut({name}, ...) or {name}: values({name}, first, last)"
        message = f"an input needs a partition, and {name} is {what}"
        names.findings.tell(path, "BB030", message, WHOLE, advice)
        return None
    return None if found.kind is Kind.UNKNOWN else Partition(TRUTH_CELLS, names.graph.apply("cell_of", found))
