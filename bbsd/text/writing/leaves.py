"""The leaves of a document (keys, single values, aliases), and the text between them: punctuation and comments."""

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
    """Yield the start and end of each comment; one after the header of a block of text belongs to that text."""
    for begin, end in gaps_between_leaves(text, root):
        for match in COMMENT.finditer(text, begin, end):
            yield match.span()


def gaps_between_leaves(text: str, root: Node) -> Iterator[tuple[int, int]]:
    """Yield the start and end of each stretch of a text that is in none of its leaves."""
    done = 0
    for leaf in leaves_in(root):
        yield done, max(done, leaf.start)
        done = max(done, leaf.end)
    yield done, len(text)
