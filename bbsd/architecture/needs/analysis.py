"""Which values a robot must be given at each step, which it keeps itself, and how its decision follows from both."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.architecture.needs.naming import BEFORE, acted, now, plain_name
from bbsd.architecture.needs.needs import Given, Needs, NotMeasured, NotRemembered, RobotNeeds
from bbsd.architecture.needs.sensors import Sensors, sensors_of
from bbsd.architecture.policy import joint_space
from bbsd.errors import did_you_mean
from bbsd.expression.graph import Level, Node, needed
from bbsd.expression.node_data import Slot

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

    from bbsd.architecture.controller import Controller, Layer
    from bbsd.language.meaning import Meaning

FROM_OUTSIDE = frozenset({"slot", "step", "draw", "outside", "choice"})
"""Leaves that are no constants."""


def needs_of(
    meaning: Meaning,
    controller: Controller,
    *,
    raw: bool = True,
    measured: Collection[str] = (),
    remembered: Collection[str] = (),
    definitions: bool = False,
) -> Needs:
    """Return what a robot with this design needs.

    Sensors that draw, and those `measured`, are given. All others are computed from state and world if `raw`; else
    sensors that look at the world or at other robots are given, too. State that actions set is the robot's memory where
    it starts with a known value and changes only by what the robot knows; so is what is `remembered`, but nothing that
    is `measured`. All other state is given, unless it never changes. With `definitions` these are named, too.

    Raises:
        NotMeasured, NotRemembered: a name is of nothing that can be measured or remembered.
    """
    _require_measurable(meaning, measured)

    def is_given(name: str, nodes: Mapping[Slot, Node]) -> bool:
        return name in measured or any(
            leaf.operation == "draw" or (not raw and leaf.operation == "slot" and _is_far(leaf.slot, slot))
            for slot, node in nodes.items()
            for leaf in needed([node])
        )

    sensors = sensors_of(meaning, is_given, definitions=definitions)
    return _Analysis(meaning, controller, sensors, measured, remembered).needs()


def _is_far(read: Slot, reader: Slot) -> bool:
    """Return whether what is read is of the world or of another robot."""
    return read.robot is None or read.robot != reader.robot


def _require_measurable(meaning: Meaning, measured: Collection[str]) -> None:
    environment = meaning.spec.environment
    known = [*environment.sensors, *environment.state]
    for name in measured:
        if name not in known:
            raise NotMeasured(f'"{name}" is neither sensor nor state{did_you_mean(name, known)}')


class _Analysis:
    """The steps of `needs_of`, on one spec."""

    def __init__(
        self,
        meaning: Meaning,
        controller: Controller,
        sensors: Sensors,
        measured: Collection[str],
        remembered: Collection[str],
    ) -> None:
        self.meaning, self.controller, self.sensors = meaning, controller, sensors
        self.episode, self.environment = meaning.episode, meaning.spec.environment
        self.team = range(self.environment.robots)
        self.slots = _slots_by_name(self.episode.start)
        self.actions = _actions_in_tables(controller)
        self.targets = self._targets()
        self.after_actions = self._acted_leaves()
        self.fixed = frozenset(name for name in self.environment.state if self._is_fixed(name, measured))
        self.known: dict[int, Node] = {}
        self.memory = self._memory(measured, remembered)

    def needs(self) -> Needs:
        """Return what is needed; what other robots must tell is no memory, so the search may begin again."""
        while True:
            robots = tuple(map(self._robot, self.team))
            given = self._given(robots)
            told = {each.name for each in given if each.of_team} & set(self.memory)
            if not told:
                memory = tuple(name for name in self.environment.state if name in self.memory)
                named = {slot: self._known(node) for slot, node in self._named()}
                return Needs(self.sensors.graph, given, memory, robots, named)
            self.memory -= told

    def _named(self) -> list[tuple[Slot, Node]]:
        sensed = [*self.sensors.nodes.items(), *self.sensors.definitions.items()]
        return [(slot, node) for slot, node in sensed if slot.name not in self.sensors.given]

    # --- Which state is what

    def _targets(self) -> dict[str, None]:
        """Return the state variables that the design's actions set, in their order in the spec."""
        every = [sets for module in self.episode.modules for sets in module.actions.values()]
        used = {name for number in self.actions for name, _ in every[number - 1]}
        return {name: None for name in self.environment.state if name in used}

    def _has_known_start(self, name: str) -> bool:
        starts = [self.episode.start[slot] for robot in self.team for slot in self._own_slots(name, robot)]
        return not any(node.operation in FROM_OUTSIDE for node in needed(starts))

    def _is_fixed(self, name: str, measured: Collection[str]) -> bool:
        """Return whether state has its start at every decision: it never changes, or each step sets it back."""
        if name in measured or not self._has_known_start(name):
            return False
        slots = [slot for robot in self.team for slot in self._own_slots(name, robot)]
        if name not in self.targets and name not in self.environment.dynamics:
            return True
        return all(self._after(slot) is self.episode.start[slot] for slot in slots)

    def _memory(self, measured: Collection[str], remembered: Collection[str]) -> set[str]:
        for name in remembered:
            if name not in self.environment.state or not self._can_remember(name):
                state = did_you_mean(name, self.environment.state)
                unknown = "" if name in self.environment.state else f", which is no state{state}"
                raise NotRemembered(f"the robot cannot remember {name}{unknown}")
        known = {name for name in self.targets if name not in measured and self._can_remember(name)}
        return (known | set(remembered)) - self.fixed

    def _can_remember(self, name: str) -> bool:
        return self._has_known_start(name) and all(self._is_known(name, robot) for robot in self.team)

    def _is_known(self, name: str, robot: int) -> bool:
        """Return whether a robot knows all from which the next value follows once its actions are done."""
        leaves = needed(map(self._after, self._own_slots(name, robot)))
        return not any(
            leaf.operation == "draw" or (leaf.operation == "slot" and leaf.slot.robot != robot)
            for leaf in leaves
        )

    def _own_slots(self, name: str, robot: int) -> list[Slot]:
        """Return the slots of a robot's state: one, or one for each element of a list."""
        return [slot._replace(robot=robot) for slot in self.slots[name]]

    # --- Nodes

    def _after(self, slot: Slot) -> Node:
        """Return the next value of state, in which state that actions set is read after they did."""
        return self._replaced(self.episode.after[slot], self.after_actions, lambda leaf: leaf)

    def _known(self, node: Node) -> Node:
        """Return a node that reads only what is given or kept: sensors are computed, what never changes is constant."""
        return self._replaced(node, self.known, self._known_leaf)

    def _known_leaf(self, leaf: Node) -> Node:
        if leaf.operation != "slot":
            return leaf
        if plain_name(leaf.slot.name) in self.fixed:
            return self.episode.start[now(leaf.slot)]
        sensed = self.sensors.nodes.get(leaf.slot, leaf)
        return leaf if sensed is leaf else self._known(sensed)

    def _replaced(self, output: Node, done: dict[int, Node], leaf: Callable[[Node], Node]) -> Node:
        """Return a node with its leaves replaced; `done` has what was replaced before, by number, and gets more."""
        for node in _below(output, done):
            if node.operands:
                operands = [done[operand.number] for operand in node.operands]
                done[node.number] = self.sensors.graph.copy(node, operands)
            else:
                done[node.number] = node if node.literal else leaf(node)
        return done[output.number]

    def _acted_leaves(self) -> dict[int, Node]:
        """Return by the number of each state variable's node after the actions what reads it from then on."""
        graph = self.sensors.graph
        return {
            node.number: graph.leaf(
                "slot", acted(slot) if slot.name in self.targets else slot, node.kind, node.level
            )
            for slot, node in self.episode.acted.items()
            if node.operation != "slot"
        }

    # --- A robot's decision

    def _robot(self, robot: int) -> RobotNeeds:
        nodes = joint_space(self.meaning).nodes
        every = [sets for module in self.episode.modules for sets in module.actions.values()]
        axes = {axis: None for layer in self.controller.layers for axis in _axes(layer)}
        needs = RobotNeeds(
            {axis: self._known(nodes[axis][robot]) for axis in sorted(axes)},
            {
                number: {
                    variable: self._known(values[robot]) for variable, values in every[number - 1].items()
                }
                for number in self.actions
            },
            {
                slot.variable: self._known(self._leaf(slot))
                for name in self.targets
                for slot in self._own_slots(name, robot)
            },
            {},
            {},
        )
        return self._with_memory(needs, robot)

    def _leaf(self, slot: Slot) -> Node:
        start = self.episode.start[slot]
        return self.sensors.graph.leaf("slot", slot, start.kind, Level.LANE)

    def _with_memory(self, needs: RobotNeeds, robot: int) -> RobotNeeds:
        """Return the needs with all that is kept: what the decision reads, what this needs in turn, and so on."""
        start, kept = dict[Slot, Node](), dict[Slot, Node]()
        waiting = _slots_in([*needs.cells.values(), *needs.set_values, *needs.held.values()])
        while waiting:
            slot = waiting.pop()
            if slot in kept:
                continue
            if slot.name.startswith(BEFORE):
                kept[slot] = self._known(self._leaf(now(slot)))
            elif slot.name in self.memory and slot.robot == robot:
                kept[slot] = self._known(self._after(slot))
                start[slot] = self._known(self.episode.start[slot])
            else:
                continue
            waiting |= _slots_in([kept[slot]])
        order = {slot: index for index, slot in enumerate(self.episode.start)}
        places = sorted(kept, key=lambda slot: (slot.name.startswith(BEFORE), order[now(slot)]))
        return replace(
            needs,
            start={slot: start[slot] for slot in places if slot in start},
            next={slot: kept[slot] for slot in places},
        )

    def _given(self, robots: Sequence[RobotNeeds]) -> tuple[Given, ...]:
        """Return what is read and not kept, in the order of the spec."""
        read, of_team = set[str](), set[str]()
        for robot, needs in enumerate(robots):
            for slot in _slots_in(needs.outputs):
                if slot.name != plain_name(slot.name):
                    continue
                if slot.name not in self.memory or slot.robot != robot:
                    read.add(slot.name)
                if slot.robot not in (None, robot):
                    of_team.add(slot.name)
        blocks = {
            "world": [*self.environment.world],
            "state": [*self.environment.state],
            "observation": [*self.environment.outside.names] if self.environment.outside else [],
            "sensors": [*self.environment.sensors],
        }
        return tuple(
            Given(name, block, name in of_team, self._slots_of(name, of_team=name in of_team))
            for block, names in blocks.items()
            for name in names
            if name in read
        )

    def _slots_of(self, name: str, *, of_team: bool) -> tuple[Slot, ...]:
        if not of_team:
            return tuple(self.slots[name])
        return tuple(slot for slot in self.episode.start if slot.name == name)


def _slots_by_name(slots: Iterable[Slot]) -> dict[str, list[Slot]]:
    """Return the slots of each name: the world's, or those of robot 0."""
    by_name: dict[str, list[Slot]] = {}
    for slot in slots:
        if not slot.robot:
            by_name.setdefault(slot.name, []).append(slot)
    return by_name


def _actions_in_tables(controller: Controller) -> list[int]:
    """Return the numbers of the actions that some layer's table contains."""
    chosen = {layer.first_action + choice for layer in controller.layers for choice in layer.table if choice}
    return sorted(chosen)


def _axes(layer: Layer) -> list[int]:
    return [*layer.axes, *([] if layer.excitement is None else [layer.excitement])]


def _below(output: Node, done: Mapping[int, Node]) -> list[Node]:
    """Return a node and all below it that are not done, operands first."""
    found, waiting = dict[int, Node](), [output]
    while waiting:
        node = waiting.pop()
        if node.number not in found and node.number not in done:
            found[node.number] = node
            waiting.extend(node.operands)
    return [found[number] for number in sorted(found)]


def _slots_in(nodes: Iterable[Node]) -> set[Slot]:
    return {node.slot for node in needed(nodes) if node.operation == "slot"}
