"""Where a name stands in a file, so that all its uses can be edited."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.text.nodes import Alias, Mapping, Scalar, Sequence

if TYPE_CHECKING:
    import re
    from collections.abc import Iterator

    from bbsd.text.nodes import Node


def uses(node: Node, name: str, word: re.Pattern[str]) -> Iterator[tuple[int, int]]:
    """Yield where a name stands as a key, or as a word of plain texts: from, to."""
    match node:
        case Mapping():
            for entry in node.entries.values():
                if entry.key.text == name:
                    yield entry.key.start, entry.key.end
                yield from uses(entry.value, name, word)
        case Sequence():
            for item in node.items:
                yield from uses(item, name, word)
        case Scalar(style="", text=str()) if node.end - node.start == len(node.text):
            for found in word.finditer(node.text):
                yield node.start + found.start(), node.start + found.end()
        case Alias() | Scalar():
            return
