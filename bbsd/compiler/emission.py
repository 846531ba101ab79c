"""Nodes to lines of Python: every value once, at the level at which it changes, under a name that a person knows."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, cast

from bbsd.expression.graph import Kind, Level, Node, needed, value_of
from bbsd.expression.operations import INFIX

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from bbsd.compiler.naming import Namer

PRECEDENCE = {"|": 2, "&": 3, "+": 5, "-": 5, "*": 6}
LOWEST, COMPARISON, SIGN, ATOM = 0, 1, 7, 9
LONGEST = 88
DEEPEST = 50
"""Operations within one another at which a value gets a name, however short its text."""
EXPENSIVE = frozenset(
    ["acos", "asin", "atan", "atan2", "cos", "exp", "log", "log2", "log10", "power", "sin", "tan", "tanh"]
)
"""Operations that have a line, and perhaps a loop, of their own."""
TOP_BIT = 1 << 63  # a literal from here on is uint64 in compiled code

Text = tuple[str, int]
"""An expression's source and how tightly its outermost operation binds."""


@dataclass(slots=True)
class Block:
    """Lines of one level, and the nodes that have a name there."""

    level: Level
    lines: list[str] = field(default_factory=list)
    names: dict[int, str] = field(default_factory=dict)
    kinds: dict[str, Kind] = field(default_factory=dict)
    """What those names hold that hold no number."""

    def assign(self, name: str, text: str, kind: Kind = Kind.NUMBER) -> None:
        """Write a line that gives a value its name."""
        self.lines.append(f"{name} = {text}")
        if kind is not Kind.NUMBER:
            self.kinds[name] = kind


@dataclass(slots=True)
class Emitter:
    """Writes values into the blocks of a function: once a call, once a step, once a lane."""

    namer: Namer
    leaf: Callable[[Node], str]
    """The source of a slot, a constant, the step or a choice."""
    key: str
    """The source of the lane's key."""
    step: str
    """The source of the step's number, for draws."""
    hints: Mapping[int, str]
    """Names for nodes that mean something to the designer."""
    blocks: dict[Level, Block]
    used: set[str] = field(default_factory=set)
    """Functions of the kernel that the source calls."""
    uses: Counter[int] = field(default_factory=Counter)
    deep: set[int] = field(default_factory=set)
    """Nodes far above their leaves and not yet written: they are written first, so that nothing recurses far."""

    def prepare(self, outputs: Iterable[Node]) -> None:
        """Count how often each value is used by what is to be written into the present blocks, and see how deep."""
        outputs = list(outputs)
        every = needed(outputs)
        self.uses = Counter(operand.number for node in every for operand in node.operands)
        self.uses.update(node.number for node in outputs)
        self.deep = _deep(every)

    def value(self, node: Node) -> str:
        """The source of a value as an operand on its own; what it needs is written into the blocks first."""
        self._write_deep(node)
        return self._text(node, Level.LANE)[0]

    def operand(self, node: Node, *, tight: bool) -> str:
        """The source of a value as an operand of a sum, or as all of an expression."""
        self._write_deep(node)
        return self._operand(node, Level.LANE, PRECEDENCE["+"] + 1 if tight else LOWEST)

    def named(self, node: Node, wanted: str) -> str:
        """A name or literal for a value: its own if it has one, else the one wanted."""
        if node.literal or self._trivial(node):
            return self.value(node)
        self._write_deep(node)
        return self._define(node, wanted)

    def _write_deep(self, node: Node) -> None:
        """Name the deep values that a value needs, the lowest first."""
        if not self.deep:
            return
        for operand in needed(node.operands):
            if operand.number in self.deep:
                self._define(operand, self.hints.get(operand.number))
                self.deep.remove(operand.number)

    def _text(self, node: Node, level: Level) -> Text:
        if node.literal:
            return _literal(node)
        known = self._known(node)
        if known is not None:
            return known, ATOM
        if self._trivial(node):
            return self.leaf(node), ATOM
        worth_a_name = node.number in self.hints or self.uses[node.number] > 1 or node.level < level
        if worth_a_name or node.operation in EXPENSIVE:
            return self._define(node, self.hints.get(node.number)), ATOM
        text, binds = self._operation(node)
        if len(text) > LONGEST:
            return self._define(node, None), ATOM
        return text, binds

    def _known(self, node: Node) -> str | None:
        return next(
            (block.names[node.number] for block in self.blocks.values() if node.number in block.names), None
        )

    def _trivial(self, node: Node) -> bool:
        return node.operation in ("slot", "constant", "step", "choice", "start")

    def _define(self, node: Node, wanted: str | None) -> str:
        known = self._known(node)
        if known is not None:
            return known
        text, _ = self._operation(node)
        stem = {Level.CALL: "fixed", Level.STEP: "now", Level.LANE: "part"}[node.level]
        name = self.namer(wanted) if wanted else self.namer.numbered(stem)
        block = self.blocks[node.level]
        block.assign(name, text, node.kind)
        block.names[node.number] = name
        return name

    def _operand(self, node: Node, level: Level, binds: int) -> str:
        text, own = self._text(node, level)
        return text if own >= binds else f"({text})"

    def _operation(self, node: Node) -> Text:
        operation, operands, level = node.operation, node.operands, node.level
        if operation in PRECEDENCE:
            own = PRECEDENCE[operation]
            left, right = (
                self._operand(operand, level, binds)
                for operand, binds in zip(operands, (own, own + 1), strict=True)
            )
            return f"{left} {operation} {right}", own
        if operation in INFIX:
            left, right = (self._operand(operand, level, COMPARISON + 1) for operand in operands)
            return f"{left} {operation} {right}", COMPARISON
        if operation == "negate":
            return f"-{self._operand(operands[0], level, ATOM)}", SIGN
        if operation == "not":
            return f"not {self._operand(operands[0], level, COMPARISON)}", LOWEST
        if operation == "draw":
            return self._draw(node), ATOM
        if operation == "gather":
            return self._gather(node), ATOM
        return self._call(
            operation, [*(self._text(operand, level)[0] for operand in operands), *_data(node)]
        ), ATOM

    def _call(self, function: str, arguments: Iterable[str]) -> str:
        if function not in ("abs", "int"):
            self.used.add(function)
        return f"{function}({', '.join(arguments)})"

    def _draw(self, node: Node) -> str:
        distribution, word = cast("tuple[str, int]", node.data)
        stream = self._call("fold", [hex(word | TOP_BIT), self._call("word_of", [self.step])])
        block = self.blocks[Level.STEP]
        name = self.namer.numbered("draw")
        block.lines.append(f"{name} = {stream}")
        return self._call(
            distribution, [self.key, name, *(self._text(operand, Level.LANE)[0] for operand in node.operands)]
        )

    def _gather(self, node: Node) -> str:
        base, strides, lengths = cast("tuple[int, tuple[int, ...], tuple[int, ...]]", node.data)
        terms = [str(base)] if base else []
        for stride, length, index in zip(strides, lengths, node.operands, strict=True):
            place = self._call("clamp_index", [self._text(index, node.level)[0], str(length - 1)])
            terms.append(place if stride == 1 else f"{stride} * {place}")
        return f"constants[{' + '.join(terms)}]"


def _deep(nodes: Iterable[Node]) -> set[int]:
    """Of nodes, operands first, those that are so many operations above a leaf or another of them."""
    depths: dict[int, int] = {}
    for node in nodes:
        depth = 1 + max((depths[operand.number] for operand in node.operands), default=-1)
        depths[node.number] = depth % DEEPEST
    return {node.number for node in nodes if node.operands and depths[node.number] == 0}


def _data(node: Node) -> list[str]:
    return [] if node.data is None else [str(node.data)]


def _literal(node: Node) -> Text:
    value = value_of(node)
    if node.kind is Kind.NUMBER:
        return _number(value)
    return str(value), ATOM


def _number(value: float) -> Text:
    if value != value:  # noqa: PLR0124 - NaN
        return "np.nan", ATOM
    if value in (float("inf"), float("-inf")):
        return ("np.inf", ATOM) if value > 0 else ("-np.inf", SIGN)
    text = repr(value)
    return text, SIGN if text.startswith("-") else ATOM
