"""A graph for loops over robots: a node of level EACH, or ROBOT, is a family, one value for each robot.

Operations that exist only here:

- `of` (data: robot): one robot's value of a family, for the team;
- `other` (data: a robot for each robot): for each robot the value of another one;
- `over` (data: operation): a family folded robot after robot, as `min(height[r] for r in team)` is;
- `table` (data: literals), `pick` (data: places of constants): literals or constants that differ from robot to robot;
- `each`: values that have nothing in common, computed one by one;
- `theirs` (data: whether of the others): in a loop over pairs, the value of the robot looked at;
- `so_far` (data: the fold's number): in a loop over pairs, the fold of the robots looked at before;
- `among` (data: `PairFolds`): a robot's fold over those it looks at; its operands are, for this fold and each that it
  needs in the same loop, the next value and the first term;
- a `draw` with a word for each robot, a `gather` with a base for each robot.
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
    """The nodes of a team of so many robots."""

    n_robots: int
    graph: Graph = field(default_factory=lambda: Graph(bounded=False))
    fold_numbers: Iterator[int] = field(default_factory=count)
    """Gives each fold of an episode, of whichever moment, another number."""

    def choice(self) -> Node:
        """Return the number of each robot's controlling action."""
        return self.graph.leaf("choice", 0, Kind.CELL, Level.EACH)

    def slot(self, node: Node, level: Level) -> Node:
        """Return each robot's slot of a variable, or the team's: the world's, or one that all robots hold alike."""
        name, robot, place = node.slot
        return self.graph.leaf("slot", Slot(name, None if robot is None else 0, place), node.kind, level)

    def of(self, family: Node, robot: int) -> Node:
        """Return one robot's value of a family."""
        return self.graph.make("of", (family,), robot, family.kind, Level.LANE)

    def other(self, family: Node, robots: Sequence[int]) -> Node:
        """Return for each robot the value of another one; the family itself if each robot's is its own."""
        if list(robots) == list(range(self.n_robots)):
            return family
        return self.graph.make("other", (family,), RobotIndices(robots), family.kind, Level.EACH)

    def over(self, family: Node, operation: str) -> Node:
        """Return a family folded over the team."""
        return self.graph.make("over", (family,), operation, family.kind, Level.LANE)

    def theirs(self, family: Node, *, others: bool) -> Node:
        """Return the value of the robot looked at."""
        return self.graph.make("theirs", (family,), others, family.kind, Level.PAIR)

    def so_far(self, fold: int, kind: Kind) -> Node:
        """Return the fold of the robots looked at before."""
        return self.graph.leaf("so_far", fold, kind, Level.PAIR)

    def among(self, folds: Sequence[tuple[int, Node, Node]], *, others: bool) -> Node:
        """Return the first fold, with the others that it needs; each is a number, the next value and the first term."""
        operands = tuple(node for _, following, first in folds for node in (following, first))
        data = PairFolds(others, tuple(fold for fold, _, _ in folds))
        return self.graph.make("among", operands, data, operands[0].kind, Level.EACH)

    def varied(self, operation: str, nodes: Sequence[Node]) -> Node:
        """Return a `table` of literals or a `pick` of constants."""
        data = (
            RobotLiterals(node.holding(Literal) for node in nodes)
            if operation == "table"
            else RobotIndices(node.index for node in nodes)
        )
        return self.graph.make(operation, (), data, nodes[0].kind, Level.ROBOT)

    def each(self, values: Sequence[Node]) -> Node:
        """Return a family of values that have nothing in common."""
        return self.graph.make("each", tuple(values), None, values[0].kind, Level.EACH)

    def copy(self, nodes: Sequence[Node], operands: Sequence[Node]) -> Node:
        """Return the operation of a node, or of all nodes of a family, on new operands."""
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
        """Return an element of the constants, from each robot's own base where they differ."""
        copy = self.graph.copy(nodes[0], operands)
        _, strides, lengths = copy.gather
        bases = tuple(node.gather.base for node in nodes)
        if len(set(bases)) == 1:
            return copy
        level = Level.EACH if copy.level in (Level.LANE, Level.EACH) else Level.ROBOT
        data = RobotGathers(bases, strides, lengths)
        return self.graph.make("gather", tuple(operands), data, copy.kind, level)
