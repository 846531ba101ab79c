"""The data of nodes: what a literal, a slot, a draw or an element of the constants is, besides its operands."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, TypeVar

from bbsd.kernel.functions import clamp_index

if TYPE_CHECKING:
    from collections.abc import Sequence

T = TypeVar("T")

TOP_BIT = 1 << 63  # a literal from here on is uint64 in compiled code

Variable = tuple[str, tuple[int, ...]]
"""What all robots have a slot of: a name, and the place in a list."""


def variable_text(variable: Variable) -> str:
    """Return what people call a value, or an element of a list: `waiting[2]`."""
    name, place = variable
    return name + "".join(f"[{index}]" for index in place)


class Literal(NamedTuple):
    """A number, a truth or a cell index, written in the node itself."""

    value: float
    tag: str
    """Tells apart values that Python calls equal: both zeros, numbers from truths and cells."""


HIDDEN = "_"
"""How the names of slots begin that are not the spec's own: no name of a spec begins so."""


class Slot(NamedTuple):
    """A value that is kept from one step to the next: a name, the robot (None: the world's), the place in a list."""

    name: str
    robot: int | None = None
    place: tuple[int, ...] = ()

    @property
    def variable(self) -> Variable:
        """The name and the place, whichever robot's."""
        return self.name, self.place

    @property
    def is_hidden(self) -> bool:
        """Whether the value is no one's of the spec, so that no trace shows it."""
        return self.name.startswith(HIDDEN)

    def label(self, robots: int) -> str:
        """Return what people call the slot: `height_0` with several robots, `sonar[3]` for an element."""
        name = self.name if self.robot is None or robots == 1 else f"{self.name}_{self.robot}"
        return variable_text((name, self.place))

    def text(self, robots: int) -> str:
        """Return the slot's name in kernels: `height_0` with several robots, `sonar_3` for an element."""
        robot = [self.robot] if self.robot is not None and robots > 1 else []
        return "_".join([self.name, *(str(part) for part in (*robot, *self.place))])


class Draw(NamedTuple):
    """A draw from a distribution; the word names the stream that is drawn from."""

    distribution: str
    word: int

    @property
    def kernel_word(self) -> int:
        """The word as kernels fold it."""
        return self.word | TOP_BIT


class Gather(NamedTuple):
    """An element of the constants: it stands at `base + sum(stride * index)`, each index clamped to its length."""

    base: int
    strides: tuple[int, ...]
    lengths: tuple[int, ...]

    def read(self, constants: Sequence[T], indices: Sequence[float]) -> T:
        """Return the element of a sequence of constants at some indices."""
        clamped = [
            clamp_index(index, length - 1) for index, length in zip(indices, self.lengths, strict=True)
        ]
        return constants[
            self.base + sum(stride * index for stride, index in zip(self.strides, clamped, strict=True))
        ]

    @property
    def places(self) -> list[int]:
        """All places in the constants that may be read."""
        places = [self.base]
        for stride, length in zip(self.strides, self.lengths, strict=True):
            places = [place + stride * index for place in places for index in range(length)]
        return places


# --- Where a kernel loops over robots (`compiler.passes.robot_graph`)


class RobotDraws(NamedTuple):
    """A draw of each robot, by a word for each."""

    distribution: str
    words: tuple[int, ...]

    @property
    def kernel_words(self) -> tuple[int, ...]:
        """The words as kernels fold them."""
        return tuple(word | TOP_BIT for word in self.words)


class RobotGathers(NamedTuple):
    """An element of the constants for each robot, from a base for each."""

    bases: tuple[int, ...]
    strides: tuple[int, ...]
    lengths: tuple[int, ...]


class RobotLiterals(tuple[Literal, ...]):
    """A literal for each robot."""

    __slots__ = ()


class RobotIndices(tuple[int, ...]):
    """An index for each robot: of another robot, or of a constant."""

    __slots__ = ()


class PairFolds(NamedTuple):
    """Folds that one loop over pairs of robots computes, by their numbers; the first one's value is the node's."""

    others: bool
    """Whether each robot looks at the others, else at all of the team."""
    numbers: tuple[int, ...]


# --- Where a kernel keeps a list of state in one array (`compiler.passes.list_arrays`)


class Elements(NamedTuple):
    """An element of a list of state: it stands at `base + sum(stride * index)`, each index clamped to its length."""

    slot: Slot
    """The list, without a place."""
    own: bool
    """Whether a loop over robots has a list for each."""
    base: int
    strides: tuple[int, ...]
    lengths: tuple[int, ...]


class ListShape(NamedTuple):
    """How many elements a list of state has, dimension by dimension."""

    lengths: tuple[int, ...]


NodeData = (
    None
    | int
    | str
    | Literal
    | Slot
    | Draw
    | Gather
    | RobotDraws
    | RobotGathers
    | RobotLiterals
    | RobotIndices
    | PairFolds
    | Elements
    | ListShape
)
"""None where the operation and its operands say all; an int is a place in the constants, a robot, an exponent or a
fold's number, a str an operation to fold by."""
