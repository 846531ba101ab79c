"""What happens in an episode: the start, and one step from decision to end, as one graph.

The phases are those of the language's definition: decide and act from one snapshot, dynamics from the values
after the actions with the sensors of the snapshot, then new sensors, reward and end. Since every value is a
node, what a phase reads is just which nodes its names stand for.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING

from bbsd.errors import did_you_mean
from bbsd.expression.elaboration import elaboration
from bbsd.expression.elaboration.naming import one_reading, report_unknown_values
from bbsd.expression.graph import Level, Node
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.scope import Binding, Deferred, Path, PerRobot, Scope, Unusable, Value
from bbsd.expression.syntax.mistakes import KEY, WHOLE
from bbsd.language.meaning.behaviors import Module, elaborate_behavior
from bbsd.language.meaning.episode.perceiving import Perceived, SensorFault, decision_perceived
from bbsd.language.meaning.episode.picture import Picture, elaborate_picture
from bbsd.language.meaning.forms import Form, fitted, form_of, regular
from bbsd.language.meaning.moments import Moment, Sensed
from bbsd.language.meaning.naming.names import Names, Stored, names_in, read_slots, refilled, scalars_by_slot
from bbsd.language.meaning.outside.checking import report_sent
from bbsd.language.meaning.outside.exchange import (
    ONLY_OUTSIDE,
    fractions_outside,
    has_ended,
    names_outside,
    rows_of_outside,
    rows_of_sent,
    value_outside,
    what_sets,
)
from bbsd.language.meaning.partitions import MAX_CELLS_IN_ALL, Partition, is_partition
from bbsd.language.outside import EARNED

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Mapping

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
    outside: tuple[Slot, ...] = ()
    """What an environment in Python gives at the start and at each step; none where the world is the spec's own."""
    sent: tuple[Slot, ...] = ()
    """What it is told at each step: the values that these slots have in `acted`."""
    fractions: frozenset[Slot] = frozenset()
    """What of `outside` need not be a whole number."""
    named: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """For world, state, sensors and definitions that are one of several names, these names; a value is their index."""

    def labels(self, name: str) -> Labels:
        """Return what the numbers 0, 1, ... of a value mean: cells, or names; nothing for other values."""
        return self.partitions.get(name) or self.named.get(name, ())

    @property
    def nodes(self) -> list[Node]:
        """The nodes of the start and of a step, without the values that actions assign, which `acted` contains."""
        nodes = [*self.start.values(), *self.acted.values(), *self.after.values(), *self.definitions.values()]
        nodes += [node for module in self.modules for node in module.nodes]
        for robots in (self.choices, *self.reward.values(), *self.expects.values()):
            nodes += robots
        return nodes if self.ends is None else [*nodes, self.ends]

    def with_nodes(self, new: Callable[[Node], Node]) -> Episode:
        """Return the same episode with every node of its step replaced, but for the values that actions assign."""
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


def elaborate_episode(names: Names, fault: SensorFault | None = None) -> Episode | None:
    """Return what happens in an episode of a spec; None where a behavior could not be understood.

    The order of evaluation numbers the nodes, and with that fixes the kernel's text. With the fault of a sensor
    behaviors perceive something else than what is true, which is stored beside it.
    """
    first = starting_values(names)
    beginning = Moment(names, first, names.graph.number(0), starting=True)

    _report_lengths_by_robot(first, beginning)
    now = slots_read(first, names)
    decision = decision_at(now, beginning, names)
    forms = forms_of(first)
    report_sent(names.spec.environment.outside, forms, names.findings)
    felt = None if fault is None else Perceived(names, first, names.graph.number(0), fault, starting=True)
    perceived = decision if felt is None else decision_perceived(now, felt, names)
    modules = tuple(modules_at(names, perceived, forms))
    if sum(len(module.actions) for module in modules) > MAX_ACTIONS_IN_ALL:
        message = f"more than {MAX_ACTIONS_IN_ALL} actions in all"
        names.findings.report(("behaviors",), "BB038", message, KEY)
    choices = tuple(names.graph.leaf("choice", robot, Kind.CELL, Level.LANE) for robot in names.robots)

    acted = _act(now, modules, choices, names)
    acting = Moment(names, acted, names.step, sensed=decision.sensed, before=decision.scope)
    then = _apply_dynamics(acted, acting.scope, forms, names)

    outcome = Moment(names, then, names.step, before=decision.scope)
    defined = definitions_at(outcome)
    episode = Episode(
        modules,
        start=_slots_of_state(first, names) | _slots_of_sensors(beginning),
        acted=_slots_of_state(acted, names),
        after=_slots_of_state(then, names) | _slots_of_sensors(outcome),
        definitions=scalars_defined(defined),
        choices=choices,
        reward=_reward(outcome),
        ends=_ends(outcome),
        partitions={
            name: partition.cells
            for (name, robot), partition in beginning.sensed.partitions.items()
            if partition and not robot
        },
        expects=_expects(outcome, decision),
        picture=_picture(first, beginning, names),
        outside=rows_of_outside(names.spec.environment),
        sent=rows_of_sent(names.spec.environment),
        fractions=fractions_outside(names.spec.environment),
        named=_named(first, beginning.sensed.values, defined),
    )
    if felt is not None and fault is not None:
        after = Perceived(names, then, names.step, fault, before=perceived.scope).slots()
        episode = replace(episode, start={**episode.start, **felt.slots()}, after={**episode.after, **after})
    return episode if len(modules) == len(names.spec.behaviors) else None


def forms_of(stored: Stored) -> dict[str, Form]:
    """Return the form of each stored value; unknown where it could not be understood."""
    return {name: form_of(values[0]) or Form(Kind.UNKNOWN) for name, values in stored.items()}


def modules_at(names: Names, decision: Moment, forms: Mapping[str, Form]) -> Iterator[Module]:
    """Yield the behaviors that could be understood, up to the one that makes all tables together too large."""
    n_cells = 0
    for name, behavior in names.spec.behaviors.items():
        module = elaborate_behavior(name, behavior, decision, forms)
        if module is not None:
            yield module
        n_cells += module.n_cells if module else 0
        if n_cells > MAX_CELLS_IN_ALL:
            message = f"from here on, all tables together have more than {MAX_CELLS_IN_ALL:,} cells"
            names.findings.report(("behaviors", name, "inputs"), "BB039", message, KEY)
            return


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


def stored_sensors(beginning: Moment, sensors: Collection[str]) -> Sensed:
    """Return the leaves that read sensors from where the step before, or the start, stored them."""
    names, sensed = beginning.names, Sensed()
    for name, sensor in names.spec.environment.sensors.items():
        for robot in names.robots if name in sensors and name not in names.unusable else ():
            if is_partition(sensor):
                partition = beginning.partition(name, robot)
                slot = names.graph.leaf("slot", Slot(name, robot), Kind.CELL, Level.LANE)
                sensed.partitions[name, robot] = partition and Partition(partition.cells, slot)
            else:
                value = beginning.value(name, robot)
                sensed.values[name, robot] = read_slots(name, robot, value, names.graph)
    return sensed


def _act(now: Stored, modules: tuple[Module, ...], choices: tuple[Node, ...], names: Names) -> Stored:
    """Return state after the controlling actions' assignments; what is not set stays."""
    graph, acted = names.graph, _slots_of_state(now, names)
    every_action = [sets for module in modules for sets in module.actions.values()]
    for action, sets in enumerate(every_action, start=1):
        for (name, place), values in sets.items():
            for robot, value in enumerate(values):
                slot, controls = (
                    Slot(name, robot, place),
                    graph.apply("==", choices[robot], graph.cell(action)),
                )
                acted[slot] = graph.apply("select", controls, value, acted[slot])
    nodes = iter(acted.values())
    return {name: tuple(refilled(value, nodes) for value in values) for name, values in now.items()}


def _apply_dynamics(acted: Stored, scope: Scope, forms: Mapping[str, Form], names: Names) -> Stored:
    """Return the next state and world, all at once, from the values after the actions and the snapshot's sensors."""
    environment = names.spec.environment
    given = names_outside(environment)
    then = dict(acted)
    for name in given:
        then[name] = tuple(value_outside(name, robot, names.graph) for robot in names.robots)
    for name, expression in environment.dynamics.items():
        path: Path = ("environment", "dynamics", name)
        if name in given:
            message, advice = f"{what_sets(name)}, which has no dynamics", ONLY_OUTSIDE
            names.findings.report(path, "BB107", message, KEY, advice)
        elif name in acted:
            robots = [names.team] if name in environment.world else names.robots
            then[name] = tuple(
                _evaluate_as(forms[name], name, expression, scope.at(path, robot, draws=True))
                for robot in robots
            )
        elif name not in names.unusable:
            hint = did_you_mean(name, acted)
            message = f"{name} is neither world nor state, so it has no dynamics{hint}"
            names.findings.report(path, "BB033", message, KEY)
    return then


def _evaluate_as(form: Form, name: str, expression: Expression, scope: Scope) -> Value:
    if form.names:
        report_unknown_values(expression.tree, name, form.names, scope)
    value = elaboration.value(expression.tree, scope)
    return fitted(value, form, name, expression.tree.span, scope)


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


def _named(
    first: Stored, sensed: Mapping[tuple[str, int], Value], defined: Mapping[tuple[str, int], Value]
) -> dict[str, tuple[str, ...]]:
    """Return the names of all values that have some, by what has them."""
    values = {name: of_robots[0] for name, of_robots in first.items()}
    values |= {name: value for (name, robot), value in (*sensed.items(), *defined.items()) if not robot}
    return {name: names for name, value in values.items() if (names := names_in(value))}


def _reward(outcome: Moment) -> dict[str, tuple[Node, ...]]:
    return {
        term: tuple(
            elaboration.number(expression.tree, outcome.scope.at(("reward", term), robot))
            for robot in outcome.names.robots
        )
        for term, expression in outcome.names.spec.reward.items()
    }


def _ends(outcome: Moment) -> Node | None:
    names = outcome.names
    environment = names.spec.environment
    conditions = [has_ended(names.graph)] if environment.outside else []
    if environment.ends is not None:
        scope = outcome.scope.at(("environment", "ends"), names.team)
        conditions.insert(0, elaboration.truth(environment.ends.tree, scope))
    return names.graph.fold("|", conditions) if conditions else None


def _expects(outcome: Moment, decision: Moment) -> dict[str, tuple[Node, ...]]:
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


def _picture(first: Stored, beginning: Moment, names: Names) -> Picture | None:
    """Return what is drawn, in a fork of the graph: a view changes nothing of what is computed."""
    if names.spec.view is None:
        return None
    forked = replace(names, graph=names.graph.fork())
    return elaborate_picture(names.spec.view, decision_at(slots_read(first, forked), beginning, forked))


def _slots_of_state(stored: Stored, names: Names) -> dict[Slot, Node]:
    world = names.spec.environment.world
    return {
        slot: node
        for name, values in stored.items()
        for robot, value in enumerate(values)
        for slot, node in scalars_by_slot(value, name, None if name in world else robot).items()
    }


def _report_lengths_by_robot(first: Stored, beginning: Moment) -> None:
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


def _slots_of_sensors(moment: Moment) -> dict[Slot, Node]:
    names = moment.names
    nodes: dict[Slot, Node] = {}
    for name, sensor in names.spec.environment.sensors.items():
        for robot in names.robots if name not in names.unusable else ():
            if is_partition(sensor):
                partition = moment.partition(name, robot)
                nodes |= {} if partition is None else {Slot(name, robot): partition.index}
            else:
                nodes |= scalars_by_slot(moment.value(name, robot), name, robot)
    return nodes
