"""A text as it was read: its data, its mistakes, and the place of every value."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from bbsd.text.nodes import Alias, Mapping, Scalar, child, data_of
from bbsd.text.offsets import source_offsets

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.errors import Diagnosis, Place
    from bbsd.text.nodes import Data, DataPath, Node
    from bbsd.text.source import Source


@dataclass(frozen=True)
class Document:
    """The content of a text as far as it could be read; `root` is None where it could not."""

    source: Source
    root: Mapping | None
    diagnoses: tuple[Diagnosis, ...]

    @cached_property
    def data(self) -> dict[str, Data]:
        """The data as plain values, aliases expanded; empty where the text could not be read."""
        data = data_of(self.root) if self.root else {}
        return data if isinstance(data, dict) else {}

    def node(self, path: DataPath) -> Node | None:
        """Return the node at a path of keys and indices, None if there is none."""
        node: Node | None = self.root
        for segment in path:
            node = None if node is None else child(node, segment)
        return node

    def holds(self, path: DataPath) -> bool:
        """Say whether there is a value at a path of keys and indices."""
        return self.node(path) is not None

    def place(
        self, path: DataPath, offset: int | None = None, on_key: bool = False, length: int = 1
    ) -> Place:
        """Return the place of the value at a path of keys and indices, or of its key.

        Segments that name nothing are skipped, such as the names of unions in pydantic's errors; where the last one
        names nothing, or no value is written, the place is that of the key that the path leads to. With an offset it
        is the place of that character of the value's (or key's) text, wherever folding, quotes and escapes put it.
        Without one, the place of a single value covers all of it on its first line.
        """
        if self.root is None:
            return self.source.place(0)
        key, node, is_found = _find(self.root, path)
        if not on_key and (not is_found or (isinstance(node, Scalar) and node.is_unwritten)):
            return self._whole(key)
        marked = key if on_key else node
        scalar = marked.target if isinstance(marked, Alias) else marked
        if offset is None or not isinstance(scalar, Scalar):
            return self._whole(marked)
        return self._inside(scalar, offset, length)

    def stretch(
        self, path: DataPath, offset: int | None = None, length: int = 0, on_key: bool = False
    ) -> tuple[int, int] | None:
        """Return where in the text characters of a value (or its key) stand, or all of it.

        None where it is not written there: where an alias repeats it, it stands elsewhere.
        """
        if self.root is None:
            return None
        key, node, is_found = _find(self.root, path)
        marked = key if on_key else node
        if not is_found or isinstance(marked, Alias):
            return None
        if offset is None or not isinstance(marked, Scalar):
            return marked.start, marked.end
        offsets = source_offsets(self.source.text, marked)
        if offset + length >= len(offsets):
            return None if offset + length > len(offsets) else (offsets[offset], offsets[-1])
        if length and not marked.style:
            return offsets[offset], offsets[offset + length - 1] + 1
        return offsets[offset], offsets[offset + length]

    def _whole(self, node: Node) -> Place:
        return self.source.place(node.start, node.end if isinstance(node, Scalar | Alias) else None)

    @cached_property
    def _offsets(self) -> dict[int, list[int]]:
        """The offsets of scalars' characters by the scalar's start, kept since one scalar may have many mistakes."""
        return {}

    def _inside(self, scalar: Scalar, offset: int, length: int) -> Place:
        if scalar.start not in self._offsets:
            self._offsets[scalar.start] = source_offsets(self.source.text, scalar)
        offsets = self._offsets[scalar.start]
        first = min(max(offset, 0), len(offsets) - 1)
        last = min(first + length - 1, len(offsets) - 1)
        return self.source.place(offsets[first], offsets[last] + 1)


def _find(root: Mapping, path: Iterable[str | int]) -> tuple[Node, Node, bool]:
    """Return the key and the value that a path leads to, and whether its last segment was found.

    An item of a list and the whole document have no key; they are returned as their own.
    """
    key: Node = root
    node: Node = root
    is_found = True
    for segment in path:
        value = child(node, segment)
        is_found = value is not None
        if value is not None:
            key, node = _key(node, segment) or value, value
    return key, node, is_found


def _key(node: Node, segment: str | int) -> Node | None:
    mapping = node.target if isinstance(node, Alias) else node
    return mapping.entries[str(segment)].key if isinstance(mapping, Mapping) else None
