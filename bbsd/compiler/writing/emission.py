"""Nodes as lines of Python: every value once, at the level at which it changes, under a name that a person knows."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from bbsd.compiler.passes.pairs import nodes_of_pairs
from bbsd.compiler.writing.blocks import Blocks
from bbsd.compiler.writing.looping import Loops
from bbsd.compiler.writing.precedence import (
    ATOM,
    COMPARISON,
    LOWEST,
    SIGN,
    Text,
    call,
    grouped,
    infix,
    literal_text,
    name_text,
    sum_of,
    times,
)
from bbsd.compiler.writing.rollout_function import as_read
from bbsd.compiler.writing.schedule import stages_of
from bbsd.expression.graph import Level, Node, needed, value_of
from bbsd.expression.node_data import Elements, RobotDraws, RobotGathers
from bbsd.expression.operations import BINDING, EXPENSIVE
from bbsd.kernel.functions import clamp_index

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from bbsd.compiler.writing.blocks import Block
    from bbsd.compiler.writing.naming import Namer
    from bbsd.compiler.writing.rollout_function import RolloutFunction

LONGEST_TEXT = 88
"""Characters of an expression without a name; a longer one gets a name, so that lines can be read."""
DEEPEST = 50
"""Operations within one another at which a value gets a name, however short its source: so nothing recurses far."""
LEAF = frozenset({"slot", "constant", "step", "start"})
"""Operations that read a value from an array, an argument or a variable of the loops."""
STORED_AT_ONCE = frozenset({"over", "each", "among"})
"""Operations whose value is stored in an array as soon as it is computed."""
CROSSING = frozenset({"of", "other", "theirs"})
"""Operations that read what another robot's loop computes."""
STORED_BEFORE = frozenset({"slot", "table", "pick"})
"""Operations whose values are stored before a step is computed."""
STEMS = {Level.CALL: "fixed", Level.STEP: "now", Level.ROBOT: "its"}
"""Of the names of values that mean nothing to the designer, by how often they change."""


class Usage(NamedTuple):
    """How outputs use the values that they need."""

    counts: Counter[int]
    """By the node's number, how often a value is used."""
    deep: set[int]
    """Nodes far above their leaves that are not yet written: they are written first, so that nothing recurses far."""
    stage_of: dict[int, int]
    """By the node's number, the stage in which a value is computed."""


def usage_of(outputs: Iterable[Node], decided: int = 0) -> Usage:
    """Return how outputs use the values that they need; each robot's choice is known from stage `decided` on."""
    outputs = list(outputs)
    nodes = needed(outputs)
    counts = Counter(operand.number for node in nodes for operand in node.operands)
    counts.update(node.number for node in outputs)
    return Usage(counts, _deep(nodes), stages_of(outputs, decided))


@dataclass(slots=True)
class Emitter:
    """A writer that computes each value in the block that its level and stage say."""

    namer: Namer
    loops: Loops
    """The source of operations on robots, and of values that cross from one stage to another."""
    leaf: Callable[[Node], Text]
    """The source of a slot, a constant or the step."""
    key: Text
    """The lane's key."""
    step: Text
    """The step's number, for draws."""
    hints: Mapping[int, str]
    """Names for nodes that mean something to the designer."""
    blocks: Blocks
    used: set[str]
    """Functions of the kernel that the source calls; the emitter adds to them."""
    usage: Usage

    @property
    def stage_of(self) -> Mapping[int, int]:
        """By the node's number, the stage in which a value is computed."""
        return self.usage.stage_of

    def text(self, node: Node, into: Block) -> Text:
        """Return the source of a value; what it needs is written into the blocks first."""
        self._write_deep(node, into)
        return self._text(node, into)

    def repeatable(self, node: Node, into: Block, name: str | None = None) -> Text:
        """Return a source of a value that may be written again and again: a name, which is given if it has none.

        The name is the designer's where none is given. Literals and values that are stored in arrays have no name.
        """
        if node.literal or node.operation in LEAF | STORED_AT_ONCE:
            return self.text(node, into)
        self._write_deep(node, into)
        return self._define(node, name or self.hints.get(node.number), into)

    def copy(self, node: Node, name: str, now: Block, later: Block) -> Text:
        """Return a name in a later block for what a slot holds now; the slot may hold something else then."""
        name = self.namer(name)
        copy = now.define(name, self.text(node, now), node.kind)
        if later is not now:
            later.read_from(self.loops.kept(name, node, now), name)
        return copy

    def call(self, function: str, *arguments: Text) -> Text:
        """Return the source of a call of a kernel's function, or of a built-in one."""
        if function != "abs":
            self.used.add(function)
        return call(function, arguments)

    def _home(self, node: Node, into: Block) -> Block:
        """Return the block in which a value that another block needs gets its name."""
        match node.level:
            case Level.CALL:
                return self.blocks.call
            case Level.STEP:
                return self.blocks.step
            case Level.ROBOT:
                return self.blocks.robot(into.stage)
            case Level.PAIR:
                return into
        return self.blocks.stage(self.stage_of.get(node.number, 0))

    def _write_deep(self, node: Node, into: Block) -> None:
        """Name the deep values that a value needs, the lowest first, so that nothing recurses far."""
        deep = self.usage.deep
        if not deep:
            return
        # Of what a loop over pairs computes, a value in another such loop is reached by no way but its array.
        of_this_loop = (
            {inner.number for inner in nodes_of_pairs([node])} if into.level is Level.PAIR else set[int]()
        )
        for operand in needed(node.operands):
            if operand.number in deep and (operand.number in of_this_loop or _is_reachable(operand, into)):
                self._write(operand, self._home(operand, into))
                deep.remove(operand.number)

    def _write(self, node: Node, home: Block) -> None:
        if node.operation in STORED_AT_ONCE:
            self.loops.stored_at_once(node, self)
        else:
            self._define(node, self.hints.get(node.number), home)

    def _text(self, node: Node, into: Block) -> Text:
        if node.literal:
            return literal_text(node)
        if node.operation in LEAF:
            return self.leaf(node)
        if node.operation in STORED_AT_ONCE:
            return self.loops.stored_at_once(node, self)
        if (
            node.operation in CROSSING
            and node.operands[0].operation in STORED_BEFORE
            and node.level is into.level
        ):
            return self.loops.text(node, into, self)
        home = self._home(node, into)
        if node.number in home.names or node.number in into.names:
            return self._define(node, None, into)
        worth_a_name = (
            node.number in self.hints or self.usage.counts[node.number] > 1 or home.level < into.level
        )
        if worth_a_name or node.operation in EXPENSIVE | CROSSING:
            return self._define(node, self.hints.get(node.number), into)
        text = self._operation(node, into)
        return text if len(text.source) <= LONGEST_TEXT else self._define(node, None, into)

    def _define(self, node: Node, name: str | None, into: Block) -> Text:
        """Return the name of a value: it is written where it belongs, and kept from there if another stage needs it."""
        home = self._home(node, into)
        if node.number not in home.names:
            text = self._operation(node, home)
            name = self.namer(name) if name else self.namer.numbered(STEMS.get(node.level, "part"))
            home.define(name, text, node.kind, node)
        return self._reached(node, home, into)

    def _reached(self, node: Node, home: Block, into: Block) -> Text:
        """Return the name under which a block reads a value that another one computes."""
        name = home.names[node.number]
        if home.level in (Level.LANE, Level.EACH) and home is not into and name not in into.read:
            into.read_from(self.loops.kept(name, node, home), name, node)
        return name_text(name)

    def _operation(self, node: Node, into: Block) -> Text:
        operation, operands = node.operation, node.operands
        if operation in BINDING:
            left, right = (self._text(operand, into) for operand in operands)
            return infix(operation, left, right)
        match operation:
            case "negate":
                operand = self._text(operands[0], into)
                return operand._replace(source=f"-{grouped(operand, ATOM)}", binds=SIGN)
            case "not":
                binds = ATOM if operands[0].operation in LEAF | STORED_AT_ONCE else COMPARISON
                operand = self._text(operands[0], into)
                return operand._replace(source=f"not {grouped(operand, binds)}", binds=LOWEST)
            case "outside":
                return self.leaf(node)
            case "draw":
                return self._draw(node, into)
            case "gather":
                return self._gather(node, into)
            case "element":
                return self._element(node, into)
            case "same_place":
                one, other = (self.clamped(operand, node.index, into) for operand in operands)
                return infix("==", one, other)
            case "table" | "pick" | "of" | "other" | "theirs" | "so_far":
                return self.loops.text(node, into, self)
        arguments = [self._text(operand, into) for operand in operands]
        return self.call(operation, *arguments, *_data(node))

    def _draw(self, node: Node, into: Block) -> Text:
        draw = node.data if isinstance(node.data, RobotDraws) else node.draw
        if isinstance(draw, RobotDraws):
            block, text = self.blocks.robot(into.stage), self.loops.by_robot(map(hex, draw.kernel_words))
        else:
            block, text = self.blocks.step, Text(hex(draw.kernel_word))
        if node.number not in block.names:
            stream = self.call("fold", text, self.call("word_of", self.step))
            block.define(self.namer.numbered("draw"), stream, node=node)
        operands = [self._text(operand, into) for operand in node.operands]
        return self.call(draw.distribution, self.key, name_text(block.names[node.number]), *operands)

    def _gather(self, node: Node, into: Block) -> Text:
        gather = node.data if isinstance(node.data, RobotGathers) else node.gather
        if isinstance(gather, RobotGathers):
            terms = [self.loops.by_robot(map(str, gather.bases))]
        else:
            terms = [Text(str(gather.base))]
        terms += self._steps(node, gather.strides, gather.lengths, into)
        index_text = sum_of(terms)
        return index_text._replace(source=f"constants[{index_text.source}]", binds=ATOM)

    def _element(self, node: Node, into: Block) -> Text:
        function, elements = self.loops.function, node.holding(Elements)
        steps = self._steps(
            node, [stride * function.lanes for stride in elements.strides], elements.lengths, into
        )
        offset = sum_of([Text(str(elements.base * function.lanes)), *steps])
        element = function.in_list(function.slots[elements.slot], offset)
        return as_read(offset._replace(source=element, binds=ATOM), node.kind)

    def _steps(
        self, node: Node, strides: Sequence[int], lengths: Sequence[int], into: Block
    ) -> Iterator[Text]:
        """Yield how far from the first element each of a node's indices leads."""
        for stride, length, index in zip(strides, lengths, node.operands, strict=True):
            yield times(stride, self.clamped(index, length - 1, into))

    def clamped(self, index: Node, last: int, into: Block) -> Text:
        """Return the source of an index from 0 to the last place."""
        if index.literal:
            return Text(str(clamp_index(value_of(index), last)))
        return self.call("clamp_index", self._text(index, into), Text(str(last)))


def emitter_of(
    function: RolloutFunction,
    outputs: Iterable[Node],
    decided: int = 0,
    *,
    step: str = "step",
    hinted: bool = True,
) -> Emitter:
    """Return an emitter of what computes the outputs, with fresh blocks.

    `step` is the source of the step's number; each robot's choice is known from stage `decided` on.
    """
    return Emitter(
        function.namer,
        Loops(function),
        function.leaf,
        Text("key[lane]"),
        Text(step),
        function.hints if hinted else {},
        Blocks(function.call, function.looped),
        function.used,
        usage_of(outputs, decided),
    )


def _deep(nodes: Iterable[Node]) -> set[int]:
    """Return, of nodes with operands first, those that are so many operations above a leaf or another of them."""
    depths: dict[int, int] = {}
    for node in nodes:
        depth = 1 + max((depths[operand.number] for operand in node.operands), default=-1)
        depths[node.number] = depth % DEEPEST
    return {node.number for node in nodes if node.operands and depths[node.number] == 0}


def _is_reachable(node: Node, into: Block) -> bool:
    """Return whether a value that is computed outside a loop over pairs can be written for a block."""
    match node.level:
        case Level.ROBOT:
            return into.level in (Level.ROBOT, Level.EACH, Level.PAIR)
        case Level.PAIR:
            return False
    return True


def _data(node: Node) -> list[Text]:
    return [] if node.data is None else [Text(str(node.data))]
