"""The names of a partition's cells."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import overload

Labels = Sequence[str]
"""A partition's cells by name, in order."""

WHOLE = re.compile(r"0|-?[1-9][0-9]{0,17}")


@dataclass(frozen=True, slots=True)
class Numbers(Sequence[str]):
    """The cells of `values(e, first, last)`: the numbers, written when they are asked for, as there may be many."""

    first: int
    last: int

    def __len__(self) -> int:
        """Return how many there are."""
        return self.last - self.first + 1

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[str, ...]: ...
    def __getitem__(self, index: int | slice) -> str | tuple[str, ...]:
        """Return a cell's name, or several."""
        found = range(self.first, self.last + 1)[index]
        return tuple(map(str, found)) if isinstance(found, range) else str(found)

    def __contains__(self, label: object) -> bool:
        """Say whether a text is one of the cells' names."""
        return (
            isinstance(label, str)
            and WHOLE.fullmatch(label) is not None
            and self.first <= int(label) <= self.last
        )

    def index(self, label: str, start: int = 0, stop: int | None = None) -> int:
        """Return which cell has that name; raises ValueError if none from `start` up to `stop` has."""
        if label in self and (place := int(label) - self.first) in range(len(self))[start:stop]:
            return place
        raise ValueError(f"{label!r} is not a cell")
