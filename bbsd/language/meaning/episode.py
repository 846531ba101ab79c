"""What happens in an episode: the start, and one step from decision to end, as one graph.

The phases are those of the language's definition: decide and act from one snapshot, dynamics from the values
after the actions with the sensors of the snapshot, then new sensors, reward and end. Since every value is a
node, what a phase reads is just which nodes its names stand for.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from bbsd.errors import did_you_mean
from bbsd.expression import elaboration
from bbsd.expression.graph import Level, Node
from bbsd.expression.kinds import Kind
from bbsd.expression.mistakes import KEY
from bbsd.expression.scope import Binding, Deferred, Path, PerRobot, Scope, Unusable
from bbsd.language.meaning.behaviors import Module, elaborate_behavior
from bbsd.language.meaning.names import Moment, Names, Slot, Stored, alone, flat, moment, slot, slots_of
from bbsd.language.meaning.partitions import MAX_CELLS_IN_ALL, Partition, is_partition
from bbsd.language.meaning.picture import Picture, elaborate_picture

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from bbsd.language.field_types import Expression
    from bbsd.language.meaning.tables.labels import Labels


MAX_ACTIONS_IN_ALL = 50_000
"""An action's number, counted over all behaviors, has 16 bits in a kernel."""


@dataclass(frozen=True, slots=True)
class Episode:
    """All that a rollout computes, as nodes.

    `start` and `after` give every slot its first and its next value, `acted` state after the actions;
    `choices[robot]` is the leaf that stands for the controlling action's number (0: nobody's, else counted
    over all behaviors in order); `reward[term][robot]`; `definitions` as they are after the step;
    `expects[behavior][robot]` what should hold after a step in which it controls, where it expects anything.
    """

    modules: tuple[Module, ...]
    start: Mapping[Slot, Node]
    acted: Mapping[Slot, Node]
    after: Mapping[Slot, Node]
    definitions: Mapping[Slot, Node]
    choices: tuple[Node, ...]
    reward: Mapping[str, tuple[Node, ...]]
    ends: Node | None
    partitions: Mapping[str, Labels]
    """The cells of each sensor that is a partition."""
    expects: Mapping[str, tuple[Node, ...]]
    picture: Picture | None
    """What a view shows, in a graph of its own."""

    @property
    def nodes(self) -> list[Node]:
        """All that is said of the start and of a step, but for what actions set before it is put together."""
        found = [*self.start.values(), *self.acted.values(), *self.after.values(), *self.definitions.values()]
        found += [node for module in self.modules for node in module.nodes]
        for nodes in (self.choices, *self.reward.values(), *self.expects.values()):
            found += nodes
        return found if self.ends is None else [*found, self.ends]

    def with_nodes(self, new: Callable[[Node], Node]) -> Episode:
        """The same with another node for each of a step; what actions set stands in the acted state already."""
        return replace(
            self,
            modules=tuple(module.with_nodes(new) for module in self.modules),
            acted={slot: new(node) for slot, node in self.acted.items()},
            after={slot: new(node) for slot, node in self.after.items()},
            definitions={slot: new(node) for slot, node in self.definitions.items()},
            reward={term: tuple(map(new, nodes)) for term, nodes in self.reward.items()},
            ends=None if self.ends is None else new(self.ends),
            expects={name: tuple(map(new, nodes)) for name, nodes in self.expects.items()},
        )


def elaborate_episode(names: Names) -> Episode | None:
    """Elaborate a whole spec; None where its behaviors could not be understood."""
    first = _start(names)
    beginning = moment(names, first, names.graph.number(0))
    beginning.scope = replace(beginning.scope, starting=True)

    now = _slots(first, names)
    decision = _decision(now, beginning, names)
    kinds = {name: values[0].kind for name, values in first.items()}
    modules = tuple(_modules(names, decision, kinds))
    if sum(len(each.actions) for each in modules) > MAX_ACTIONS_IN_ALL:
        message = f"more than {MAX_ACTIONS_IN_ALL} actions in all"
        names.findings.tell(("behaviors",), "BB038", message, KEY)
    choices = tuple(names.graph.leaf("choice", robot, Kind.CELL, Level.LANE) for robot in names.robots)

    acted = _acted(now, modules, choices, names)
    acting = moment(names, acted, names.step, sensors=decision)
    then = _dynamics(acted, _after(acting.scope, decision), kinds, names)

    outcome = moment(names, then, names.step)
    outcome.scope = _after(outcome.scope, decision)
    meant = Episode(
        modules,
        start=_slots_of_state(first, names) | _slots_of_sensors(beginning),
        acted=_slots_of_state(acted, names),
        after=_slots_of_state(then, names) | _slots_of_sensors(outcome),
        definitions=_definitions(outcome),
        choices=choices,
        reward=_reward(outcome),
        ends=_ends(outcome),
        partitions={
            name: found.cells for (name, robot), found in beginning.partitions.items() if found and not robot
        },
        expects=_expects(outcome, decision),
        picture=_picture(first, beginning, names),
    )
    return meant if len(modules) == len(names.spec.behaviors) else None


def _after(scope: Scope, decision: Moment) -> Scope:
    """A scope in which `before(e)` is e as it was for the decision."""
    return replace(scope, before=decision.scope)


def _modules(names: Names, decision: Moment, kinds: Mapping[str, Kind]) -> Iterator[Module]:
    """The behaviors that could be understood, up to the one with which their tables are too large together."""
    n_cells = 0
    for name, written in names.spec.behaviors.items():
        found = elaborate_behavior(name, written, decision, kinds)
        if found is not None:
            yield found
        n_cells += found.n_cells if found else 0
        if n_cells > MAX_CELLS_IN_ALL:
            message = f"from here on, all tables together have more than {MAX_CELLS_IN_ALL:,} cells"
            names.findings.tell(("behaviors", name, "inputs"), "BB039", message, KEY)
            return


def _start(names: Names) -> Stored:
    """Starting values of world and state, each made when another one or the episode needs it."""
    environment = names.spec.environment
    made: dict[tuple[str, int], Node] = {}

    def start(name: str, robot: int) -> Node:
        if (name, robot) not in made:
            block, who = ("world", names.team) if name in environment.world else ("state", robot)
            here = scope.at(("environment", block, name), who, draws=True)
            made[name, robot] = elaboration.scalar(getattr(environment, block)[name].tree, here)
        return made[name, robot]

    bindings: dict[str, Binding] = {
        name: Unusable("BB066", f"{name} is not known yet when values start") for name in environment.sensors
    }
    bindings |= {name: Deferred(partial(start, name, 0)) for name in environment.world}
    bindings |= {name: PerRobot(partial(start, name)) for name in environment.state}
    scope = names.scope(bindings, names.graph.number(0))
    robots = dict.fromkeys(environment.state, names.robots) | {name: range(1) for name in environment.world}
    return {
        name: tuple(
            names.graph.unknown if name in names.unusable else start(name, robot) for robot in robots[name]
        )
        for name in (*environment.world, *environment.state)
    }


def _slots(stored: Stored, names: Names) -> Stored:
    world = names.spec.environment.world
    return {
        name: tuple(
            slot((name, None if name in world else robot, ()), value, names.graph)
            for robot, value in enumerate(values)
        )
        for name, values in stored.items()
    }


def _decision(now: Stored, beginning: Moment, names: Names) -> Moment:
    """The snapshot: state and sensors are read from where the step before, or the start, stored them."""
    decision = moment(names, now, names.step)
    for name, written in names.spec.environment.sensors.items():
        for robot in names.robots if name not in names.unusable else ():
            if is_partition(written):
                cells = beginning.partition(name, robot)
                slot = names.graph.leaf("slot", (name, robot, ()), Kind.CELL, Level.LANE)
                decision.partitions[name, robot] = None if cells is None else Partition(cells.cells, slot)
            else:
                decision.values[name, robot] = slots_of(
                    name, robot, beginning.value(name, robot), names.graph
                )
    return decision


def _acted(now: Stored, modules: tuple[Module, ...], choices: tuple[Node, ...], names: Names) -> Stored:
    """State after the controlling actions' assignments; what is not set stays."""
    graph = names.graph
    acted = {name: list(values) for name, values in now.items()}
    every_action = [sets for behavior in modules for sets in behavior.actions.values()]
    for action, sets in enumerate(every_action, start=1):
        for target, values in sets.items():
            for robot, value in enumerate(values):
                controls = graph.apply("==", choices[robot], graph.cell(action))
                acted[target][robot] = graph.apply("select", controls, value, acted[target][robot])
    return {name: tuple(values) for name, values in acted.items()}


def _dynamics(acted: Stored, scope: Scope, kinds: Mapping[str, Kind], names: Names) -> Stored:
    """The next state and world, all at once, from what the actions left and the sensors of the snapshot."""
    environment = names.spec.environment
    then = dict(acted)
    for name, written in environment.dynamics.items():
        path: Path = ("environment", "dynamics", name)
        if name in acted:
            robots = [names.team] if name in environment.world else names.robots
            then[name] = tuple(
                _as(kinds[name], written, scope.at(path, robot, draws=True)) for robot in robots
            )
        elif name not in names.unusable:
            hint = did_you_mean(name, acted)
            message = f"{name} is neither world nor state, so it has no dynamics{hint}"
            names.findings.tell(path, "BB033", message, KEY)
    return then


def _as(kind: Kind, written: Expression, scope: Scope) -> Node:
    if kind is Kind.UNKNOWN:
        return elaboration.scalar(written.tree, scope)
    return (elaboration.truth if kind is Kind.TRUTH else elaboration.number)(written.tree, scope)


def _definitions(outcome: Moment) -> dict[Slot, Node]:
    """Definitions without parameters, robot by robot; the others are only looked through for mistakes."""
    names = outcome.names
    found: dict[Slot, Node] = {}
    for name, definition in names.definitions.items():
        for robot in names.robots:
            unknown = dict.fromkeys(definition.parameters, names.graph.unknown)
            here = replace(outcome.scope.at(definition.path, robot), local=unknown)
            value = elaboration.value(definition.expression, here)
            found |= {} if definition.parameters else flat(value, name, robot)
    return found


def _reward(outcome: Moment) -> dict[str, tuple[Node, ...]]:
    return {
        term: tuple(
            elaboration.number(written.tree, outcome.scope.at(("reward", term), robot))
            for robot in outcome.names.robots
        )
        for term, written in outcome.names.spec.reward.items()
    }


def _ends(outcome: Moment) -> Node | None:
    written = outcome.names.spec.environment.ends
    path = ("environment", "ends")
    return (
        None
        if written is None
        else elaboration.truth(written.tree, outcome.scope.at(path, outcome.names.team))
    )


def _expects(outcome: Moment, decision: Moment) -> dict[str, tuple[Node, ...]]:
    """What behaviors expect: after the step, of what they may know, `before(e)` as it was for the decision.

    Elaborated last, so that the numbers of all other nodes, and with them the solver's kernel, are the same without.
    """
    names = outcome.names
    found: dict[str, tuple[Node, ...]] = {}
    for name, written in names.spec.behaviors.items():
        if written.expects is not None:
            scope = replace(alone(outcome, name), before=alone(decision, name))
            path = ("behaviors", name, "expects")
            found[name] = tuple(
                elaboration.truth(written.expects.tree, scope.at(path, robot)) for robot in names.robots
            )
    return found


def _picture(first: Stored, beginning: Moment, names: Names) -> Picture | None:
    """What is drawn, in a fork of the graph: a view changes nothing of what is computed."""
    if names.spec.view is None:
        return None
    aside = replace(names, graph=names.graph.fork())
    return elaborate_picture(names.spec.view, _decision(_slots(first, aside), beginning, aside))


def _slots_of_state(stored: Stored, names: Names) -> dict[Slot, Node]:
    world = names.spec.environment.world
    return {
        (name, None if name in world else robot, ()): value
        for name, values in stored.items()
        for robot, value in enumerate(values)
    }


def _slots_of_sensors(sensed: Moment) -> dict[Slot, Node]:
    names = sensed.names
    found: dict[Slot, Node] = {}
    for name, written in names.spec.environment.sensors.items():
        for robot in names.robots if name not in names.unusable else ():
            if is_partition(written):
                cells = sensed.partition(name, robot)
                found |= {} if cells is None else {(name, robot, ()): cells.index}
            else:
                found |= flat(sensed.value(name, robot), name, robot)
    return found
