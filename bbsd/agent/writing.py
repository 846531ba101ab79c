"""The decision of one robot as Python functions of scalars, which run as they are and can be compiled.

What is written is flat: a layer's values are computed only where no higher layer has acted, and every function returns
as soon as it can.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import isinf, isnan
from typing import TYPE_CHECKING, NamedTuple

from bbsd.architecture.needs import ACTED, plain_variable
from bbsd.expression.graph import needed, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot, Variable
from bbsd.expression.operations import BINDING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from bbsd.architecture.controller import Controller, Layer
    from bbsd.architecture.needs import RobotNeeds
    from bbsd.expression.graph import Node

WORDS = {"&": "and", "|": "or"}
"""Operators of truths, both of whose operands are known: these need no second one where the first decides."""
STEP, KEY = "step", "key"
"""Arguments of every function: the step's number, a whole number from 1, and the key of an episode's random streams."""


@dataclass(frozen=True, slots=True)
class Body:
    """Lines of a function: each value is computed in the line before it is first needed, under a name.

    `names` has those that are known at this place, by their nodes' numbers; `used` the kernel's functions that are
    called.
    """

    values: Mapping[Slot, str]
    constants: Sequence[float]
    used: set[str]
    lines: list[str] = field(default_factory=list)
    indent: str = "    "
    names: dict[int, str] = field(default_factory=dict)

    def inner(self) -> Body:
        """Return a block within this one: what is computed there is not known outside."""
        return replace(self, indent=f"{self.indent}    ", names=dict(self.names))

    def say(self, line: str) -> None:
        """Write a line."""
        self.lines.append(f"{self.indent}{line}")

    def text(self, node: Node) -> str:
        """Return a name or a literal for a value; what it needs is computed first."""
        for each in needed([node]):
            if each.number not in self.names:
                self.names[each.number] = self._named(each)
        return self.names[node.number]

    def _named(self, node: Node) -> str:
        if node.literal:
            return literal_text(value_of(node)) if node.kind is Kind.NUMBER else str(value_of(node))
        match node.operation:
            case "slot":
                return self.values[node.slot]
            case "constant":
                return literal_text(self.constants[node.index])
            case "step":
                return self._define(node, f"float({STEP})")
        return self._define(node, self._operation(node))

    def _define(self, node: Node, text: str) -> str:
        name = f"v{node.number}"
        self.say(f"{name} = {text}")
        return name

    def _operation(self, node: Node) -> str:
        operation = node.operation
        operands = [self.names[operand.number] for operand in node.operands]
        if operation in BINDING:
            return f" {WORDS.get(operation, operation)} ".join(operands)
        match operation, operands:
            case "negate", (operand,):
                return f"-{operand}"
            case "not", (operand,):
                return f"not {operand}"
            case "abs", (operand,):
                return f"abs({operand})"
            case "select", (condition, then, otherwise):
                return f"{then} if {condition} else {otherwise}"
            case "minimum", (left, right):
                return f"{right} if {right} < {left} else {left}"
            case "maximum", (left, right):
                return f"{right} if {right} > {left} else {left}"
            case "cell_of", (operand,):
                return f"1 if {operand} else 0"
            case "divide", (dividend, divisor):
                self.used.add("divide")
                return f"{dividend} / {divisor} if {divisor} else divide({dividend}, {divisor})"
            case "draw", _:
                return self._draw(node, operands)
            case "gather", _:
                return self._gather(node, operands)
        self.used.add(operation)
        data = [] if node.data is None else [str(node.data)]
        return f"{operation}({', '.join([*operands, *data])})"

    def _draw(self, node: Node, operands: Sequence[str]) -> str:
        """Return a draw, as kernels make it: from the stream of its word and the step, within the episode's."""
        draw = node.draw
        self.used.update((draw.distribution, "fold", "word_of"))
        stream = f"fold({draw.kernel_word:#x}, word_of({STEP}))"
        return f"{draw.distribution}({', '.join([KEY, stream, *operands])})"

    def _gather(self, node: Node, operands: Sequence[str]) -> str:
        gather = node.gather
        self.used.add("clamp_index")
        terms = [
            f"{stride} * clamp_index({index}, {length - 1})"
            for stride, length, index in zip(gather.strides, gather.lengths, operands, strict=True)
        ]
        return f"CONSTANTS[{' + '.join([str(gather.base), *terms])}]"


def literal_text(value: float) -> str:
    """Return the source of a number, in parentheses where it has a sign."""
    if isnan(value):
        return "NAN"
    text = ("-INFINITY" if value < 0 else "INFINITY") if isinf(value) else repr(float(value))
    return f"({text})" if text.startswith("-") else text


def decision_lines(controller: Controller, needs: RobotNeeds, body: Body) -> None:
    """Write what returns the number of the controlling action."""
    for layer in controller.layers:
        inner = body
        if layer.excitement is not None:
            condition = needs.cells[layer.excitement]
            name = body.text(condition)
            word = "" if layer.excited_at else "not "
            body.say(
                f"if {word}{name}:" if condition.kind is Kind.TRUTH else f"if {name} == {layer.excited_at}:"
            )
            inner = body.inner()
        if len(set(layer.table)) == 1:
            inner.say(f"return {layer.first_action + layer.table[0]}" if layer.table[0] else "pass")
            continue
        place = place_text(layer, [_cell_text(needs.cells[axis], inner) for axis in layer.axes])
        inner.say(f"choice = TABLE_{layer.number}[{place}]")
        inner.say("if choice:")
        inner.say(f"    return {layer.first_action} + choice")
    body.say("return 0")


def _cell_text(node: Node, body: Body) -> str:
    """Return the index of a cell; where the dimension is a truth, that of the truth."""
    name = body.text(node)
    return f"(1 if {name} else 0)" if node.kind is Kind.TRUTH else name


def place_text(layer: Layer, cells: Sequence[str]) -> str:
    """Return the expression of a layer's place in its table, from the cells of its inputs."""
    place = cells[0]
    for cell, size in zip(cells[1:], layer.sizes[1:], strict=True):
        place = f"({place}) * {size} + {cell}"
    return place


def outcome_names(needs: RobotNeeds, number: int, kept: Sequence[Slot], body: Body) -> Outcome:
    """Write what an action sets, and what is kept for the next step once it has."""
    sets = {variable: body.text(node) for variable, node in needs.sets.get(number, {}).items()}
    acted = {
        slot: sets.get(plain_variable(slot)) or body.text(needs.held[plain_variable(slot)])
        for slot in slots_in(needs.next[each] for each in kept)
        if slot.name.startswith(ACTED)
    }
    after = replace(body, values={**body.values, **acted})
    return Outcome(sets, tuple(after.text(needs.next[slot]) for slot in kept))


class Outcome(NamedTuple):
    """The names of the values that an action sets, and of those that are kept."""

    sets: Mapping[Variable, str]
    kept: tuple[str, ...]


def slots_in(nodes: Iterable[Node]) -> set[Slot]:
    """Return the slots that some values are computed from."""
    return {node.slot for node in needed(nodes) if node.operation == "slot"}


def slots_read(needs: RobotNeeds) -> tuple[set[Slot], list[Slot]]:
    """Return the slots that have to be given, and those that are kept, as far as decisions depend on them."""
    given, kept = set[Slot](), set[Slot]()
    waiting = slots_in(
        [*needs.cells.values(), *(node for sets in needs.sets.values() for node in sets.values())]
    )
    while waiting:
        slot = waiting.pop()
        if slot in given or slot in kept:
            continue
        if slot.name.startswith(ACTED):
            waiting |= slots_in([needs.held[plain_variable(slot)]])
        elif slot in needs.next:
            kept.add(slot)
            waiting |= slots_in([needs.next[slot]])
        else:
            given.add(slot)
    return given, [slot for slot in needs.next if slot in kept]
