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
from typing import TYPE_CHECKING, cast

from bbsd.expression.graph import Graph, Level, Node, kind_drawn
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.language.meaning.names import Slot

Gathered = tuple[int, tuple[int, ...], tuple[int, ...]]
"""Where an element of the constants is found: from a base by strides of so many elements, with the lengths."""


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
        name, robot, place = cast("Slot", node.data)
        return self.graph.leaf("slot", (name, None if robot is None else 0, place), node.kind, level)

    def of(self, family: Node, robot: int) -> Node:
        """One robot's value."""
        return self.graph.make("of", (family,), robot, family.kind, Level.LANE)

    def other(self, family: Node, robots: Sequence[int]) -> Node:
        """Another robot's value for each robot; the family itself if that is its own."""
        if list(robots) == list(range(self.robots)):
            return family
        return self.graph.make("other", (family,), tuple(robots), family.kind, Level.EACH)

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
        data = others, tuple(fold for fold, _, _ in folds)
        return self.graph.make("among", operands, data, operands[0].kind, Level.EACH)

    def varied(self, operation: str, nodes: Sequence[Node]) -> Node:
        """A `table` of literals or a `pick` of constants."""
        return self.graph.make(operation, (), tuple(node.data for node in nodes), nodes[0].kind, Level.ROBOT)

    def each(self, values: Sequence[Node]) -> Node:
        """Values that have nothing in common."""
        return self.graph.make("each", tuple(values), None, values[0].kind, Level.EACH)

    def again(self, nodes: Sequence[Node], operands: Sequence[Node]) -> Node:
        """The operation of a node, or of all nodes of a family, on new operands."""
        node, graph = nodes[0], self.graph
        match node.operation:
            case "draw":
                return self._draw(nodes, operands)
            case "gather":
                return self._gather(nodes, operands)
        if not node.operands:
            return graph.make(node.operation, (), node.data, node.kind, node.level)
        return graph.apply(node.operation, *operands, data=node.data)

    def _draw(self, nodes: Sequence[Node], operands: Sequence[Node]) -> Node:
        (distribution, word), *others = (cast("tuple[str, int]", node.data) for node in nodes)
        if not others:
            return self.graph.draw(distribution, word, tuple(operands))
        data = distribution, (word, *(other for _, other in others))
        return self.graph.make("draw", tuple(operands), data, kind_drawn(distribution), Level.EACH)

    def _gather(self, nodes: Sequence[Node], operands: Sequence[Node]) -> Node:
        """An element of the constants, from each robot's own base where they differ."""
        (base, strides, lengths), *others = (cast("Gathered", node.data) for node in nodes)
        made = self.graph.gather(base, strides, lengths, tuple(operands))
        bases = base, *(other for other, _, _ in others)
        if len(set(bases)) == 1:
            return made
        level = Level.EACH if made.level in (Level.LANE, Level.EACH) else Level.ROBOT
        return self.graph.make("gather", tuple(operands), (bases, strides, lengths), made.kind, level)
