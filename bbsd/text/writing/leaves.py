"""What a text has between its values: structure and comments."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.text.nodes import Mapping, Sequence

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.text.nodes import Node

COMMENT = re.compile(r"(?<!\S)#[^\r\n]*")


def leaves_in(node: Node) -> Iterator[Node]:
    """Yield the keys, single values and aliases in a node, in the order of the text."""
    match node:
        case Mapping():
            for entry in node.entries.values():
                yield entry.key
                yield from leaves_in(entry.value)
        case Sequence():
            for item in node.items:
                yield from leaves_in(item)
        case _:
            yield node


def comments_in(text: str, root: Node) -> Iterator[tuple[int, int]]:
    """Yield where comments begin and end; one behind the header of a block of text is part of that."""
    for begin, end in between(text, root):
        for found in COMMENT.finditer(text, begin, end):
            yield found.span()


def between(text: str, root: Node) -> Iterator[tuple[int, int]]:
    """Yield the stretches of a text that are in none of its values."""
    done = 0
    for leaf in leaves_in(root):
        yield done, max(done, leaf.start)
        done = max(done, leaf.end)
    yield done, len(text)
