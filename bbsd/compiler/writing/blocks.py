"""Statements of a kernel, sorted into the blocks that its loops are made of."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple, Protocol

from bbsd.compiler.writing.precedence import NO_NAMES, Text, name_text
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.expression.graph import Node


class Assignment(NamedTuple):
    """A statement that gives a name to a value, or stores the value in an element of an array."""

    target: str
    text: Text
    kind: Kind = Kind.NUMBER
    """The kind of the value."""
    is_definition: bool = False
    """Whether the target is a name."""

    @property
    def line(self) -> str:
        """The line of source."""
        return f"{self.target} = {self.text.source}"

    @property
    def uses(self) -> frozenset[str]:
        """The local names that it uses."""
        return self.text.uses

    @property
    def is_expensive(self) -> bool:
        """Whether it calls a function that takes long."""
        return self.text.expensive

    @property
    def starts_phase(self) -> bool:
        """Whether a new phase of a step begins here: only comments say so."""
        return False


class Comment(NamedTuple):
    """A comment between statements."""

    words: str
    starts_phase: bool = False
    """Whether a new phase of a step begins here, before which a loop may be cut."""

    @property
    def line(self) -> str:
        """The line of source."""
        return f"# {self.words}"

    @property
    def uses(self) -> frozenset[str]:
        """The local names that it uses: none."""
        return NO_NAMES

    @property
    def is_expensive(self) -> bool:
        """Whether it takes long: never."""
        return False


Statement = Assignment | Comment


def definitions_of(statements: Sequence[Statement]) -> list[Assignment]:
    """Return the statements that give a name to a value."""
    return [each for each in statements if isinstance(each, Assignment) and each.is_definition]


@dataclass(slots=True)
class Block:
    """The statements of one level and stage, and the names of the nodes that are known there.

    Others only add to it, by its methods.
    """

    level: Level
    stage: int = 0
    before: list[Assignment] = field(default_factory=list)
    """Definitions once for all lanes, before the loop over them."""
    statements: list[Statement] = field(default_factory=list)
    after: list[Assignment] = field(default_factory=list)
    """Stores after all other statements."""
    names: dict[int, str] = field(default_factory=dict)
    """By the node's number, the name that its value has in the block."""
    read: dict[str, str] = field(default_factory=dict)
    """By the names of values that other blocks compute, the elements of arrays that they are read from."""
    kept: dict[str, str] = field(default_factory=dict)
    """By the names of values that other blocks need, the arrays that they are stored in."""
    robots_seen: set[str] = field(default_factory=set)
    """The names of the offsets at which the values of other robots begin."""

    def define(self, name: str, text: Text, kind: Kind = Kind.NUMBER, node: Node | None = None) -> Text:
        """Give a name to a value, which is that of a node if one is given; return the name as an expression."""
        self.statements.append(Assignment(name, text, kind, is_definition=True))
        if node is not None:
            self.names[node.number] = name
        return name_text(name)

    def define_before(self, name: str, text: Text, node: Node) -> None:
        """Give a name to a node's value that is the same in all lanes."""
        self.before.append(Assignment(name, text, node.kind, is_definition=True))
        self.names[node.number] = name

    def store(self, element: str, text: Text) -> None:
        """Store a value in an element of an array."""
        self.statements.append(Assignment(element, text))

    def store_after(self, element: str, text: Text) -> None:
        """Store a value after all other statements."""
        self.after.append(Assignment(element, text))

    def see_robot(self, offset: str) -> None:
        """Read values of another robot, which begin at an offset of that name."""
        self.robots_seen.add(offset)

    def comment(self, words: str, *, starts_phase: bool = False) -> None:
        """Write a comment."""
        self.statements.append(Comment(words, starts_phase))

    def read_from(self, element: str, name: str, node: Node | None = None) -> None:
        """Read a value, which is that of a node if one is given, that another block computes under a name."""
        self.read[name] = element
        if node is not None:
            self.names[node.number] = name

    def keep_in(self, array: str, name: str) -> None:
        """Store a named value of the block in an array, for other blocks."""
        self.kept[name] = array

    @property
    def definitions(self) -> list[Assignment]:
        """Its statements that give a name to a value."""
        return definitions_of(self.statements)

    @property
    def lines(self) -> list[str]:
        """The lines of source of its statements."""
        return [statement.line for statement in self.statements]


class Stage(NamedTuple):
    """A stage of a step."""

    block: Block
    """What is computed in each lane."""
    robot: Block | None
    """What is computed once a robot, before the lanes."""
    pairs: Mapping[bool, Block]
    """Loops over the other robots (True) or the whole team (False), before the lanes."""

    @property
    def is_empty(self) -> bool:
        """Whether nothing is computed in it."""
        return not self.block.statements and not self.pairs


@dataclass(slots=True)
class Blocks:
    """The blocks of a step: once a call, once a step, and for each stage its loop and what comes before it."""

    call: Block
    looped: bool
    """Whether there are loops over robots: the odd stages."""
    step: Block = field(default_factory=lambda: Block(Level.STEP))
    stages: dict[int, Block] = field(default_factory=dict)
    robots: dict[int, Block] = field(default_factory=dict)
    pairs: dict[tuple[int, bool], Block] = field(default_factory=dict)

    def stage(self, number: int) -> Block:
        """Return the block of a stage."""
        if number not in self.stages:
            self.stages[number] = Block(Level.EACH if self.looped and number % 2 else Level.LANE, number)
        return self.stages[number]

    def robot(self, number: int) -> Block:
        """Return the block of what is computed once a robot, before the lanes of a stage."""
        return self.robots.setdefault(number, Block(Level.ROBOT, number))

    def pair(self, number: int, *, others: bool) -> Block:
        """Return the block of what is computed for every robot that a robot looks at, before the lanes of a stage."""
        self.stage(number)
        return self.pairs.setdefault((number, others), Block(Level.PAIR, number))

    def in_order(self) -> list[Stage]:
        """Return all stages in their order."""
        return [
            Stage(
                self.stages[number],
                self.robots.get(number),
                {others: block for (stage, others), block in self.pairs.items() if stage == number},
            )
            for number in sorted(self.stages)
        ]


class Writer(Protocol):
    """A writer of nodes into blocks: what loops over robots ask of the emitter, which stands above them."""

    @property
    def blocks(self) -> Blocks:
        """The blocks of the step."""

    @property
    def stage_of(self) -> Mapping[int, int]:
        """By the node's number, the stage in which it is computed."""

    @property
    def hints(self) -> Mapping[int, str]:
        """By the node's number, the name that the designer knows it by."""

    def text(self, node: Node, into: Block) -> Text:
        """Return the source of a value; what it needs is written into the blocks first."""

    def repeatable(self, node: Node, into: Block) -> Text:
        """Return a source of a value that may be written again and again."""
