"""The decisions of all robots as one: nodes that hold for whichever robot computes them.

Operations that exist only here, on leaves of one robot's graph:

- `own`: a value of the robot itself, or of the world; its slot has robot 0, or None;
- `of` (data: robot): the value of that robot, of the operand, which is an `own`;
- `other` (data: a robot for each robot): the value of another robot, of the operand, which is an `own`;
- `table` (data: literals): a literal for each robot;
- `each`: an operand for each robot, where they have nothing in common.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, Level, Node
from bbsd.expression.node_data import Draw, Literal, RobotDraws, RobotIndices, RobotLiterals

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

Family = tuple[Node, ...]
"""The same value of several robots."""
Key = tuple[tuple[int, ...], tuple[int, ...]]


@dataclass
class Team:
    """Merges nodes of all robots, each family once."""

    n_robots: int
    graph: Graph = field(default_factory=lambda: Graph(bounded=False))
    merged: dict[Key, Node] = field(default_factory=dict)

    def node(self, family: Iterable[Node]) -> Node:
        """Return the node that has each robot's value, given all robots' nodes in their order."""
        return self._node(tuple(family), tuple(range(self.n_robots)))

    def _node(self, family: Family, robots: tuple[int, ...]) -> Node:
        waiting = [(family, robots)]
        while waiting:
            top, whose = waiting[-1]
            key = _key(top, whose)
            missing = [
                part
                for part in self._parts(top, whose)
                if key not in self.merged and _key(*part) not in self.merged
            ]
            if missing:
                waiting += missing
                continue
            if key not in self.merged:
                self.merged[key] = self._merged(top, whose)
            waiting.pop()
        return self.merged[_key(family, robots)]

    def _parts(self, family: Family, robots: tuple[int, ...]) -> list[tuple[Family, tuple[int, ...]]]:
        """Return the families that a family is made of."""
        if _is_alike(family):
            return [(operands, robots) for operands in zip(*(node.operands for node in family), strict=True)]
        if all(node.literal for node in family):
            return []
        return [((node,), (robot,)) for node, robot in zip(family, robots, strict=True)]

    def _merged(self, family: Family, robots: tuple[int, ...]) -> Node:
        operands = tuple(self.merged[_key(*part)] for part in self._parts(family, robots))
        first, graph = family[0], self.graph
        if not _is_alike(family):
            if all(node.literal for node in family):
                literals = RobotLiterals(node.holding(Literal) for node in family)
                return graph.make("table", (), literals, first.kind, Level.ROBOT)
            return graph.make("each", operands, None, first.kind, Level.EACH)
        if first.operation == "slot":
            return self._read(family, robots)
        if isinstance(first.data, Draw):
            words = tuple(node.draw.word for node in family)
            data = RobotDraws(first.draw.distribution, words)
            return graph.make("draw", operands, data, first.kind, Level.LANE)
        return graph.make(first.operation, operands, first.data, first.kind, first.level)

    def _read(self, family: Family, robots: tuple[int, ...]) -> Node:
        """Return what reads a slot: the robot's own or the world's, one robot's, or another one's for each robot."""
        graph, first = self.graph, family[0]
        slot = first.slot
        own = graph.leaf(
            "own", slot if slot.robot is None else slot._replace(robot=0), first.kind, Level.LANE
        )
        read = [node.slot.robot for node in family]
        if slot.robot is None or read == list(robots):
            return own
        if len(set(read)) == 1:
            return graph.make("of", (own,), slot.robot, first.kind, Level.LANE)
        places = RobotIndices(robot for robot in read if robot is not None)
        return graph.make("other", (own,), places, first.kind, Level.EACH)


def _key(family: Family, robots: Sequence[int]) -> Key:
    return tuple(node.number for node in family), tuple(robots)


def _is_alike(family: Family) -> bool:
    """Return whether the nodes are the same operation, so that only their operands differ."""
    first = family[0]
    return all(
        node.operation == first.operation
        and node.kind is first.kind
        and len(node.operands) == len(first.operands)
        and _has_like_data(node, first)
        for node in family[1:]
    )


def _has_like_data(node: Node, first: Node) -> bool:
    match node.data, first.data:
        case Draw(distribution), Draw(other):
            return distribution == other
    if node.operation == "slot":
        return node.slot.variable == first.slot.variable and (node.slot.robot is None) == (
            first.slot.robot is None
        )
    return node.data == first.data and type(node.data) is type(first.data)
