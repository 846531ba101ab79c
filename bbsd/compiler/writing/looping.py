"""Loops over robots: what one stage of a step leaves to another, and how robots are told apart in a loop."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.compiler.writing.precedence import ATOM, COMPARISON, Text, infix, number_text, sum_of, times
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import PairFolds, RobotIndices, RobotLiterals

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.compiler.writing.blocks import Block
    from bbsd.compiler.writing.emission import Emitter
    from bbsd.compiler.writing.rollout_function import RolloutFunction
    from bbsd.expression.graph import Node


@dataclass
class Loops:
    """Writes what crosses from loop to loop of one step: the operations that `robot_graph` makes."""

    function: RolloutFunction
    arrays: dict[int, str] = field(default_factory=dict)
    """By node, where the values stand that are stored as soon as they are computed."""
    folds: dict[tuple[int, int], str] = field(default_factory=dict)
    """By stage and number, where what a loop over pairs folds stands."""
    seen: dict[tuple[int, tuple[int, ...]], str] = field(default_factory=dict)
    """By stage, where the values of the robots begin that are seen in it."""

    def kept(self, name: str, node: Node, home: Block) -> str:
        """The source of a value that another stage, `home`, computes under a name and keeps."""
        return self.function.read(self._kept(name, node, home), node.kind)[0]

    def _kept(self, name: str, node: Node, home: Block) -> str:
        if name not in home.kept:
            home.kept[name] = self.function.keep(f"{name}_kept", node.kind, node.level)
        return home.kept[name]

    def text(self, node: Node, into: Block, emitter: Emitter) -> Text:
        """The source of what is a robot's own, or is seen of another one."""
        match node.operation:
            case "table" | "pick":
                return self._of_robot(node, "robot"), ATOM
            case "so_far":
                return self.function.read(self.folds[into.stage, node.index], node.kind)
            case "theirs" if node.operands[0].operation in ("table", "pick"):
                return self._of_other(node, into), ATOM
            case "theirs":
                robot = "theirs", ATOM
            case "of":
                robot = times(node.index, ("stride", ATOM))
            case _:
                robot = self._seen(node.holding(RobotIndices), into, emitter), ATOM
        (family,) = node.operands
        index, _ = sum_of([robot, ("lane", ATOM)])
        return self.function.read(self._array(family, emitter), family.kind, index)

    def standing(self, node: Node, emitter: Emitter) -> Text:
        """The source of what stands in an array as soon as it is computed."""
        return self.function.read(self._array(node, emitter), node.kind)

    def _array(self, node: Node, emitter: Emitter) -> str:
        """The array in which a value stands; what stores it there is written first."""
        match node.operation:
            case "slot":
                return self.function.slot_of(node)
            case "over" | "each" | "among":
                if node.number not in self.arrays:
                    self.arrays[node.number] = self._stored(node, emitter)
                return self.arrays[node.number]
        home = emitter.blocks.stage(emitter.stage_of[node.number])
        return self._kept(emitter.repeatable(node, home)[0], node, home)

    def _stored(self, node: Node, emitter: Emitter) -> str:
        """The array of a value that is stored in the stage before its own, or in a loop over pairs before its own."""
        if node.operation == "among":
            return self._fold_among(node, emitter)
        block = emitter.blocks.stage(emitter.stage_of[node.number] - 1)
        store = self._fold if node.operation == "over" else self._gather
        return store(node, block, emitter)

    def _fold(self, node: Node, block: Block, emitter: Emitter) -> str:
        """Fold a family in the loop over robots that computes it."""
        function, operation = self.function, node.holding(str)
        value = emitter.repeatable(node.operands[0], block)
        array = self._new("over", node, emitter)
        so_far = function.read(array, node.kind)
        if operation in ("minimum", "maximum"):
            folded = function.call_of(operation, so_far[0], value[0])
        else:
            folded, _ = infix(operation, so_far, value)
        first = function.call_of("select", "robot == 0", value[0], folded)
        block.lines.append(function.store(array, first, node.kind))
        return array

    def _fold_among(self, node: Node, emitter: Emitter) -> str:
        """Fold for each robot what it sees of those that it looks at, in the loop over them."""
        others, numbers = node.holding(PairFolds)
        stage = emitter.stage_of[node.number]
        block = emitter.blocks.pair(stage, others=others)
        folds = list(zip(numbers, node.operands[::2], node.operands[1::2], strict=True))
        new = [fold for fold in folds if (stage, fold[0]) not in self.folds]
        for number, following, _ in new:
            self.folds[stage, number] = (
                self._new("over", node, emitter)
                if number == numbers[0]
                else self.function.keep_numbered("over", following.kind, node.level)
            )
        for number, following, first in new:
            self._write_fold(number, following, first, block, emitter)
        return self.folds[stage, numbers[0]]

    def _write_fold(self, number: int, following: Node, first: Node, block: Block, emitter: Emitter) -> None:
        """Compute what follows for one more robot; it is stored when all that is so far has been read."""
        array = self.folds[block.stage, number]
        name = self.function.namer(f"next_{array}")
        block.assign(name, self._next(following, first, block, emitter), following.kind)
        block.last.append(self.function.store(array, name, following.kind))

    def _next(self, following: Node, first: Node, block: Block, emitter: Emitter) -> str:
        """What follows, or what is first for the first robot."""
        begins, call = ("pair == 0", COMPARISON), self.function.call_of
        if (
            following.operation == "select"
            and following.operands[1] is first
            and following.kind is Kind.NUMBER
        ):
            condition, term, so_far = following.operands
            chosen, _ = infix("|", begins, emitter.text(condition, block))
            return call("blend", chosen, emitter.value(term, block), emitter.value(so_far, block))
        return call("select", begins[0], emitter.value(first, block), emitter.value(following, block))

    def _gather(self, node: Node, block: Block, emitter: Emitter) -> str:
        """Compute values that have nothing in common one by one."""
        array = self._new("apart", node, emitter)
        for robot, operand in enumerate(node.operands):
            index, _ = sum_of([times(robot, ("stride", ATOM)), ("lane", ATOM)])
            block.lines.append(self.function.store(array, emitter.value(operand, block), node.kind, index))
        return array

    def _new(self, stem: str, node: Node, emitter: Emitter) -> str:
        """An array for a value, called as the designer calls it if at all."""
        hint = emitter.hints.get(node.number)
        if hint:
            return self.function.keep(hint, node.kind, node.level)
        return self.function.keep_numbered(stem, node.kind, node.level)

    def _seen(self, robots: tuple[int, ...], into: Block, emitter: Emitter) -> str:
        """The name of where the values begin of the robot that each robot sees."""
        if (into.stage, robots) not in self.seen:
            name = self.function.namer.numbered("seen")
            begins, _ = infix("*", self._which(robots), ("stride", ATOM))
            emitter.blocks.robot(into.stage).lines.append(f"{name} = {begins}")
            self.seen[into.stage, robots] = name
        return self.seen[into.stage, robots]

    def _which(self, robots: tuple[int, ...]) -> Text:
        """The robot seen by each; the k-th of the others is k for those behind it and k + 1 for the rest."""
        k = robots[-1]
        if robots == tuple(k + (robot <= k) for robot in range(len(robots))):
            return sum_of([(str(k), ATOM), (self.function.call_of("cell_of", f"robot <= {k}"), ATOM)])
        return self.by_robot(map(str, robots)), ATOM

    def _of_other(self, node: Node, into: Block) -> str:
        """The name of a literal or a constant of the robot looked at, which all lanes have alike."""
        if node.number not in into.names:
            into.names[node.number] = self.function.namer.numbered("its")
            into.head.append(f"{into.names[node.number]} = {self._of_robot(node.operands[0], 'other')}")
        return into.names[node.number]

    def _of_robot(self, node: Node, robot: str) -> str:
        """A literal or a constant of the robot that a variable names."""
        if node.operation == "pick":
            return f"constants[{self.by_robot(map(str, node.holding(RobotIndices)), robot)}]"
        values = [value for value, _ in node.holding(RobotLiterals)]
        texts = (number_text(value)[0] if node.kind is Kind.NUMBER else str(value) for value in values)
        return self.by_robot(texts, robot)

    def by_robot(self, texts: Iterable[str], robot: str = "robot") -> str:
        """A robot's entry of a table that stands before the function."""
        text = f"({', '.join(texts)})"
        name = self.function.tables.setdefault(text, f"BY_ROBOT_{len(self.function.tables) + 1}")
        return f"{name}[{robot}]"
