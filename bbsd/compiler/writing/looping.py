"""Loops over robots: how values cross from one stage of a step to another, and how robots are told apart in a loop."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.compiler.writing.precedence import COMPARISON, Text, infix, name_text, number_text, sum_of, times
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import PairFolds, RobotIndices, RobotLiterals

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.compiler.writing.blocks import Block, Writer
    from bbsd.compiler.writing.rollout_function import RolloutFunction
    from bbsd.expression.graph import Node

LANE, STRIDE = Text("lane"), Text("stride")
FIRST_ROBOT, FIRST_PAIR = Text("robot == 0", COMPARISON), Text("pair == 0", COMPARISON)


@dataclass
class Loops:
    """The source of the operations that `robot_graph` makes, and of what crosses between the loops of one step."""

    function: RolloutFunction
    arrays: dict[int, str] = field(default_factory=dict)
    """By node, the arrays of values that are stored as soon as they are computed."""
    folds: dict[tuple[int, int], str] = field(default_factory=dict)
    """By stage and fold number, the array in which a loop over pairs accumulates."""
    seen: dict[tuple[int, tuple[int, ...]], str] = field(default_factory=dict)
    """By stage, the name of the offset at which the values begin of the robot that each robot sees."""

    def kept(self, name: str, node: Node, home: Block) -> str:
        """Return the element of the array in which `home`, another stage, keeps the value that it computes."""
        return self.function.read(self._kept(name, node, home), node.kind).source

    def _kept(self, name: str, node: Node, home: Block) -> str:
        if name not in home.kept:
            home.keep_in(self.function.keep(f"{name}_kept", node.kind, node.level), name)
        return home.kept[name]

    def text(self, node: Node, into: Block, writer: Writer) -> Text:
        """Return the source of a value that is a robot's own, or that it sees of another one."""
        match node.operation:
            case "table" | "pick":
                return self._of_robot(node, "robot")
            case "so_far":
                return self.function.read(self.folds[into.stage, node.index], node.kind)
            case "theirs" if node.operands[0].operation in ("table", "pick"):
                return self._of_other(node, into)
            case "theirs":
                robot = Text("theirs")
            case "of":
                robot = times(node.index, STRIDE)
            case _:
                robot = self._seen(node.holding(RobotIndices), into, writer)
        (family,) = node.operands
        return self.function.read(self._array(family, writer), family.kind, sum_of([robot, LANE]))

    def stored_at_once(self, node: Node, writer: Writer) -> Text:
        """Return the source of a value that is stored in an array as soon as it is computed."""
        return self.function.read(self._array(node, writer), node.kind)

    def _array(self, node: Node, writer: Writer) -> str:
        """Return the array of a value; what stores it there is written first."""
        match node.operation:
            case "slot":
                return self.function.slot_of(node)
            case "over" | "each" | "among":
                if node.number not in self.arrays:
                    self.arrays[node.number] = self._stored(node, writer)
                return self.arrays[node.number]
        home = writer.blocks.stage(writer.stage_of[node.number])
        return self._kept(writer.repeatable(node, home).source, node, home)

    def _stored(self, node: Node, writer: Writer) -> str:
        """Store a value in the stage before its own, or in a loop over pairs before its own; return its array."""
        if node.operation == "among":
            return self._fold_among(node, writer)
        block = writer.blocks.stage(writer.stage_of[node.number] - 1)
        store = self._fold if node.operation == "over" else self._gather
        return store(node, block, writer)

    def _fold(self, node: Node, block: Block, writer: Writer) -> str:
        """Fold a family in the loop over robots that computes it."""
        function, operation = self.function, node.holding(str)
        value = writer.repeatable(node.operands[0], block)
        array = self._new("over", node, writer)
        accumulated = function.read(array, node.kind)
        if operation in ("minimum", "maximum"):
            folded = function.call_of(operation, accumulated, value)
        else:
            folded = infix(operation, accumulated, value)
        folded = function.call_of("select", FIRST_ROBOT, value, folded)
        block.store(function.at(array), function.as_stored(folded, node.kind))
        return array

    def _fold_among(self, node: Node, writer: Writer) -> str:
        """Fold for each robot what it sees of those that it looks at, in the loop over them."""
        others, numbers = node.holding(PairFolds)
        stage = writer.stage_of[node.number]
        block = writer.blocks.pair(stage, others=others)
        folds = list(zip(numbers, node.operands[::2], node.operands[1::2], strict=True))
        new = [fold for fold in folds if (stage, fold[0]) not in self.folds]
        for number, following, _ in new:
            self.folds[stage, number] = (
                self._new("over", node, writer)
                if number == numbers[0]
                else self.function.keep_numbered("over", following.kind, node.level)
            )
        for number, following, first in new:
            self._write_fold(number, following, first, block, writer)
        return self.folds[stage, numbers[0]]

    def _write_fold(self, number: int, following: Node, first: Node, block: Block, writer: Writer) -> None:
        """Compute a fold's value with one more robot, and store it when all accumulated values have been read."""
        function, array = self.function, self.folds[block.stage, number]
        name = function.namer(f"next_{array}")
        value = block.define(name, self._next(following, first, block, writer), following.kind)
        block.store_after(function.at(array), function.as_stored(value, following.kind))

    def _next(self, following: Node, first: Node, block: Block, writer: Writer) -> Text:
        """Return the fold's next value, or its first one for the first robot."""
        call = self.function.call_of
        if (
            following.operation == "select"
            and following.operands[1] is first
            and following.kind is Kind.NUMBER
        ):
            condition, term, accumulated = following.operands
            chosen = infix("|", FIRST_PAIR, writer.text(condition, block))
            return call("blend", chosen, writer.text(term, block), writer.text(accumulated, block))
        return call("select", FIRST_PAIR, writer.text(first, block), writer.text(following, block))

    def _gather(self, node: Node, block: Block, writer: Writer) -> str:
        """Compute values that have nothing in common one by one."""
        array = self._new("apart", node, writer)
        for robot, operand in enumerate(node.operands):
            index = sum_of([times(robot, STRIDE), LANE])
            value = self.function.as_stored(writer.text(operand, block), node.kind)
            block.store(f"{array}[{index.source}]", value)
        return array

    def _new(self, stem: str, node: Node, writer: Writer) -> str:
        """Add an array for a value, named as the designer names it if at all."""
        hint = writer.hints.get(node.number)
        if hint:
            return self.function.keep(hint, node.kind, node.level)
        return self.function.keep_numbered(stem, node.kind, node.level)

    def _seen(self, robots: tuple[int, ...], into: Block, writer: Writer) -> Text:
        """Return the offset at which the values begin of the robot that each robot sees."""
        if (into.stage, robots) not in self.seen:
            name = self.function.namer.numbered("seen")
            writer.blocks.robot(into.stage).define(name, infix("*", self._which(robots), STRIDE))
            self.seen[into.stage, robots] = name
        name = self.seen[into.stage, robots]
        into.see_robot(name)
        return name_text(name)

    def _which(self, robots: tuple[int, ...]) -> Text:
        """Return the robot that each sees; the k-th of the others is k for those behind it and k + 1 for the rest."""
        k = robots[-1]
        if robots == tuple(k + (robot <= k) for robot in range(len(robots))):
            behind = Text(f"robot <= {k}", COMPARISON)
            return sum_of([Text(str(k)), self.function.call_of("cell_of", behind)])
        return self.by_robot(map(str, robots))

    def _of_other(self, node: Node, into: Block) -> Text:
        """Return the name of a literal or a constant of the robot looked at, which all lanes have alike."""
        if node.number not in into.names:
            name = self.function.namer.numbered("its")
            into.define_before(name, self._of_robot(node.operands[0], "other"), node)
        return name_text(into.names[node.number])

    def _of_robot(self, node: Node, robot: str) -> Text:
        """Return a literal or a constant of the robot that a variable names."""
        if node.operation == "pick":
            element = self.by_robot(map(str, node.holding(RobotIndices)), robot)
            return Text(f"constants[{element.source}]")
        values = [value for value, _ in node.holding(RobotLiterals)]
        texts = (number_text(value).source if node.kind is Kind.NUMBER else str(value) for value in values)
        return self.by_robot(texts, robot)

    def by_robot(self, entries: Iterable[str], robot: str = "robot") -> Text:
        """Return a robot's entry of a table that stands before the function."""
        table = f"({', '.join(entries)})"
        name = self.function.tables.setdefault(table, f"BY_ROBOT_{len(self.function.tables) + 1}")
        return Text(f"{name}[{robot}]")
