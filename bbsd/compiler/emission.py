"""Nodes to lines of Python: every value once, at the level at which it changes, under a name that a person knows."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, cast

from bbsd.compiler.schedule import stages
from bbsd.expression.graph import Kind, Level, Node, needed, value_of
from bbsd.expression.operations import INFIX

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from bbsd.compiler.looping import Loops
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
LEAF = frozenset({"slot", "constant", "step", "start"})
"""Operations that read a value where it stands."""
APART = frozenset({"of", "other", "over", "each"})
"""Operations that take a value from one loop to another."""
TOP_BIT = 1 << 63  # a literal from here on is uint64 in compiled code

Gathered = tuple[int | tuple[int, ...], tuple[int, ...], tuple[int, ...]]
"""Where an element of the constants is found: from a base, or each robot's, by strides of so many elements."""
Text = tuple[str, int]
"""An expression's source and how tightly its outermost operation binds."""


@dataclass(slots=True)
class Block:
    """Lines of one level and stage, and the nodes that have a name there."""

    level: Level
    stage: int = 0
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
class Blocks:
    """The blocks of a step: once a call, once a step, and for each stage its loop and what is once a robot there."""

    call: Block
    looped: bool
    """Whether there are loops over robots: the odd stages."""
    step: Block = field(default_factory=lambda: Block(Level.STEP))
    stages: dict[int, Block] = field(default_factory=dict)
    robots: dict[int, Block] = field(default_factory=dict)

    def stage(self, number: int) -> Block:
        """The block of a stage."""
        level = Level.EACH if self.looped and number % 2 else Level.LANE
        return self.stages.setdefault(number, Block(level, number))

    def robot(self, number: int) -> Block:
        """What is computed once a robot, before the lanes of a stage."""
        return self.robots.setdefault(number, Block(Level.ROBOT, number))

    def every(self) -> list[tuple[Block, Block | None]]:
        """The stages' blocks in their order, each with what is once a robot before it."""
        return [(self.stages[number], self.robots.get(number)) for number in sorted(self.stages)]


@dataclass(slots=True)
class Emitter:
    """Writes values into the blocks of a function, each where its level and stage say."""

    namer: Namer
    loops: Loops
    """What is special where there are loops over robots, and how values cross from one stage to another."""
    leaf: Callable[[Node], str]
    """The source of a slot, a constant or the step."""
    key: str
    """The source of the lane's key."""
    step: str
    """The source of the step's number, for draws."""
    hints: Mapping[int, str]
    """Names for nodes that mean something to the designer."""
    blocks: Blocks
    used: set[str] = field(default_factory=set)
    """Functions of the kernel that the source calls."""
    uses: Counter[int] = field(default_factory=Counter)
    deep: set[int] = field(default_factory=set)
    """Nodes far above their leaves and not yet written: they are written first, so that nothing recurses far."""
    stage_of: dict[int, int] = field(default_factory=dict)

    def prepare(self, outputs: Iterable[Node], decided: int = 0) -> None:
        """Count how often each value is used by what is to be written into the blocks, see where it belongs.

        And how deep it is.
        """
        outputs = list(outputs)
        every = needed(outputs)
        self.uses = Counter(operand.number for node in every for operand in node.operands)
        self.uses.update(node.number for node in outputs)
        self.deep = _deep(every)
        self.stage_of = stages(outputs, decided)

    def value(self, node: Node, into: Block) -> str:
        """The source of a value as an operand on its own; what it needs is written into the blocks first."""
        self._write_deep(node, into)
        return self._text(node, into)[0]

    def operand(self, node: Node, into: Block, *, tight: bool) -> str:
        """The source of a value as an operand of a sum, or as all of an expression."""
        self._write_deep(node, into)
        return self._operand(node, into, PRECEDENCE["+"] + 1 if tight else LOWEST)

    def named(self, node: Node, wanted: str, into: Block) -> str:
        """A name or literal for a value: its own if it has one, else the one wanted."""
        if node.literal or node.operation in LEAF:
            return self.value(node, into)
        self._write_deep(node, into)
        return self._define(node, wanted, into)

    def copied(self, node: Node, wanted: str, now: Block, later: Block) -> str:
        """A name in a later block for what a slot holds now; the slot may hold something else then."""
        name = self.namer(wanted)
        now.assign(name, self.value(node, now), node.kind)
        return name if later is now else self.loops.held(name, node, now)

    def _write_deep(self, node: Node, into: Block) -> None:
        """Name the deep values that a value needs, the lowest first."""
        if not self.deep:
            return
        for operand in needed(node.operands):
            if operand.number in self.deep:
                self._define(operand, self.hints.get(operand.number), into)
                self.deep.remove(operand.number)

    def _home(self, node: Node, into: Block) -> Block:
        """The block in which a value gets its name, for one that needs it."""
        match node.level:
            case Level.CALL:
                return self.blocks.call
            case Level.STEP:
                return self.blocks.step
            case Level.ROBOT:
                return self.blocks.robot(into.stage)
        return self.blocks.stage(self.stage_of.get(node.number, 0))

    def _text(self, node: Node, into: Block) -> Text:
        if node.literal:
            return _literal(node)
        home = self._home(node, into)
        if node.operation in LEAF:
            return self.leaf(node), ATOM
        if self._reads_slot(node) and node.level is into.level:
            return self._operation(node, into)
        if node.number in home.names or node.number in into.names:
            return self._define(node, None, into), ATOM
        worth_a_name = node.number in self.hints or self.uses[node.number] > 1 or home.level < into.level
        if worth_a_name or node.operation in EXPENSIVE | APART:
            return self._define(node, self.hints.get(node.number), into), ATOM
        text, binds = self._operation(node, into)
        if len(text) > LONGEST:
            return self._define(node, None, into), ATOM
        return text, binds

    def _reads_slot(self, node: Node) -> bool:
        """Whether a value is another robot's slot, read where it stands."""
        return node.operation in ("of", "other") and node.operands[0].operation == "slot"

    def _define(self, node: Node, wanted: str | None, into: Block) -> str:
        """The name of a value: it is written where it belongs, and kept from there if another stage needs it."""
        home = self._home(node, into)
        if node.number not in home.names:
            text, _ = self._operation(node, home)
            stem = {Level.CALL: "fixed", Level.STEP: "now", Level.ROBOT: "own"}.get(node.level, "part")
            name = self.namer(wanted) if wanted else self.namer.numbered(stem)
            home.assign(name, text, node.kind)
            home.names[node.number] = name
        return self._reached(node, home, into)

    def _reached(self, node: Node, home: Block, into: Block) -> str:
        """The name under which a block reads a value that another one computed."""
        name = home.names[node.number]
        if home.level not in (Level.LANE, Level.EACH) or home is into:
            return name
        if node.number not in into.names:
            into.assign(name, self.loops.kept(node, home), node.kind)
            into.names[node.number] = name
        return name

    def _operand(self, node: Node, into: Block, binds: int) -> str:
        text, own = self._text(node, into)
        return text if own >= binds else f"({text})"

    def _operation(self, node: Node, into: Block) -> Text:
        operation, operands = node.operation, node.operands
        if operation in PRECEDENCE:
            own = PRECEDENCE[operation]
            left, right = (
                self._operand(operand, into, binds)
                for operand, binds in zip(operands, (own, own + 1), strict=True)
            )
            return f"{left} {operation} {right}", own
        if operation in INFIX:
            left, right = (self._operand(operand, into, COMPARISON + 1) for operand in operands)
            return f"{left} {operation} {right}", COMPARISON
        match operation:
            case "negate":
                return f"-{self._operand(operands[0], into, ATOM)}", SIGN
            case "not":
                return f"not {self._operand(operands[0], into, COMPARISON)}", LOWEST
            case "draw":
                return self._draw(node, into), ATOM
            case "gather":
                return self._gather(node, into), ATOM
            case "table" | "pick":
                return self.loops.varied(node), ATOM
            case "of" | "other" | "over" | "each":
                return getattr(self.loops, operation)(node, into, self), ATOM
        arguments = [self._text(operand, into)[0] for operand in operands]
        return self.call(operation, [*arguments, *_data(node)]), ATOM

    def call(self, function: str, arguments: Iterable[str]) -> str:
        """The source of a call of a kernel's function, or of a built-in one."""
        if function not in ("abs", "int"):
            self.used.add(function)
        return f"{function}({', '.join(arguments)})"

    def _draw(self, node: Node, into: Block) -> str:
        distribution, word = cast("tuple[str, int | tuple[int, ...]]", node.data)
        if isinstance(word, tuple):
            block, named = (
                self.blocks.robot(into.stage),
                self.loops.tabled(hex(each | TOP_BIT) for each in word),
            )
        else:
            block, named = self.blocks.step, hex(word | TOP_BIT)
        if node.number not in block.names:
            stream = self.call("fold", [named, self.call("word_of", [self.step])])
            block.names[node.number] = self.namer.numbered("draw")
            block.lines.append(f"{block.names[node.number]} = {stream}")
        operands = [self._text(operand, into)[0] for operand in node.operands]
        return self.call(distribution, [self.key, block.names[node.number], *operands])

    def _gather(self, node: Node, into: Block) -> str:
        base, strides, lengths = cast("Gathered", node.data)
        terms = [self.loops.tabled(str(each) for each in base)] if isinstance(base, tuple) else []
        terms += [str(base)] if base and not terms else []
        for stride, length, index in zip(strides, lengths, node.operands, strict=True):
            place = self.call("clamp_index", [self._text(index, into)[0], str(length - 1)])
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
        return number_text(value)
    return str(value), ATOM


def number_text(value: float) -> Text:
    """The source of a number, and how tightly it binds."""
    if value != value:  # noqa: PLR0124 - NaN
        return "np.nan", ATOM
    if value in (float("inf"), float("-inf")):
        return ("np.inf", ATOM) if value > 0 else ("-np.inf", SIGN)
    text = repr(value)
    return text, SIGN if text.startswith("-") else ATOM
