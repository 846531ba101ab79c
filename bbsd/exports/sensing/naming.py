"""Names in C: the spec's own where C has nothing else under them, each once in its scope."""

from __future__ import annotations

from dataclasses import dataclass, field

from bbsd.exports.c import RESERVED

CALLED = ("copysign", "fabs", "isfinite", "isinf", "isnan", "memcpy", "signbit", "far", "near")
"""Functions that a header calls, and macros of some compilers, in small letters."""


@dataclass(slots=True)
class Namer:
    """Names that no other value of a scope has."""

    taken: set[str] = field(default_factory=lambda: {*RESERVED, *CALLED})

    def __call__(self, name: str) -> str:
        """Take a name and return it, with underscores behind it if something else has it."""
        while name in self.taken:
            name += "_"
        self.taken.add(name)
        return name

    def numbered(self, stem: str) -> str:
        """Return the stem with the first number that is free."""
        number = 1
        while f"{stem}_{number}" in self.taken:
            number += 1
        return self(f"{stem}_{number}")

    def inner(self) -> Namer:
        """Return a namer for a scope within this one."""
        return Namer(set(self.taken))
