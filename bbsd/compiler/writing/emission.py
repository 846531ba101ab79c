"""Nodes to lines of Python: every value once, at the level at which it changes, under a name that a person knows."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.compiler.passes.pairs import of_pairs
from bbsd.compiler.writing.precedence import (
    ATOM,
    COMPARISON,
    LOWEST,
    SIGN,
    Text,
    grouped,
    infix,
    literal_text,
    sum_of,
    times,
)
from bbsd.compiler.writing.schedule import stages
from bbsd.expression.graph import Level, Node, needed
from bbsd.expression.node_data import RobotDraws, RobotGathers
from bbsd.expression.operations import BINDING, EXPENSIVE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from bbsd.compiler.writing.blocks import Block, Blocks
    from bbsd.compiler.writing.looping import Loops
    from bbsd.compiler.writing.naming import Namer

LONGEST = 88
DEEPEST = 50
"""Operations within one another at which a value gets a name, however short its text."""
LEAF = frozenset({"slot", "constant", "step", "start"})
"""Operations that read a value where it stands."""
STANDING = frozenset({"over", "each", "among"})
"""Operations whose value stands in an array as soon as it is computed."""
CROSSING = frozenset({"of", "other", "theirs"})
"""Operations that read what another robot's loop computes."""
STORED = frozenset({"slot", "table", "pick"})
"""What stands somewhere before a step is computed."""
STEMS = {Level.CALL: "fixed", Level.STEP: "now", Level.ROBOT: "its"}
"""Of the names of values that mean nothing to the designer, by how often they change."""


@dataclass(slots=True)
class Emitter:
    """Writes values into the blocks of a function, each where its level and stage say."""

    namer: Namer
    loops: Loops
    """What is special where there are loops over robots, and how values cross from one stage to another."""
    leaf: Callable[[Node], Text]
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
        """Of all that the outputs need see how often it is used, how deep it is and in which stage it belongs.

        What each robot decided is known from stage `decided` on.
        """
        outputs = list(outputs)
        every = needed(outputs)
        self.uses = Counter(operand.number for node in every for operand in node.operands)
        self.uses.update(node.number for node in outputs)
        self.deep = _deep(every)
        self.stage_of = stages(outputs, decided)

    def value(self, node: Node, into: Block) -> str:
        """The source of a value as an operand on its own; what it needs is written into the blocks first."""
        return self.text(node, into)[0]

    def text(self, node: Node, into: Block) -> Text:
        """The same, and how tightly it binds."""
        self._write_deep(node, into)
        return self._text(node, into)

    def named(self, node: Node, wanted: str, into: Block) -> str:
        """A value's source that may be written again and again: its name if it has one, else the one wanted.

        Literals and values that stand in arrays have no name.
        """
        return self.repeatable(node, into, wanted)[0]

    def repeatable(self, node: Node, into: Block, wanted: str | None = None) -> Text:
        """The same, and how tightly it binds; the name is the designer's where none is wanted."""
        if node.literal or node.operation in LEAF | STANDING:
            return self.text(node, into)
        self._write_deep(node, into)
        return self._define(node, wanted or self.hints.get(node.number), into), ATOM

    def copied(self, node: Node, wanted: str, now: Block, later: Block) -> str:
        """A name in a later block for what a slot holds now; the slot may hold something else then."""
        name = self.namer(wanted)
        now.assign(name, self.value(node, now), node.kind)
        if later is not now:
            later.read[name] = self.loops.kept(name, node, now)
        return name

    def _home(self, node: Node, into: Block) -> Block:
        """The block in which a value gets its name, for one that needs it."""
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
        """Name the deep values that a value needs, the lowest first."""
        if not self.deep:
            return
        # Of what a loop over pairs computes, a value in another such loop is reached by no way but its array.
        own = {each.number for each in of_pairs([node])} if into.level is Level.PAIR else set[int]()
        for operand in needed(node.operands):
            if operand.number in self.deep and (operand.number in own or _is_reachable(operand, into)):
                self._write(operand, self._home(operand, into))
                self.deep.remove(operand.number)

    def _write(self, node: Node, home: Block) -> None:
        if node.operation in STANDING:
            self.loops.standing(node, self)
        else:
            self._define(node, self.hints.get(node.number), home)

    def _text(self, node: Node, into: Block) -> Text:
        if node.literal:
            return literal_text(node)
        if node.operation in LEAF:
            return self.leaf(node)
        if node.operation in STANDING:
            return self.loops.standing(node, self)
        if node.operation in CROSSING and node.operands[0].operation in STORED and node.level is into.level:
            return self.loops.text(node, into, self)
        home = self._home(node, into)
        if node.number in home.names or node.number in into.names:
            return self._define(node, None, into), ATOM
        worth_a_name = node.number in self.hints or self.uses[node.number] > 1 or home.level < into.level
        if worth_a_name or node.operation in EXPENSIVE | CROSSING:
            return self._define(node, self.hints.get(node.number), into), ATOM
        text = self._operation(node, into)
        return text if len(text[0]) <= LONGEST else (self._define(node, None, into), ATOM)

    def _define(self, node: Node, wanted: str | None, into: Block) -> str:
        """The name of a value: it is written where it belongs, and kept from there if another stage needs it."""
        home = self._home(node, into)
        if node.number not in home.names:
            text, _ = self._operation(node, home)
            name = self.namer(wanted) if wanted else self.namer.numbered(STEMS.get(node.level, "part"))
            home.assign(name, text, node.kind)
            home.names[node.number] = name
        return self._reached(node, home, into)

    def _reached(self, node: Node, home: Block, into: Block) -> str:
        """The name under which a block reads a value that another one computed."""
        name = home.names[node.number]
        if home.level in (Level.LANE, Level.EACH) and home is not into and name not in into.read:
            into.read[name] = self.loops.kept(name, node, home)
            into.names[node.number] = name
        return name

    def _operation(self, node: Node, into: Block) -> Text:
        operation, operands = node.operation, node.operands
        if operation in BINDING:
            left, right = (self._text(operand, into) for operand in operands)
            return infix(operation, left, right)
        match operation:
            case "negate":
                return f"-{grouped(self._text(operands[0], into), ATOM)}", SIGN
            case "not":
                binds = ATOM if operands[0].operation in LEAF | STANDING else COMPARISON
                return f"not {grouped(self._text(operands[0], into), binds)}", LOWEST
            case "draw":
                return self._draw(node, into), ATOM
            case "gather":
                return self._gather(node, into), ATOM
            case "table" | "pick" | "of" | "other" | "theirs" | "so_far":
                return self.loops.text(node, into, self)
        arguments = [self._text(operand, into)[0] for operand in operands]
        return self.call(operation, [*arguments, *_data(node)]), ATOM

    def call(self, function: str, arguments: Iterable[str]) -> str:
        """The source of a call of a kernel's function, or of a built-in one."""
        if function != "abs":
            self.used.add(function)
        return f"{function}({', '.join(arguments)})"

    def _draw(self, node: Node, into: Block) -> str:
        draw = node.data if isinstance(node.data, RobotDraws) else node.draw
        if isinstance(draw, RobotDraws):
            block, text = self.blocks.robot(into.stage), self.loops.by_robot(map(hex, draw.kernel_words))
        else:
            block, text = self.blocks.step, hex(draw.kernel_word)
        if node.number not in block.names:
            block.names[node.number] = self.namer.numbered("draw")
            stream = self.call("fold", [text, self.call("word_of", [self.step])])
            block.lines.append(f"{block.names[node.number]} = {stream}")
        operands = [self._text(operand, into)[0] for operand in node.operands]
        return self.call(draw.distribution, [self.key, block.names[node.number], *operands])

    def _gather(self, node: Node, into: Block) -> str:
        gather = node.data if isinstance(node.data, RobotGathers) else node.gather
        if isinstance(gather, RobotGathers):
            terms = [(self.loops.by_robot(map(str, gather.bases)), ATOM)]
        else:
            terms = [(str(gather.base), ATOM)]
        for stride, length, index in zip(gather.strides, gather.lengths, node.operands, strict=True):
            place = self.call("clamp_index", [self._text(index, into)[0], str(length - 1)])
            terms.append(times(stride, (place, ATOM)))
        return f"constants[{sum_of(terms)[0]}]"


def _deep(nodes: Iterable[Node]) -> set[int]:
    """Of nodes, operands first, those that are so many operations above a leaf or another of them."""
    depths: dict[int, int] = {}
    for node in nodes:
        depth = 1 + max((depths[operand.number] for operand in node.operands), default=-1)
        depths[node.number] = depth % DEEPEST
    return {node.number for node in nodes if node.operands and depths[node.number] == 0}


def _is_reachable(node: Node, into: Block) -> bool:
    """Whether a value that is computed outside a loop over pairs can be written for a block."""
    match node.level:
        case Level.ROBOT:
            return into.level in (Level.ROBOT, Level.EACH, Level.PAIR)
        case Level.PAIR:
            return False
    return True


def _data(node: Node) -> list[str]:
    return [] if node.data is None else [str(node.data)]
