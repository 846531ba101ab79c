"""Finds what the robots compute alike, in a graph in which every robot has nodes of its own.

A family is one node for each robot. Where all of them are the same operation, their operands are families too, and
so on down to the leaves; then a kernel can write the operation once, in a loop over robots.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from itertools import islice
from typing import TYPE_CHECKING, cast

from bbsd.compiler.passes.folds import IMPOSSIBLE, Family, FoldKey, FoldPlanner, Key, Plan
from bbsd.compiler.passes.pairs import FOLDABLE, Pairs
from bbsd.expression.graph import Level, Node

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from bbsd.compiler.passes.robot_graph import RobotGraph
    from bbsd.expression.node_data import Variable


class CircularError(Exception):
    """Families that need one another: their robots must be computed one by one."""


@dataclass
class Families:
    """Makes the nodes of one moment of an episode anew, one node for each family."""

    robots: RobotGraph
    """The graph of the new nodes; all moments of an episode share one."""
    team_slots: frozenset[Variable]
    """What all robots always hold alike: it is stored once."""
    _new: dict[Key, Node | None] = field(default_factory=dict)
    """The new nodes; None for pairs of robots that have nothing in common."""
    _nodes: dict[int, Node] = field(default_factory=dict)
    """The old nodes by their numbers."""
    _owners: dict[int, tuple[tuple[int, ...], int]] = field(default_factory=dict)
    """For the number of an old node, the family that it belongs to, and its robot."""
    _failed: Counter[Key] = field(default_factory=Counter)
    """The number of plans that failed for a key."""
    _unrelated: set[int] = field(default_factory=set)
    """Nodes of families that have nothing in common."""

    def __post_init__(self) -> None:
        """Plan loops over pairs from the same families."""
        self._folds = FoldPlanner(self.robots, self.team_slots, self._key, self._owners)

    def register(self, families: Iterable[Sequence[Node]]) -> None:
        """Register nodes that mean the same for different robots, so that others can read them as a family."""
        for nodes in families:
            key = self._key(nodes)
            if isinstance(key, tuple) and _are_alike(nodes):
                for robot, node in enumerate(nodes):
                    if node.level is Level.LANE:
                        self._owners.setdefault(node.number, (key, robot))

    def make_team_value(self, node: Node) -> Node:
        """Make the new node of a value of the team. Raises CircularError."""
        self._nodes[node.number] = node
        return self._make(node.number)

    def make_family(self, nodes: Sequence[Node]) -> Node:
        """Make the new node of a family, given for every robot; a team's if all are the same. Raises CircularError."""
        return self._make(self._key(nodes))

    def find_family(self, nodes: Sequence[Node]) -> Node | None:
        """Return the new node of a family if it was made."""
        return self._new.get(self._key(nodes))

    def _key(self, nodes: Sequence[Node]) -> Family:
        self._nodes.update((node.number, node) for node in nodes)
        numbers = tuple(node.number for node in nodes)
        return numbers[0] if len(set(numbers)) == 1 else numbers

    def _make(self, wanted: Key) -> Node:
        """Make a node after all that it needs, without recursion: graphs are deep."""
        waiting, begun = [wanted], set[Key]()
        while waiting:
            key = waiting[-1]
            if key in self._new:
                waiting.pop()
                continue
            plan = needs, build = self._next_plan(key)
            operands = [self._new[need] for need in needs if need in self._new]
            if None not in operands and len(operands) < len(needs):
                begun.add(key)
                missing = [need for need in needs if need not in self._new]
                if not begun.isdisjoint(missing):
                    raise CircularError
                # Plans for pairs often fail with their first need: then the others need not be made.
                waiting.extend(missing[:1] if isinstance(key, Pairs | FoldKey) else missing)
                continue
            node = None if None in operands else build(cast("list[Node]", operands))
            begun.discard(key)
            if node is not None or isinstance(key, FoldKey) or plan is IMPOSSIBLE:
                self._new[key] = node
            else:
                self._failed[key] += 1
        return cast("Node", self._new[wanted])

    def _next_plan(self, key: Key) -> Plan:
        """Return the best plan that did not fail yet."""
        *_, plan = islice(self._plans(key), self._failed[key] + 1)
        return plan

    def _plans(self, key: Key) -> Iterator[Plan]:
        """Yield plans for making a node, the best first; the last one always succeeds, except for pairs."""
        match key:
            case int():
                return self._plans_for_team(self._nodes[key])
            case tuple():
                return self._plans_for_family([self._nodes[number] for number in key])
            case Pairs():
                return self._folds.plans_for_pairs(key)
            case FoldKey():
                return iter([self._folds.plan_for_fold(key.number)])

    # --- Values of the team

    def _plans_for_team(self, node: Node) -> Iterator[Plan]:
        match node.operation:
            case "slot":
                yield (), lambda _: self._read_slot(node)
            case "choice":
                yield (), lambda _: self.robots.of(self.robots.choice(), node.index)
        if node.number in self._owners and node.number not in self._unrelated:
            family, robot = self._owners[node.number]
            yield (family,), lambda operands: self._read_member(operands[0], robot)
        elif (elements := self._folded_family(node)) is not None:
            yield (elements,), lambda operands: self._fold(node, operands[0])
        needs = [self._key([operand]) for operand in node.operands]
        yield needs, lambda operands: self.robots.copy([node], operands)

    def _read_slot(self, node: Node) -> Node:
        slot = node.slot
        if slot.robot is None or slot.variable in self.team_slots:
            return self.robots.slot(node, Level.LANE)
        return self.robots.of(self.robots.slot(node, Level.EACH), slot.robot)

    def _read_member(self, family: Node, robot: int) -> Node | None:
        if family.level is Level.EACH:
            return self.robots.of(family, robot)
        return family if family.level is not Level.ROBOT else None

    def _folded_family(self, node: Node) -> tuple[int, ...] | None:
        """Return the family that a value such as ((h0 + h1) + h2) may fold, if it looks so."""
        if node.operation not in FOLDABLE:
            return None
        elements, rest = list[Node](), node
        while rest.operation == node.operation and len(elements) < self.robots.n_robots - 1:
            rest, element = rest.operands
            elements.append(element)
        elements = [rest, *reversed(elements)]
        operations = {element.operation for element in elements}
        if len(elements) < self.robots.n_robots or len(operations) > 1:
            return None
        key = self._key(elements)
        return key if isinstance(key, tuple) else None

    def _fold(self, node: Node, family: Node) -> Node | None:
        if family.level is not Level.EACH or family.operation == "each":
            return None
        return self.robots.over(family, node.operation)

    # --- Families

    def _plans_for_family(self, nodes: Sequence[Node]) -> Iterator[Plan]:
        first = nodes[0]
        if all(node.operation == "choice" for node in nodes):
            yield (), lambda _: self.robots.other(self.robots.choice(), [node.index for node in nodes])
        if (robots_read := self._robots_of_slot(nodes)) is not None:
            yield (), lambda _: self.robots.other(self.robots.slot(first, Level.EACH), robots_read)
        if (members := self._members_of_other_family(nodes)) is not None:
            family, robots = members
            yield (family,), lambda operands: self._read_members(operands[0], robots)
        if all(node.literal for node in nodes):
            yield (), lambda _: self.robots.varied("table", nodes)
        if all(node.operation == "constant" for node in nodes):
            yield (), lambda _: self.robots.varied("pick", nodes)
        if _are_alike(nodes):
            yield from self._folds.plans_for_family(nodes)
            needs = [self._key(operands) for operands in zip(*(node.operands for node in nodes), strict=True)]
            yield needs, lambda operands: self.robots.copy(nodes, operands)
        yield self._plan_one_by_one(nodes)

    def _robots_of_slot(self, nodes: Sequence[Node]) -> list[int] | None:
        """Return the robots whose slots nodes read, if all read one variable; else None."""
        if any(node.operation != "slot" for node in nodes):
            return None
        robots = [node.slot.robot for node in nodes if node.slot.robot is not None]
        variables = {node.slot.variable for node in nodes}
        is_one = len(robots) == len(nodes) and len(variables) == 1 and variables.isdisjoint(self.team_slots)
        return robots if is_one else None

    def _members_of_other_family(self, nodes: Sequence[Node]) -> tuple[tuple[int, ...], list[int]] | None:
        """Return the family that all nodes are members of, not each robot its own, and whose value each robot has."""
        owners = [owner for node in nodes if (owner := self._owners.get(node.number)) is not None]
        families, robots = {family for family, _ in owners}, [robot for _, robot in owners]
        if len(owners) < len(nodes) or len(families) > 1 or self._key(nodes) in families:
            return None
        return families.pop(), robots

    def _read_members(self, family: Node, robots: Sequence[int]) -> Node | None:
        if family.level is Level.ROBOT:
            return None
        return self.robots.other(family, robots) if family.level is Level.EACH else family

    def _plan_one_by_one(self, nodes: Sequence[Node]) -> Plan:
        """Plan to compute each node as a value of the team, from which every robot reads its own."""
        self._unrelated.update(node.number for node in nodes)
        return [node.number for node in nodes], self.robots.each


def _are_alike(nodes: Sequence[Node]) -> bool:
    """Return whether nodes are one operation, so that a loop over robots may write it once."""
    first, *rest = nodes
    if not first.operands and first.operation != "draw":
        return False
    return all(
        (node.operation, node.kind, len(node.operands)) == (first.operation, first.kind, len(first.operands))
        and _have_like_data(first, node)
        for node in rest
    )


def _have_like_data(one: Node, other: Node) -> bool:
    """Return whether the data of nodes are equal, apart from the word of a draw or the base of a gather."""
    match one.operation:
        case "draw":
            return one.draw.distribution == other.draw.distribution
        case "gather":
            return one.gather[1:] == other.gather[1:]
    return one.data == other.data
