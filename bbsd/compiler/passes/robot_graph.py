"""A graph for loops over robots: a node of level EACH, or ROBOT, is a family, one value for each robot.

Nodes that are met only here:

- `of` (data: robot): one robot's value of a family, for the team;
- `other` (data: a robot for each robot): what each robot sees of another one's value;
- `over` (data: operation): a family folded robot after robot, as `min(height[r] for r in team)` is;
- `table` (data: values), `pick` (data: positions): literals, constants that differ from robot to robot;
- `each`: values that have nothing in common, computed one by one;
- `theirs` (data: whether of the others): in a loop over robots looked at, the value of the one;
- `so_far` (data: the fold's number): there, what is folded of those before;
- `among` (data: whether the others, the folds' numbers): a robot's fold over those it looks at; its operands are, for
  this fold and each that it needs in the same loop, the next value and the first one;
- a `draw` with a word, a `gather` with a base for each robot.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import count
from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, Level, Node
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import (
    Draw,
    Gather,
    Literal,
    PairFolds,
    RobotDraws,
    RobotGathers,
    RobotIndices,
    RobotLiterals,
    Slot,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence


@dataclass(frozen=True, slots=True)
class RobotGraph:
    """Makes the nodes of a team of so many robots."""

    robots: int
    graph: Graph = field(default_factory=lambda: Graph(bounded=False))
    fold_numbers: Iterator[int] = field(default_factory=count)
    """No two folds of an episode have the same number, whichever moment they belong to."""

    def choice(self) -> Node:
        """What controls each robot."""
        return self.graph.leaf("choice", 0, Kind.CELL, Level.EACH)

    def slot(self, node: Node, level: Level) -> Node:
        """Each robot's slot of that name, or the team's, which is the world's or the same for all robots."""
        name, robot, place = node.slot
        return self.graph.leaf("slot", Slot(name, None if robot is None else 0, place), node.kind, level)

    def of(self, family: Node, robot: int) -> Node:
        """One robot's value."""
        return self.graph.make("of", (family,), robot, family.kind, Level.LANE)

    def other(self, family: Node, robots: Sequence[int]) -> Node:
        """Another robot's value for each robot; the family itself if that is its own."""
        if list(robots) == list(range(self.robots)):
            return family
        return self.graph.make("other", (family,), RobotIndices(robots), family.kind, Level.EACH)

    def over(self, family: Node, operation: str) -> Node:
        """A family folded."""
        return self.graph.make("over", (family,), operation, family.kind, Level.LANE)

    def theirs(self, family: Node, *, others: bool) -> Node:
        """The value of the robot looked at."""
        return self.graph.make("theirs", (family,), others, family.kind, Level.PAIR)

    def so_far(self, fold: int, kind: Kind) -> Node:
        """What is folded so far."""
        return self.graph.leaf("so_far", fold, kind, Level.PAIR)

    def among(self, folds: Sequence[tuple[int, Node, Node]], *, others: bool) -> Node:
        """The first fold, given by its number, the next value and the first one, with the others that it needs."""
        operands = tuple(node for _, following, first in folds for node in (following, first))
        data = PairFolds(others, tuple(fold for fold, _, _ in folds))
        return self.graph.make("among", operands, data, operands[0].kind, Level.EACH)

    def varied(self, operation: str, nodes: Sequence[Node]) -> Node:
        """A `table` of literals or a `pick` of constants."""
        data = (
            RobotLiterals(node.holding(Literal) for node in nodes)
            if operation == "table"
            else RobotIndices(node.index for node in nodes)
        )
        return self.graph.make(operation, (), data, nodes[0].kind, Level.ROBOT)

    def each(self, values: Sequence[Node]) -> Node:
        """Values that have nothing in common."""
        return self.graph.make("each", tuple(values), None, values[0].kind, Level.EACH)

    def again(self, nodes: Sequence[Node], operands: Sequence[Node]) -> Node:
        """The operation of a node, or of all nodes of a family, on new operands."""
        match nodes[0].data:
            case Draw() if len(nodes) > 1:
                return self._draw(nodes, operands)
            case Gather():
                return self._gather(nodes, operands)
        return self.graph.copy(nodes[0], operands)

    def _draw(self, nodes: Sequence[Node], operands: Sequence[Node]) -> Node:
        data = RobotDraws(nodes[0].draw.distribution, tuple(node.draw.word for node in nodes))
        return self.graph.make("draw", tuple(operands), data, nodes[0].kind, Level.EACH)

    def _gather(self, nodes: Sequence[Node], operands: Sequence[Node]) -> Node:
        """An element of the constants, from each robot's own base where they differ."""
        made = self.graph.copy(nodes[0], operands)
        _, strides, lengths = made.gather
        bases = tuple(node.gather.base for node in nodes)
        if len(set(bases)) == 1:
            return made
        level = Level.EACH if made.level in (Level.LANE, Level.EACH) else Level.ROBOT
        data = RobotGathers(bases, strides, lengths)
        return self.graph.make("gather", tuple(operands), data, made.kind, level)
