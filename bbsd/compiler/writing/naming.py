"""Names in a kernel's source: the spec's own where possible, each once."""

from __future__ import annotations

import keyword
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.kernel import functions, memory, streams

if TYPE_CHECKING:
    from collections.abc import Iterable

RESERVED = (
    "np", "lane", "lanes", "base", "step", "steps", "first", "last", "keys", "key", "individuals", "packed_tables",
    "tables", "table_offsets", "priorities", "constants", "returns", "credit", "terms", "control", "steps_taken",
    "not_finite", "expectations_met", "record", "open_cells", "rates", "asked", "joint_cells", "gains",
    "running", "rollout", "numbers", "cells", "streams", "own",
    "own_numbers", "own_cells", "stride", "robot", "pair", "other", "theirs",
    "abs", "float", "int", "range",
)  # fmt: skip
"""The names that every rollout uses: arguments, variables, built-in functions."""

CALLED = {
    name for module in (functions, memory, streams) for name, value in vars(module).items() if callable(value)
}
TAKEN = CALLED.union(RESERVED, keyword.kwlist)
PHASED = ("outside", "sent", "chosen", "living")
"""The arguments that the phases of a rollout have besides, in their order."""


@dataclass(slots=True)
class Namer:
    """Names that no other value of a function has."""

    taken: set[str] = field(default_factory=lambda: set(TAKEN))
    numbers: dict[str, int] = field(default_factory=dict)
    """By the stem of numbered names, the last number given out."""

    def __call__(self, name: str) -> str:
        """Take a name and return it, with underscores behind it if something else has it."""
        while name in self.taken:
            name += "_"
        self.taken.add(name)
        return name

    def reserve(self, names: Iterable[str]) -> None:
        """Take names that are given out elsewhere."""
        self.taken.update(names)

    def forget_all_but(self, names: Iterable[str]) -> None:
        """Give out all names again but these and those of every rollout."""
        self.taken = TAKEN.union(names)
        self.numbers.clear()

    def numbered(self, stem: str) -> str:
        """Return the stem with the first number that is free."""
        number = self.numbers.get(stem, 0) + 1
        while f"{stem}_{number}" in self.taken:
            number += 1
        self.numbers[stem] = number
        return self(f"{stem}_{number}")
