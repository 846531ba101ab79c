"""A text that was read: its data, what is wrong with it, and where everything stands."""

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
    """What a text says as far as it could be read; `root` is None where it could not."""

    source: Source
    root: Mapping | None
    diagnoses: tuple[Diagnosis, ...]

    @cached_property
    def data(self) -> dict[str, Data]:
        """The data as plain values, aliases expanded; empty where the text could not be read."""
        data = data_of(self.root) if self.root else {}
        return data if isinstance(data, dict) else {}

    def place(
        self, path: DataPath, offset: int | None = None, on_key: bool = False, length: int | None = None
    ) -> Place:
        """Return the place of the value at a path of keys and indices, or of its key.

        Segments that name nothing are skipped, as the names of unions that a schema reports; where the last one names
        nothing, or there is no value written, it is the key of what was found. With an offset it is the place of that
        character of the value's (or key's) text, wherever folding, quotes and escapes put it. The length is in
        characters of that text; by default all of it, with an offset 1. Values over several lines are marked in the first.
        """
        if self.root is None:
            return self.source.place(0)
        key, node, is_found = _find(self.root, path)
        marked = key if on_key or not is_found or _is_unwritten(node) else node
        scalar = marked.target if isinstance(marked, Alias) and offset is not None else marked
        if isinstance(scalar, Scalar) and (offset is not None or length is not None):
            return self._inside(scalar, offset or 0, length or 1)
        if isinstance(marked, Scalar | Alias):
            return self.source.place(marked.start, marked.end)
        return self.source.place(marked.start)

    def _inside(self, scalar: Scalar, offset: int, length: int) -> Place:
        offsets = source_offsets(self.source.text, scalar)
        first = min(max(offset, 0), len(offsets) - 1)
        last = min(first + length - 1, len(offsets) - 1)
        return self.source.place(offsets[first], offsets[last] + 1)


def _find(root: Mapping, path: Iterable[str | int]) -> tuple[Node, Node, bool]:
    """Return the key and the value that a path leads to, and whether its last segment was found.

    An item of a list, and the whole, stand for their own keys.
    """
    key: Node = root
    node: Node = root
    is_found = True
    for segment in path:
        found = child(node, segment)
        is_found = found is not None
        if found is not None:
            key, node = _key(node, segment) or found, found
    return key, node, is_found


def _key(node: Node, segment: str | int) -> Node | None:
    mapping = node.target if isinstance(node, Alias) else node
    return mapping.entries[str(segment)].key if isinstance(mapping, Mapping) else None


def _is_unwritten(node: Node) -> bool:
    return isinstance(node, Scalar) and not node.style and node.start == node.end
