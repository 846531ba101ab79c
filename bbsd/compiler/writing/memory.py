"""The memory of a rollout: arrays with an element for every lane, kept from step to step and from loop to loop.

They lie in one piece of memory that the caller gives, the team's before the robots': few pieces, so that LLVM has few
ranges to compare before it vectorizes a loop. The values of one robot lie together, `stride` numbers from those of the
next, so a loop over the lanes of one robot certainly does not overwrite what it reads of another one.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import accumulate

from bbsd.expression.kinds import Kind


@dataclass(slots=True)
class Memory:
    """The names of all arrays, in the order in which they lie in memory."""

    numbers: list[str] = field(default_factory=list)
    integers: list[str] = field(default_factory=list)
    own_numbers: list[str] = field(default_factory=list)
    own_integers: list[str] = field(default_factory=list)
    """The arrays with values of each robot, where there are loops over robots."""
    lengths: dict[str, int] = field(default_factory=dict)
    """Of arrays that keep lists, how many elements they have for every lane."""

    def add(self, name: str, kind: Kind, *, own: bool, length: int = 1) -> str:
        """Add an array and return its name; truths are kept as the numbers 0 and 1."""
        if length > 1:
            self.lengths[name] = length
        if kind is Kind.CELL:
            (self.own_integers if own else self.integers).append(name)
        else:
            (self.own_numbers if own else self.numbers).append(name)
        return name

    def is_own(self, name: str) -> bool:
        """Return whether an array holds a value of each robot."""
        return name in self.own_numbers or name in self.own_integers

    @property
    def names(self) -> list[str]:
        """The names of all arrays."""
        return [*self.numbers, *self.integers, *self.own_numbers, *self.own_integers]

    @property
    def functions(self) -> set[str]:
        """The functions of the kernel that the lines call."""
        return {"part", "as_words", *(["as_integers"] if self.integers or self.own_integers else [])}

    def team_size(self, lanes: int) -> int:
        """Return how many numbers the team's arrays take."""
        return (1 + self._length(self.numbers) + self._length(self.integers)) * lanes

    def size(self, lanes: int, robots: int) -> int:
        """Return how many numbers all arrays take."""
        own = self._length(self.own_numbers) + self._length(self.own_integers)
        return self.team_size(lanes) + own * lanes * robots

    def _length(self, names: list[str]) -> int:
        return sum(map(self.length_of, names))

    def length_of(self, name: str) -> int:
        """Return how many elements an array has for every lane: 1 where it keeps no list."""
        return self.lengths.get(name, 1)

    def _placed(self, arrays: list[tuple[str, str]]) -> list[tuple[str, str, int, int]]:
        """Return arrays, each with its view, how many of a lane's values stand before its own, and how many it has."""
        lengths = [self.length_of(name) for name, _ in arrays]
        before = accumulate(lengths, initial=0)
        return [
            (name, view, place, length)
            for (name, view), place, length in zip(arrays, before, lengths, strict=False)
        ]

    def lines(self, lanes: int) -> list[str]:
        """Return the lines that set up the team's arrays."""
        arrays = [("key", "streams"), *_views("", self.numbers, self.integers)]
        return [
            "streams = as_words(numbers)",
            *(["cells = as_integers(numbers)"] if self.integers else []),
            *(
                f"{name} = part({view}, {before * lanes}, {length * lanes})"
                for name, view, before, length in self._placed(arrays)
            ),
        ]

    def own_lines(self, lanes: int, robots: int) -> list[str]:
        """Return the lines that set up the robots' arrays, behind the team's; each begins with the first robot."""
        arrays = _views("own_", self.own_numbers, self.own_integers)
        stride = (self._length(self.own_numbers) + self._length(self.own_integers)) * lanes
        size = stride * robots
        return [
            f"stride = {stride}",
            f"own_numbers = part(numbers, {self.team_size(lanes)}, {size})",
            *(["own_cells = as_integers(own_numbers)"] if self.own_integers else []),
            *(
                f"{name} = part({view}, {before * lanes}, {size - before * lanes})"
                for name, view, before, _ in self._placed(arrays)
            ),
        ]


def _views(prefix: str, numbers: list[str], integers: list[str]) -> list[tuple[str, str]]:
    """Return arrays with the view of the memory that each is a part of."""
    return [
        *((name, f"{prefix}numbers") for name in numbers),
        *((name, f"{prefix}cells") for name in integers),
    ]
