"""Loops over robots: what one stage of a step leaves to another, and how robots are told apart in a loop.

The values of one robot lie together, `stride` numbers from those of the next, and what is the team's lies in an
array of its own. So LLVM can see that a loop over the lanes of one robot does not overwrite what it reads.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, cast

from bbsd.compiler.emission import Block, number_text
from bbsd.compiler.families import table_values
from bbsd.expression.graph import Kind, Level, Node

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.compiler.emission import Emitter
    from bbsd.compiler.frame import Frame


@dataclass
class Loops:
    """Writes what crosses from loop to loop of one step."""

    frame: Frame
    arrays: dict[int, str] = field(default_factory=dict)
    """By node, where a value stands that one stage computes and another needs."""
    seen: dict[tuple[int, tuple[int, ...]], str] = field(default_factory=dict)
    """By stage, where the values of the robots begin that are seen in it."""

    def kept(self, node: Node, home: Block) -> str:
        """The source of a value that another stage, `home`, computes and keeps."""
        return self._read(self._array(node, home), node, "own + lane" if node.level is Level.EACH else "lane")

    def held(self, name: str, node: Node, now: Block) -> str:
        """The source, in a later block, of what has a name now."""
        array = self._new(f"{name}_kept", node)
        now.lines.append(self.frame.store(array, name, node.kind))
        return self._read(array, node, "own + lane" if node.level is Level.EACH else "lane")

    def _array(self, node: Node, home: Block) -> str:
        """Where a value is kept; it is stored there by the block that computes it."""
        if node.number not in self.arrays:
            name = home.names[node.number]
            self.arrays[node.number] = self._new(f"{name}_kept", node)
            home.lines.append(self.frame.store(self.arrays[node.number], name, node.kind))
        return self.arrays[node.number]

    def _new(self, wanted: str, node: Node) -> str:
        return self.frame.keep(wanted, node.kind, node.level)

    def _read(self, array: str, node: Node, index: str) -> str:
        return f"({array}[{index}] != 0.0)" if node.kind is Kind.TRUTH else f"{array}[{index}]"

    def _of_family(self, family: Node, index: str, emitter: Emitter) -> str:
        """The source of a value of a family at an index of its array."""
        if family.operation == "slot":
            return self._read(self.frame.slot_of(family), family, index)
        home = emitter.blocks.stage(emitter.stage_of[family.number])
        emitter.named(family, "part", home)
        return self._read(self._array(family, home), family, index)

    # --- The operations that `families` makes

    def of(self, node: Node, _into: Block, emitter: Emitter) -> str:
        """One robot's value."""
        index = f"{node.data} * stride + lane" if node.data else "lane"
        return self._of_family(node.operands[0], index, emitter)

    def other(self, node: Node, into: Block, emitter: Emitter) -> str:
        """What each robot sees of another one's value."""
        robots = cast("tuple[int, ...]", node.data)
        if (into.stage, robots) not in self.seen:
            name = self.frame.namer.numbered("seen")
            self.seen[into.stage, robots] = name
            emitter.blocks.robot(into.stage).lines.append(f"{name} = {self._which(robots)} * stride")
        return self._of_family(node.operands[0], f"{self.seen[into.stage, robots]} + lane", emitter)

    def _which(self, robots: tuple[int, ...]) -> str:
        """The robot seen by each; the k-th of the others is k for those behind it and k + 1 for the rest."""
        k = robots[-1]
        if robots == tuple(k + (robot <= k) for robot in range(len(robots))):
            return f"({k} + int(robot <= {k}))"
        return self.tabled(str(robot) for robot in robots)

    def over(self, node: Node, _into: Block, emitter: Emitter) -> str:
        """A family folded in the loop over robots that computes it."""
        (family,), operation = node.operands, cast("str", node.data)
        block = emitter.blocks.stage(emitter.stage_of[node.number] - 1)
        value = emitter.named(family, "part", block)
        array = self.frame.keep_numbered("over", node.kind, Level.LANE)
        so_far = self._read(array, node, "lane")
        if operation in ("minimum", "maximum"):
            folded = self.frame.call_of(operation, so_far, value)
        else:
            folded = f"{so_far} {operation} {value}"
        first = self.frame.call_of("select", "robot == 0", value, folded)
        block.lines.append(self.frame.store(array, first, node.kind))
        return so_far

    def each(self, node: Node, _into: Block, emitter: Emitter) -> str:
        """Values that have nothing in common, computed one by one in the team's loop before."""
        block = emitter.blocks.stage(emitter.stage_of[node.number] - 1)
        array = self.frame.keep_numbered("apart", node.kind, Level.EACH)
        for robot, operand in enumerate(node.operands):
            text = emitter.value(operand, block)
            block.lines.append(self.frame.store(array, text, node.kind, f"{robot} * stride + lane"))
        return self._read(array, node, "own + lane")

    def varied(self, node: Node) -> str:
        """A literal or a constant that differs from robot to robot."""
        if node.operation == "pick":
            return f"constants[{self.tabled(str(place) for place in cast('tuple[int, ...]', node.data))}]"
        values = table_values(node)
        if node.kind is Kind.NUMBER:
            return self.tabled(number_text(cast("float", value))[0] for value in values)
        return self.tabled(str(value) for value in values)

    def tabled(self, texts: Iterable[str]) -> str:
        """The entry for the robot of a table that stands before the function."""
        text = f"({', '.join(texts)})"
        name = self.frame.tables.setdefault(text, f"BY_ROBOT_{len(self.frame.tables) + 1}")
        return f"{name}[robot]"
