"""Nodes as statements of C: every value once, under a name that a person knows where it has one."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.exports.c import comment
from bbsd.exports.sensing.functions import PREFIX, function_of
from bbsd.exports.sensing.text import (
    ATOM,
    EQUALITY,
    INFIX,
    TYPES,
    Text,
    call,
    choice,
    infix,
    literal,
    minus,
    negated,
)
from bbsd.expression.graph import Node, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import RobotDraws, RobotIndices, RobotLiterals

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from bbsd.exports.sensing.naming import Namer
    from bbsd.expression.node_data import Slot

LONGEST_TEXT = 88
"""Characters of an expression without a name."""
DEEPEST = 40
"""Operations within one another without a name."""
PLAIN = frozenset({"own", "of", "other", "table", "step", "literal", "constant"})
"""Operations that only read."""
ROBOT = "robot"


@dataclass(slots=True)
class Reading:
    """How leaves are read; what they need beside is remembered, to be declared."""

    place: Callable[[Slot, str], str]
    """The source of a value, given the index of the robot."""
    draw: Callable[[RobotDraws], str]
    """The source of the random number of a draw."""
    constant: Callable[[int], str]
    """The name of a constant."""
    table: Callable[[int], tuple[str, int]]
    """The name of the table that has a constant, and its place in it."""


@dataclass(slots=True)
class Block:
    """Statements of one scope, and the names that values have in it."""

    namer: Namer
    lines: list[str] = field(default_factory=list)
    texts: dict[int, Text] = field(default_factory=dict)
    """By the node's number, the name of what has one."""

    def inner(self) -> Block:
        """Return a scope within this one, which sees its names."""
        return Block(self.namer.inner(), [], dict(self.texts))


@dataclass(slots=True)
class Emitter:
    """Writes values into blocks."""

    reading: Reading
    hints: dict[int, str]
    """Names for nodes that mean something to the designer."""
    comments: dict[str, str]
    """How the spec writes what has a hint."""
    used: set[str] = field(default_factory=set)
    """Functions that are called."""

    def texts(self, outputs: Iterable[Node], block: Block) -> list[Text]:
        """Return the sources of values; what they need is written into the block first."""
        outputs, hints = list(outputs), self.hints
        nodes = _needed_beyond(outputs, block.texts)
        counts = Counter(operand.number for node in nodes for operand in node.operands)
        counts.update(node.number for node in outputs)
        texts, depths = dict(block.texts), dict[int, int]()
        for node in nodes:
            text = texts[node.number] = self._operation(
                node, [texts[operand.number] for operand in node.operands], block
            )
            depth = depths[node.number] = 1 + max(
                (depths.get(operand.number, 0) for operand in node.operands), default=-1
            )
            is_long = len(text.source) > LONGEST_TEXT or depth >= DEEPEST
            if node.operation not in PLAIN and (node.number in hints or counts[node.number] > 1 or is_long):
                texts[node.number] = self._named(node, text, hints.get(node.number), block)
                depths[node.number] = 0
        return [texts[node.number] for node in outputs]

    def _named(self, node: Node, text: Text, hint: str | None, block: Block) -> Text:
        name = block.namer(hint) if hint else block.namer.numbered("part")
        if hint in self.comments:
            block.lines += comment(self.comments[hint])
        block.lines.append(f"const {TYPES[node.kind]} {name} = {text.source};")
        named = block.texts[node.number] = Text(name)
        return named

    def call(self, function: str, arguments: Iterable[Text]) -> Text:
        """Return a call of a function, which is remembered."""
        self.used.add(function)
        return call(function, arguments)

    def _operation(self, node: Node, operands: list[Text], block: Block) -> Text:
        if node.operation in INFIX:
            return self._infix(node, operands)
        if not node.operands or node.operation in ("of", "other"):
            return self._leaf(node, block)
        match node.operation:
            case "each":
                return self._each(operands)
            case "draw":
                return self._draw(node, operands)
            case "gather":
                return self._gather(node, operands)
            case "select":
                return choice(*operands)
            case "negate":
                return minus(operands[0])
            case "not":
                return negated(operands[0])
            case "cell_of":
                return operands[0]
            case "whole_power" | "clamp_index":
                operands = [*operands, Text(str(node.index))]
        return self.call(function_of(node.operation), operands)

    def _leaf(self, node: Node, block: Block) -> Text:
        match node.operation:
            case "literal":
                return literal(value_of(node), node.kind)
            case "constant":
                return Text(self.reading.constant(node.index))
            case "step":
                return Text("step")
            case "table":
                return self._table(node, block)
        return self._read(node)

    def _infix(self, node: Node, operands: list[Text]) -> Text:
        left, right = node.operands
        if left is right and left.kind is not Kind.NUMBER and node.operation in ("==", "!="):
            return Text("true" if node.operation == "==" else "false")
        return infix(node.operation, *operands)

    def _read(self, node: Node) -> Text:
        own = node.operands[0] if node.operands else node
        match node.data:
            case RobotIndices() as robots:
                index = _index_of_another(robots)
            case int(robot) if node.operation == "of":
                index = str(robot)
            case _:
                index = ROBOT
        return Text(self.reading.place(own.slot, index))

    def _table(self, node: Node, block: Block) -> Text:
        if node.number not in block.texts:
            literals = node.holding(RobotLiterals)
            held_by = [robot for robot, each in enumerate(literals) if each.value]
            if node.kind is Kind.TRUTH and len(held_by) == 1:
                return Text(f"{ROBOT} == {held_by[0]}", EQUALITY)
            name = block.namer.numbered("by_robot")
            values = ", ".join(literal(each.value, node.kind).source for each in literals)
            block.lines.append(f"static const {TYPES[node.kind]} {name}[{len(literals)}] = {{{values}}};")
            block.texts[node.number] = Text(f"{name}[{ROBOT}]")
        return block.texts[node.number]

    def _each(self, operands: list[Text]) -> Text:
        *before, text = operands
        for robot in reversed(range(len(before))):
            text = choice(Text(f"{ROBOT} == {robot}", EQUALITY), before[robot], text)
        return text

    def _draw(self, node: Node, operands: list[Text]) -> Text:
        draw = node.holding(RobotDraws)
        random = Text(self.reading.draw(draw))
        match draw.distribution:
            case "chance":
                return infix("<", random, operands[0])
            case "normal":
                return infix("+", operands[0], infix("*", operands[1], random))
            case "uniform":
                low, high = operands
                return infix("+", low, infix("*", infix("-", high, low), random))
        return self.call(PREFIX + draw.distribution, [random, *operands])

    def _gather(self, node: Node, operands: list[Text]) -> Text:
        gather = node.gather
        name, first = self.reading.table(gather.base)
        terms = [Text(str(first))] if first else []
        for stride, length, index in zip(gather.strides, gather.lengths, operands, strict=True):
            clamped = self.call(PREFIX + "clamp_index", [index, Text(str(length - 1))])
            terms.append(clamped if stride == 1 else infix("*", Text(str(stride)), clamped))
        place = terms[0]
        for term in terms[1:]:
            place = infix("+", place, term)
        return Text(f"{name}[{place.source}]", ATOM)


def _index_of_another(robots: RobotIndices) -> str:
    """Return the index of another robot; where each looks at the others in order, this is a sum."""
    for other in range(len(robots) - 1):
        if all(each == other + (robot <= other) for robot, each in enumerate(robots)):
            return f"{other} + ({ROBOT} <= {other})" if other else f"{ROBOT} <= 0"
    return _chosen(robots)


def _chosen(robots: RobotIndices) -> str:
    text = str(robots[-1])
    for robot in reversed(range(len(robots) - 1)):
        text = f"{ROBOT} == {robot} ? {robots[robot]} : {text}"
    return text


def _needed_beyond(outputs: Iterable[Node], known: Mapping[int, Text]) -> list[Node]:
    """Return the nodes that outputs need and that have no name yet, operands first."""
    found, waiting = dict[int, Node](), list(outputs)
    while waiting:
        node = waiting.pop()
        if node.number not in found and node.number not in known:
            found[node.number] = node
            waiting.extend(node.operands)
    return [found[key] for key in sorted(found)]
