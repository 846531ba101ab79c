"""Loops over robots: what one stage of a step leaves to another, and how robots are told apart in a loop."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, cast

from bbsd.compiler.texts import ATOM, Text, infix, number_text, sum_of, times
from bbsd.expression.graph import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.compiler.blocks import Block
    from bbsd.compiler.emission import Emitter
    from bbsd.compiler.frame import Frame
    from bbsd.expression.graph import Node


@dataclass
class Loops:
    """Writes what crosses from loop to loop of one step: the operations that `robot_graph` makes."""

    frame: Frame
    arrays: dict[int, str] = field(default_factory=dict)
    """By node, where the values stand that are stored as soon as they are computed."""
    seen: dict[tuple[int, tuple[int, ...]], str] = field(default_factory=dict)
    """By stage, where the values of the robots begin that are seen in it."""

    def kept(self, name: str, node: Node, home: Block) -> str:
        """The source of a value that another stage, `home`, computes under a name and keeps."""
        return self.frame.read(self._kept(name, node, home), node.kind)[0]

    def _kept(self, name: str, node: Node, home: Block) -> str:
        if name not in home.kept:
            home.kept[name] = self.frame.keep(f"{name}_kept", node.kind, node.level)
        return home.kept[name]

    def text(self, node: Node, into: Block, emitter: Emitter) -> Text:
        """The source of what is a robot's own, or is seen of another one."""
        match node.operation:
            case "table":
                return self._table(node), ATOM
            case "pick":
                places = cast("tuple[int, ...]", node.data)
                return f"constants[{self.by_robot(map(str, places))}]", ATOM
            case "of":
                robot = times(cast("int", node.data), ("stride", ATOM))
            case _:
                robot = self._seen(cast("tuple[int, ...]", node.data), into, emitter), ATOM
        (family,) = node.operands
        index, _ = sum_of([robot, ("lane", ATOM)])
        return self.frame.read(self._array(family, emitter), family.kind, index)

    def standing(self, node: Node, emitter: Emitter) -> Text:
        """The source of what stands in an array as soon as it is computed."""
        return self.frame.read(self._array(node, emitter), node.kind)

    def _array(self, node: Node, emitter: Emitter) -> str:
        """The array in which a value stands; what stores it there is written first."""
        match node.operation:
            case "slot":
                return self.frame.slot_of(node)
            case "over" | "each":
                if node.number not in self.arrays:
                    self.arrays[node.number] = self._stored(node, emitter)
                return self.arrays[node.number]
        home = emitter.blocks.stage(emitter.stage_of[node.number])
        return self._kept(emitter.repeatable(node, home)[0], node, home)

    def _stored(self, node: Node, emitter: Emitter) -> str:
        """The array of a value that is stored in the stage before its own."""
        block = emitter.blocks.stage(emitter.stage_of[node.number] - 1)
        store = self._fold if node.operation == "over" else self._gather
        return store(node, block, emitter)

    def _fold(self, node: Node, block: Block, emitter: Emitter) -> str:
        """Fold a family in the loop over robots that computes it."""
        frame, operation = self.frame, cast("str", node.data)
        value = emitter.repeatable(node.operands[0], block)
        array = self._new("over", node, emitter)
        so_far = frame.read(array, node.kind)
        if operation in ("minimum", "maximum"):
            folded = frame.call_of(operation, so_far[0], value[0])
        else:
            folded, _ = infix(operation, so_far, value)
        first = frame.call_of("select", "robot == 0", value[0], folded)
        block.lines.append(frame.store(array, first, node.kind))
        return array

    def _gather(self, node: Node, block: Block, emitter: Emitter) -> str:
        """Compute values that have nothing in common one by one."""
        array = self._new("apart", node, emitter)
        for robot, operand in enumerate(node.operands):
            index, _ = sum_of([times(robot, ("stride", ATOM)), ("lane", ATOM)])
            block.lines.append(self.frame.store(array, emitter.value(operand, block), node.kind, index))
        return array

    def _new(self, stem: str, node: Node, emitter: Emitter) -> str:
        """An array for a value, called as the designer calls it if at all."""
        hint = emitter.hints.get(node.number)
        if hint:
            return self.frame.keep(hint, node.kind, node.level)
        return self.frame.keep_numbered(stem, node.kind, node.level)

    def _seen(self, robots: tuple[int, ...], into: Block, emitter: Emitter) -> str:
        """The name of where the values begin of the robot that each robot sees."""
        if (into.stage, robots) not in self.seen:
            name = self.frame.namer.numbered("seen")
            begins, _ = infix("*", self._which(robots), ("stride", ATOM))
            emitter.blocks.robot(into.stage).lines.append(f"{name} = {begins}")
            self.seen[into.stage, robots] = name
        return self.seen[into.stage, robots]

    def _which(self, robots: tuple[int, ...]) -> Text:
        """The robot seen by each; the k-th of the others is k for those behind it and k + 1 for the rest."""
        k = robots[-1]
        if robots == tuple(k + (robot <= k) for robot in range(len(robots))):
            return sum_of([(str(k), ATOM), (self.frame.call_of("cell_of", f"robot <= {k}"), ATOM)])
        return self.by_robot(map(str, robots)), ATOM

    def _table(self, node: Node) -> str:
        values = [value for value, _ in cast("tuple[tuple[Any, str], ...]", node.data)]
        return self.by_robot(
            number_text(value)[0] if node.kind is Kind.NUMBER else str(value) for value in values
        )

    def by_robot(self, texts: Iterable[str]) -> str:
        """The robot's entry of a table that stands before the function."""
        text = f"({', '.join(texts)})"
        name = self.frame.tables.setdefault(text, f"BY_ROBOT_{len(self.frame.tables) + 1}")
        return f"{name}[robot]"
