"""What the robots compute alike, found again in a graph in which every robot has nodes of its own.

A family is one node for each robot. Where all of them are the same operation, their operands are families too, and
so on down to the leaves; then a kernel can write the operation once, in a loop over robots.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from itertools import islice
from typing import TYPE_CHECKING, cast

from bbsd.compiler.passes.folds import IMPOSSIBLE, Family, Fold, Folds, Key, Plan
from bbsd.compiler.passes.pairs import FOLDS, Pairs
from bbsd.expression.graph import Level, Node

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from bbsd.compiler.passes.robot_graph import RobotGraph
    from bbsd.expression.node_data import Variable


class CircularError(Exception):
    """Families that need one another: robots that are written apart must be computed apart."""


@dataclass
class Families:
    """Makes the nodes of a moment anew, a node for each family."""

    new: RobotGraph
    """Where the nodes are made; those of all moments of an episode in one."""
    team_slots: frozenset[Variable]
    """Name and place of what all robots always hold alike: stored once."""
    found: dict[Key, Node | None] = field(default_factory=dict)
    """None for pairs of robots that have nothing in common."""
    _nodes: dict[int, Node] = field(default_factory=dict)
    _owners: dict[int, tuple[tuple[int, ...], int]] = field(default_factory=dict)
    """The family that a node belongs to, and whose value in it it is."""
    _failed: Counter[Key] = field(default_factory=Counter)
    """How many ways of making a node did not do."""
    _apart: set[int] = field(default_factory=set)
    """Nodes of families that have nothing in common."""

    def __post_init__(self) -> None:
        """Loops over pairs read the same families."""
        self._folds = Folds(self.new, self.team_slots, self._key, self._owners)

    def know(self, families: Iterable[Sequence[Node]]) -> None:
        """Learn which nodes mean the same thing of different robots, whoever reads them."""
        for nodes in families:
            key = self._key(nodes)
            if isinstance(key, tuple) and _are_alike(nodes):
                for robot, node in enumerate(nodes):
                    if node.level is Level.LANE:
                        self._owners.setdefault(node.number, (key, robot))

    def team(self, node: Node) -> Node:
        """The new node of a value of the team. Raises CircularError."""
        self._nodes[node.number] = node
        return self._made(node.number)

    def each(self, nodes: Sequence[Node]) -> Node:
        """The new node of a family, given for every robot; the team's where all are the same. Raises CircularError."""
        return self._made(self._key(nodes))

    def known(self, nodes: Sequence[Node]) -> Node | None:
        """The new node of a family if it was made."""
        return self.found.get(self._key(nodes))

    def _key(self, nodes: Sequence[Node]) -> Family:
        self._nodes.update((node.number, node) for node in nodes)
        numbers = tuple(node.number for node in nodes)
        return numbers[0] if len(set(numbers)) == 1 else numbers

    def _made(self, wanted: Key) -> Node:
        """Make a node after all that it needs, without recursion: graphs are deep."""
        waiting, begun = [wanted], set[Key]()
        while waiting:
            key = waiting[-1]
            if key in self.found:
                waiting.pop()
                continue
            plan = needs, build = self._way(key)
            known = [self.found[need] for need in needs if need in self.found]
            if None not in known and len(known) < len(needs):
                begun.add(key)
                missing = [need for need in needs if need not in self.found]
                if not begun.isdisjoint(missing):
                    raise CircularError
                # What fails for one reason need not look for another.
                waiting.extend(missing[:1] if isinstance(key, Pairs | Fold) else missing)
                continue
            made = None if None in known else build(cast("list[Node]", known))
            begun.discard(key)
            if made is not None or isinstance(key, Fold) or plan is IMPOSSIBLE:
                self.found[key] = made
            else:
                self._failed[key] += 1
        return cast("Node", self.found[wanted])

    def _way(self, key: Key) -> Plan:
        """The best way that did not fail yet."""
        *_, plan = islice(self._ways(key), self._failed[key] + 1)
        return plan

    def _ways(self, key: Key) -> Iterator[Plan]:
        """Ways of making a node, the best first; the last one always does, but for pairs."""
        match key:
            case int():
                return self._ways_of_team(self._nodes[key])
            case tuple():
                return self._ways_of_each([self._nodes[number] for number in key])
            case Pairs():
                return self._folds.plans_of_pairs(key)
            case Fold():
                return iter([self._folds.plan_of_fold(key.number)])

    # --- Values of the team

    def _ways_of_team(self, node: Node) -> Iterator[Plan]:
        match node.operation:
            case "slot":
                yield (), lambda _: self._team_slot(node)
            case "choice":
                yield (), lambda _: self.new.of(self.new.choice(), node.index)
        if node.number in self._owners and node.number not in self._apart:
            family, robot = self._owners[node.number]
            yield (family,), lambda made: self._member(made[0], robot)
        elif (spine := self._spine(node)) is not None:
            yield (spine,), lambda made: self._folded(node, made[0])
        yield [self._key([operand]) for operand in node.operands], lambda made: self.new.again([node], made)

    def _team_slot(self, node: Node) -> Node:
        slot = node.slot
        if slot.robot is None or slot.variable in self.team_slots:
            return self.new.slot(node, Level.LANE)
        return self.new.of(self.new.slot(node, Level.EACH), slot.robot)

    def _member(self, family: Node, robot: int) -> Node | None:
        if family.level is Level.EACH:
            return self.new.of(family, robot)
        return family if family.level is not Level.ROBOT else None

    def _spine(self, node: Node) -> tuple[int, ...] | None:
        """The family that a fold such as ((h0 + h1) + h2) goes through, if it may be one."""
        if node.operation not in FOLDS:
            return None
        elements, rest = list[Node](), node
        while rest.operation == node.operation and len(elements) < self.new.robots - 1:
            rest, element = rest.operands
            elements.append(element)
        elements = [rest, *reversed(elements)]
        operations = {element.operation for element in elements}
        if len(elements) < self.new.robots or len(operations) > 1:
            return None
        key = self._key(elements)
        return key if isinstance(key, tuple) else None

    def _folded(self, node: Node, family: Node) -> Node | None:
        if family.level is not Level.EACH or family.operation == "each":
            return None
        return self.new.over(family, node.operation)

    # --- Families

    def _ways_of_each(self, nodes: Sequence[Node]) -> Iterator[Plan]:
        first = nodes[0]
        if all(node.operation == "choice" for node in nodes):
            yield (), lambda _: self.new.other(self.new.choice(), [node.index for node in nodes])
        if (robots_read := self._robots_of_slot(nodes)) is not None:
            yield (), lambda _: self.new.other(self.new.slot(first, Level.EACH), robots_read)
        if (seen := self._seen_of(nodes)) is not None:
            family, robots = seen
            yield (family,), lambda made: self._seen(made[0], robots)
        if all(node.literal for node in nodes):
            yield (), lambda _: self.new.varied("table", nodes)
        if all(node.operation == "constant" for node in nodes):
            yield (), lambda _: self.new.varied("pick", nodes)
        if _are_alike(nodes):
            yield from self._folds.plans_of_each(nodes)
            needs = [self._key(operands) for operands in zip(*(node.operands for node in nodes), strict=True)]
            yield needs, lambda made: self.new.again(nodes, made)
        yield self._plan_one_by_one(nodes)

    def _robots_of_slot(self, nodes: Sequence[Node]) -> list[int] | None:
        """Return the robots whose slot of one variable nodes read; None where they read something else."""
        if any(node.operation != "slot" for node in nodes):
            return None
        robots = [node.slot.robot for node in nodes if node.slot.robot is not None]
        variables = {node.slot.variable for node in nodes}
        one = len(robots) == len(nodes) and len(variables) == 1 and variables.isdisjoint(self.team_slots)
        return robots if one else None

    def _seen_of(self, nodes: Sequence[Node]) -> tuple[tuple[int, ...], list[int]] | None:
        """The family whose values these are, robots mixed, and whose value each robot has."""
        owners = [self._owners.get(node.number) for node in nodes]
        known = [owner for owner in owners if owner is not None]
        families, robots = {family for family, _ in known}, [robot for _, robot in known]
        if len(known) < len(nodes) or len(families) > 1 or self._key(nodes) in families:
            return None
        return families.pop(), robots

    def _seen(self, family: Node, robots: Sequence[int]) -> Node | None:
        if family.level is Level.ROBOT:
            return None
        return self.new.other(family, robots) if family.level is Level.EACH else family

    def _plan_one_by_one(self, nodes: Sequence[Node]) -> Plan:
        """Each is computed as the team's, then every robot reads its own."""
        self._apart.update(node.number for node in nodes)
        return [node.number for node in nodes], self.new.each


def _are_alike(nodes: Sequence[Node]) -> bool:
    """Whether nodes are one operation, so that a loop over robots may write it once."""
    first, *rest = nodes
    if not first.operands and first.operation != "draw":
        return False
    return all(
        (node.operation, node.kind, len(node.operands)) == (first.operation, first.kind, len(first.operands))
        and _same_but_for_place(first, node)
        for node in rest
    )


def _same_but_for_place(one: Node, other: Node) -> bool:
    """Whether nodes do the same but for the word of a draw, or the base of an element of the constants."""
    match one.operation:
        case "draw":
            return one.draw.distribution == other.draw.distribution
        case "gather":
            return one.gather[1:] == other.gather[1:]
    return one.data == other.data
