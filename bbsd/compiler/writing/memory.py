"""The memory of a rollout: arrays with an element for every lane, kept from step to step and from loop to loop.

They lie in one piece of memory that the caller gives, the team's before the robots': few pieces, so that LLVM has few
ranges to compare before it vectorizes a loop. The values of one robot lie together, `stride` numbers from those of the
next, so a loop over the lanes of one robot certainly does not overwrite what it reads of another one.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from bbsd.expression.kinds import Kind


@dataclass(slots=True)
class Memory:
    """The names of all arrays, in the order in which they lie in memory."""

    numbers: list[str] = field(default_factory=list)
    integers: list[str] = field(default_factory=list)
    own_numbers: list[str] = field(default_factory=list)
    own_integers: list[str] = field(default_factory=list)
    """The arrays with values of each robot, where there are loops over robots."""

    def add(self, name: str, kind: Kind, *, own: bool) -> str:
        """Add an array and return its name; truths are kept as the numbers 0 and 1."""
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
        return (1 + len(self.numbers) + len(self.integers)) * lanes

    def size(self, lanes: int, robots: int) -> int:
        """Return how many numbers all arrays take."""
        return self.team_size(lanes) + (len(self.own_numbers) + len(self.own_integers)) * lanes * robots

    def lines(self, lanes: int) -> list[str]:
        """Return the lines that set up the team's arrays."""
        arrays = [("key", "streams"), *_views("", self.numbers, self.integers)]
        return [
            "streams = as_words(numbers)",
            *(["cells = as_integers(numbers)"] if self.integers else []),
            *(f"{name} = part({view}, {k * lanes}, {lanes})" for k, (name, view) in enumerate(arrays)),
        ]

    def own_lines(self, lanes: int, robots: int) -> list[str]:
        """Return the lines that set up the robots' arrays, behind the team's; each begins with the first robot."""
        arrays = _views("own_", self.own_numbers, self.own_integers)
        stride = len(arrays) * lanes
        size = stride * robots
        return [
            f"stride = {stride}",
            f"own_numbers = part(numbers, {self.team_size(lanes)}, {size})",
            *(["own_cells = as_integers(own_numbers)"] if self.own_integers else []),
            *(
                f"{name} = part({view}, {k * lanes}, {size - k * lanes})"
                for k, (name, view) in enumerate(arrays)
            ),
        ]


def _views(prefix: str, numbers: list[str], integers: list[str]) -> list[tuple[str, str]]:
    """Return arrays with the view of the memory that each is a part of."""
    return [
        *((name, f"{prefix}numbers") for name in numbers),
        *((name, f"{prefix}cells") for name in integers),
    ]
