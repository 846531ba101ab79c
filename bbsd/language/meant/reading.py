"""A spec's data on the way to what is meant: what was told of them, and where in the file what was moved stands."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY, Mistake
from bbsd.language.validation import child
from bbsd.text.nodes import Mapping, Scalar

if TYPE_CHECKING:
    import re
    from collections.abc import Sequence

    from bbsd.errors import Correction
    from bbsd.expression.scope import Path
    from bbsd.expression.syntax.mistakes import Rewriting
    from bbsd.expression.syntax.tree import Span
    from bbsd.language.lineage import Lineage
    from bbsd.language.validation import LocatedMistake
    from bbsd.text import Data, Document
    from bbsd.text.nodes import Node


@dataclass(slots=True)
class Reading:
    """Data that are changed to what is meant; paths are those of the data as they are now."""

    data: dict[str, Data]
    files: Lineage
    told: list[LocatedMistake] = field(default_factory=list)
    explained: set[Path] = field(default_factory=set)
    """Paths in the file below which what YAML's reading told is explained."""
    _moves: list[tuple[Path, Path]] = field(default_factory=list)

    @classmethod
    def of(cls, data: dict[str, Data], files: Lineage) -> Reading:
        """Begin with a copy of the data."""
        return cls(deepcopy(data), files)

    def origin(self, path: Path) -> Path:
        """Return where in the file a path of the data stands."""
        for new, old in reversed(self._moves):
            if path[: len(new)] == new:
                path = (*old, *path[len(new) :])
        return path

    def at(self, path: Path) -> Data:
        """Return the data at a path, None where there are none."""
        value: Data = self.data
        for segment in path:
            value = child(value, segment)
        return value

    def mapping(self, path: Path) -> dict[str, Data]:
        """Return the mapping at a path; an empty one, which is not part of the data, where there is none."""
        value = self.at(path)
        return value if isinstance(value, dict) else {}

    def has(self, word: re.Pattern[str]) -> bool:
        """Return whether a word stands in a text somewhere, keys aside."""
        return _has(self.data, word)

    def document(self, path: Path) -> Document:
        """Return the file in which a path stands."""
        return self.files.document(self.origin(path))

    def node(self, path: Path) -> Node | None:
        """Return the node at a path of the data."""
        return self.document(path).node(self.origin(path))

    def key(self, path: Path) -> Scalar | None:
        """Return the key at the end of a path, if it begins a line of its own."""
        origin, document = self.origin(path), self.document(path)
        parent = document.node(origin[:-1])
        if not isinstance(parent, Mapping) or parent.flow or str(origin[-1]) not in parent.entries:
            return None
        return parent.entries[str(origin[-1])].key

    def tell(
        self,
        path: Path,
        code: str,
        message: str,
        advice: str = "",
        correction: Rewriting | Correction | None = None,
        span: Span = KEY,
        seen_at: tuple[Path, ...] = (),
    ) -> None:
        """Tell a mistake at a path of the data; `seen_at` are paths of what it speaks of."""
        self.told.append((self.origin(path), Mistake(code, message, span, advice, correction, seen_at)))

    def set(self, path: Path, value: Data) -> None:
        """Put a value at a path, whose parent is there."""
        parent = self.at(path[:-1])
        if isinstance(parent, dict):
            parent[str(path[-1])] = value
        elif isinstance(parent, list):
            parent[int(path[-1])] = value

    def remove(self, path: Path) -> None:
        """Take away the entry of a mapping."""
        self.mapping(path[:-1]).pop(str(path[-1]), None)

    def move(self, old: Path, new: Path) -> None:
        """Move a value; a mapping that it goes into and that is not there is made."""
        value = self.at(old)
        self.remove(old)
        for length in range(1, len(new)):
            if self.at(new[:length]) is None:
                self.set(new[:length], {})
        self.set(new, value)
        self._moves.append((new, old))

    def rename(self, path: Path, key: str) -> None:
        """Give an entry of a mapping another key, at its place."""
        parent, old = self.mapping(path[:-1]), str(path[-1])
        entries = [(key if each == old else each, value) for each, value in parent.items()]
        parent.clear()
        parent.update(entries)
        self._moves.append(((*path[:-1], key), path))

    def replace(self, path: Path, value: Data, parts: Sequence[tuple[Path, Path]] = ()) -> None:
        """Put another value at a path; `parts` are paths below it now, and below it before."""
        self.set(path, value)
        # The places of parts are looked up in the file as it was, before those of other moves.
        for new, old in parts:
            self._moves.append(((*path, *new), (*path, *old)))


def _has(data: Data, word: re.Pattern[str]) -> bool:
    if isinstance(data, dict):
        return any(_has(value, word) for value in data.values())
    if isinstance(data, list):
        return any(_has(item, word) for item in data)
    return isinstance(data, str) and word.search(data) is not None
