"""Values on one line in the house style: one blank after commas and colons, quotes only where they are needed."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.text.nodes import Alias, Scalar
from bbsd.text.writing.leaves import leaves_in
from bbsd.text.writing.scalars import is_plain

if TYPE_CHECKING:
    from bbsd.text.nodes import Node

QUOTES = {"'", '"'}
PUNCTUATION = re.compile(r"[\s,:\[\]{}]*")
BLANKS = re.compile(r"\s+")


def inline_layout(text: str, node: Node, flow: bool = False) -> str:
    """Return a value that is written on one line in the house style; what is written unusually is unchanged."""
    if isinstance(node, Scalar):
        return _scalar_layout(text, node, flow)
    if isinstance(node, Alias):
        return text[node.start : node.end]
    pieces, done = [], node.start
    for leaf in leaves_in(node):
        if leaf.start == leaf.end or not PUNCTUATION.fullmatch(text, done, leaf.start):
            return text[node.start : node.end]
        pieces += [_punctuation_layout(text[done : leaf.start]), inline_layout(text, leaf, flow=True)]
        done = leaf.end
    if not PUNCTUATION.fullmatch(text, done, node.end):
        return text[node.start : node.end]
    return "".join([*pieces, _punctuation_layout(text[done : node.end])])


def _scalar_layout(text: str, node: Scalar, flow: bool) -> str:
    """Return a single value without the quotes that it does not need."""
    written = text[node.start : node.end]
    is_quoted = node.style in QUOTES and written[:1] == node.style
    return node.text if is_quoted and is_plain(node.text, flow) else written


def _punctuation_layout(written: str) -> str:
    """Return the punctuation between two values, with blanks after commas and colons only."""
    marks = BLANKS.sub("", written).replace(",", ", ").replace(":", ": ")
    return marks.replace(", ]", "]").replace(", }", "}")
