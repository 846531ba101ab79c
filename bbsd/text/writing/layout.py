"""The house style's layout of a YAML text, as edits that change only blanks and quotes."""

from __future__ import annotations

import re
from bisect import bisect
from collections import Counter
from dataclasses import dataclass, field
from itertools import chain
from typing import TYPE_CHECKING

from bbsd.text.nodes import Mapping, Scalar, Sequence
from bbsd.text.writing.inline_layout import inline_layout
from bbsd.text.writing.leaves import comments_in, gaps_between_leaves

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.text.nodes import Entry, Node
    from bbsd.text.source import Source

STEP = 2
LEAST_GAP = 2
"""The fewest blanks before a comment that follows something on its line."""
COLON = re.compile(r"[ \t]*:")
DASH = re.compile(r"(?<!\S)-(?!\S)")
COMMENT = re.compile(r"(?<!\S)#[^\r\n]*")
INDENTATION = re.compile(r"(?<=[\r\n]) *(?=[^\r\n])")
INDENTATION_OF_FLOW = re.compile(r"(?<=[\r\n]) *(?=\S)")
TRAILING = re.compile(r"[ \t]+(?=[\r\n])|[ \t]+\Z")


class UnusualError(Exception):
    """A text in an unusual form, such as with `? key`, whose layout is left as it is."""


@dataclass(frozen=True, slots=True, order=True)
class Edit:
    """A replacement of the characters from start up to end by a text."""

    start: int
    end: int
    text: str


@dataclass(frozen=True, slots=True)
class Head:
    """A key or the dash of an item: its line, its column, and the column that the layout gives it."""

    line: int
    column: int
    wanted: int


@dataclass(slots=True)
class _Layout:
    """The edits of a source so far, and the keys and dashes that they move."""

    source: Source
    heads: list[Head] = field(default_factory=list)
    edits: list[Edit] = field(default_factory=list)
    growth: Counter[int] = field(default_factory=Counter)
    """The number of characters by which edits lengthen each line, without its indentation."""

    def column(self, offset: int) -> int:
        return offset - self.source.line_start(offset)

    def same_line(self, one: int, other: int) -> bool:
        return self.source.line_number(one) == self.source.line_number(other)

    def replace(self, start: int, end: int, text: str) -> None:
        if self.source.text[start:end] != text:
            self.edits.append(Edit(start, end, text))
            self.growth[self.source.line_number(start)] += len(text) - (end - start)

    def indent(self, start: int, end: int, column: int) -> None:
        if end - start != column:
            self.edits.append(Edit(start, end, " " * column))


def lay_out(source: Source, root: Mapping) -> str:
    """Return the text with the indentation, spacing and quotes of the house style; raises UnusualError."""
    layout = _Layout(source)
    _value(layout, root, 0, 0)
    _comments(layout, root)
    _trailing_blanks(layout, root)
    return _applied(source.text, layout.edits)


def _applied(text: str, edits: list[Edit]) -> str:
    pieces, done = [], 0
    for edit in sorted(edits):
        pieces += [text[done : edit.start], edit.text]
        done = edit.end
    return "".join([*pieces, text[done:]])


def _mapping(layout: _Layout, node: Mapping, column: int) -> None:
    for entry in node.entries.values():
        _head(layout, entry.key.start, column)
        shift = column - layout.column(entry.key.start)
        _colon(layout, entry)
        _leaf(layout, entry.key, shift)
        _value(layout, entry.value, column + STEP, shift)


def _head(layout: _Layout, start: int, column: int) -> None:
    """Indent the line that begins with a key or dash; a key after a dash was moved with the dash."""
    begin = layout.source.line_start(start)
    before = layout.source.text[begin:start]
    if before.strip(" -"):
        raise UnusualError
    layout.heads.append(Head(layout.source.line_number(start), len(before), column))
    if not before.strip():
        layout.indent(begin, start, column)


def _colon(layout: _Layout, entry: Entry) -> None:
    """Put the colon right after its key, and one blank after the colon."""
    key, value, text = entry.key, entry.value, layout.source.text
    colon = COLON.match(text, key.end)
    if colon is None:
        raise UnusualError
    is_beside = layout.same_line(key.end, value.start) and not _is_unwritten(value)
    if is_beside and text[colon.end() : value.start].strip(" \t"):
        raise UnusualError
    layout.replace(key.end, value.start if is_beside else colon.end(), ": " if is_beside else ":")


def _is_unwritten(node: Node) -> bool:
    return isinstance(node, Scalar) and node.is_unwritten


def _sequence(layout: _Layout, node: Sequence, column: int) -> None:
    text, done = layout.source.text, node.start
    for item in node.items:
        gap = COMMENT.sub(lambda match: "#" * len(match[0]), text[done : item.start])
        dash = DASH.search(gap)
        if dash is None:
            raise UnusualError
        start = done + dash.start()
        _head(layout, start, column)
        if layout.same_line(start, item.start) and not _is_unwritten(item):
            layout.replace(start + 1, item.start, " ")
        _value(layout, item, column + STEP, column - layout.column(start))
        done = max(item.end, start + 1)


def _value(layout: _Layout, node: Node, column: int, shift: int) -> None:
    match node:
        case Mapping(flow=False):
            _mapping(layout, node, column)
        case Sequence(flow=False):
            _sequence(layout, node, column)
        case _:
            _leaf(layout, node, shift)


def _leaf(layout: _Layout, node: Node, shift: int) -> None:
    """Lay out a value without blocks: anew if it is on one line, else moved as a whole."""
    text = layout.source.text
    if layout.same_line(node.start, node.end):
        layout.replace(node.start, node.end, inline_layout(text, node))
    indentation = INDENTATION if isinstance(node, Scalar) else INDENTATION_OF_FLOW
    for match in indentation.finditer(text, node.start, node.end):
        layout.indent(*match.span(), max(0, len(match[0]) + shift))


def _comments(layout: _Layout, root: Mapping) -> None:
    """Move comments with what they stand above, and keep the column of those at the end of a line."""
    source = layout.source
    moved = {edit.start for edit in layout.edits}
    for start, _ in comments_in(source.text, root):
        begin = source.line_start(start)
        before = source.text[begin:start]
        if before.strip():
            gap = len(before) - len(before.rstrip())
            wanted = max(LEAST_GAP, gap - layout.growth[source.line_number(start)])
            layout.replace(start - gap, start, " " * wanted)
        elif begin not in moved:
            layout.indent(begin, start, _comment_column(layout, start))


def _comment_column(layout: _Layout, start: int) -> int:
    """Return the new column of a comment: that of the head below it or of a block around it that is in its column."""
    line, column = layout.source.line_number(start), layout.column(start)
    index = bisect(layout.heads, line, key=lambda head: head.line)
    nearest: Head | None = None
    for head in chain(_heads_of_next_line(layout.heads, index), _open_heads(layout.heads, index, column)):
        if head.column == column:
            return head.wanted
        nearest = nearest or head
    return max(0, column + nearest.wanted - nearest.column) if nearest else column


def _heads_of_next_line(heads: list[Head], index: int) -> Iterator[Head]:
    line = heads[index].line if index < len(heads) else 0
    while index < len(heads) and heads[index].line == line:
        yield heads[index]
        index += 1


def _open_heads(heads: list[Head], index: int, column: int) -> Iterator[Head]:
    """Yield the heads before an index whose blocks could continue there in a column, the nearest first."""
    least: int | None = None
    while index and (least is None or least > column):
        index -= 1
        if least is None or heads[index].column < least:
            least = heads[index].column
            yield heads[index]


def _trailing_blanks(layout: _Layout, root: Mapping) -> None:
    text = layout.source.text
    for begin, end in gaps_between_leaves(text, root):
        for match in TRAILING.finditer(text, begin, end):
            if match.end() < end or end == len(text):  # else a value follows
                layout.replace(*match.span(), "")
