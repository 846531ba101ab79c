"""Names in a kernel's source: the spec's own where possible, each once."""

from __future__ import annotations

import keyword
from dataclasses import dataclass, field

from bbsd.kernel import functions, memory, streams

OWN = (
    "np", "lane", "lanes", "base", "step", "steps", "first", "last", "keys", "key", "individuals", "packed_tables",
    "tables", "table_offsets", "priorities", "constants", "returns", "credit", "terms", "control", "steps_taken",
    "not_finite", "expectations_met", "record", "running", "rollout", "numbers", "cells", "streams", "own",
    "own_numbers", "own_cells", "stride", "robot", "pair", "other", "theirs",
    "abs", "float", "int", "range",
)  # fmt: skip
"""What a rollout itself uses: arguments, variables, built-in functions."""

CALLED = {
    name for module in (functions, memory, streams) for name, value in vars(module).items() if callable(value)
}
TAKEN = CALLED.union(OWN, keyword.kwlist)


@dataclass(slots=True)
class Namer:
    """Gives out names that are not taken yet."""

    taken: set[str] = field(default_factory=lambda: set(TAKEN))

    def __call__(self, wanted: str) -> str:
        """The name wanted, with underscores behind it if something else has it."""
        while wanted in self.taken:
            wanted += "_"
        self.taken.add(wanted)
        return wanted

    def numbered(self, stem: str) -> str:
        """The stem with the first number that is free."""
        number = 1
        while f"{stem}_{number}" in self.taken:
            number += 1
        return self(f"{stem}_{number}")
