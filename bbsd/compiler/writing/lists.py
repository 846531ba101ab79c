"""Lists of state that an array keeps: what sets their elements, behind all else in a step, and loops over elements.

What is set, where and whether, is computed in the loops before and kept, so that those still vectorize.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.compiler.passes.list_values import strides_of
from bbsd.compiler.writing.precedence import Text, number_text, sum_of, times
from bbsd.compiler.writing.rollout_function import ONE, ZERO, indent, length_of
from bbsd.expression.graph import Node, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import ListShape

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bbsd.compiler.writing.blocks import Block
    from bbsd.compiler.writing.emission import Emitter
    from bbsd.compiler.writing.rollout_function import RolloutFunction
    from bbsd.expression.node_data import Slot


@dataclass
class Lists:
    """The lines that write lists, while they are collected."""

    function: RolloutFunction
    lines: dict[bool, list[str]] = field(default_factory=lambda: {False: [], True: []})
    """Loops over lanes behind all others of the team (False), or of each robot."""

    def start(self, slot: Slot, node: Node, emitter: Emitter, block: Block) -> None:
        """Store the elements of a list at the start: alike in a loop, else one by one."""
        function, array = self.function, self.function.slots[slot]
        length = length_of(function.episode.after[slot])
        if len(node.operands) == 1:
            self.fill(array, length, self._kept(node.operands[0], emitter, block))
        elif all(operand.literal for operand in node.operands):
            table = [self._literal(operand).source for operand in node.operands]
            self.fill(array, length, self._entry(table))
        elif all(operand.operation == "constant" for operand in node.operands):
            entry = self._entry([str(operand.index) for operand in node.operands])
            self.fill(array, length, Text(f"constants[{entry.source}]"))
        else:
            for place, operand in enumerate(node.operands):
                text = function.as_stored(emitter.text(operand, block), node.kind)
                block.store(function.in_list(array, Text(str(place * function.lanes))), text)

    def fill(self, array: str, length: int, text: Text) -> None:
        """Store a value in every element of an array."""
        element = self.function.in_list(array, times(self.function.lanes, Text("element")))
        self._loop(length, f"{element} = {text.source}", of_robots=self.function.is_own(array))

    def count(self, array: str, slot: Slot, step: Text) -> None:
        """Count for every element of a list whether its value is not finite, as so many steps."""
        function, offset = self.function, times(self.function.lanes, Text("element"))
        finite = function.call_of("is_finite", Text(function.in_list(function.slots[slot], offset)))
        counted, more = function.in_list(array, offset), function.call_of("select", finite, ZERO, step)
        length = length_of(function.episode.after[slot])
        self._loop(length, f"{counted} = {counted} + {more.source}", of_robots=function.is_own(array))

    def take(self, array: str, row: Text, length: int, *, of_robots: bool) -> None:
        """Write what was counted for every element to rows of the caller's; of robots, those of each."""
        counted = self.function.in_list(array, times(self.function.lanes, Text("element")))
        line = f"not_finite[{sum_of([row, Text('element')]).source}, base + lane] = {counted}"
        self._loop(length, line, of_robots=of_robots)

    def store(self, slot: Slot, node: Node, emitter: Emitter, block: Block) -> None:
        """Store what a step sets, in order; the block knows all that it needs."""
        function, array = self.function, self.function.slots[slot]
        lengths = node.holding(ListShape).lengths
        width, lines = len(lengths) + 2, list[str]()
        for first in range(0, len(node.operands), width):
            condition, *indices, value = node.operands[first : first + width]
            element = function.in_list(array, self._offset(indices, lengths, emitter, block))
            text = self._kept(value, emitter, block)
            if not condition.literal or not value_of(condition):
                hit = function.read(self._kept_in("hit", condition, emitter, block), Kind.TRUTH)
                text = function.call_of("select", hit, text, Text(element))
            lines.append(f"{element} = {text.source}")
        self.lines[function.is_own(array)] += function.lane_loop(lines) if lines else []

    def _offset(
        self, indices: Sequence[Node], lengths: Sequence[int], emitter: Emitter, block: Block
    ) -> Text:
        """Return where an element stands, without its lane."""
        function = self.function
        strides = [stride * function.lanes for stride in strides_of(lengths)]
        offset = sum_of(
            times(stride, emitter.clamped(index, length - 1, block))
            for stride, index, length in zip(strides, indices, lengths, strict=True)
        )
        if all(index.literal for index in indices):
            return offset
        kept = function.keep_numbered("at", Kind.CELL, block.level)
        block.store(function.at(kept), offset)
        return function.read(kept)

    def _kept(self, node: Node, emitter: Emitter, block: Block) -> Text:
        """Return a value as arrays keep it, where other loops read it."""
        if node.literal:
            return self._literal(node)
        return self.function.read(self._kept_in("value", node, emitter, block))

    def _kept_in(self, stem: str, node: Node, emitter: Emitter, block: Block) -> str:
        """Keep a value for the loops behind, as arrays keep it; return the array."""
        function = self.function
        text = function.as_stored(emitter.text(node, block), node.kind)
        array = function.keep_numbered(stem, Kind.NUMBER, block.level)
        block.store(function.at(array), text)
        return array

    def _literal(self, node: Node) -> Text:
        if node.kind is Kind.TRUTH:
            return ONE if value_of(node) else ZERO
        return number_text(value_of(node))

    def _entry(self, entries: Iterable[str]) -> Text:
        """Return an element's entry of a table that stands before the function."""
        table = f"({', '.join(entries)})"
        tables = self.function.tables
        name = tables.setdefault(table, f"BY_ELEMENT_{len(tables) + 1}")
        return Text(f"{name}[element]")

    def _loop(self, length: int, line: str, *, of_robots: bool) -> None:
        lines = indent(self.function.lane_loop([line]), 1)
        self.lines[of_robots] += [f"for element in range({length}):", *lines]

    def written(self) -> list[str]:
        """Return all lines, and begin anew."""
        team, own = self.lines[False], self.lines[True]
        self.lines = {False: [], True: []}
        if own:
            team += [f"for robot in range({self.function.team}):", *indent(["own = robot * stride", *own], 1)]
        return team
