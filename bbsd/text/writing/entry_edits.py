"""Edits of a YAML text that change one entry or item and leave the rest of the file as it is, byte for byte.

Each edit returns the new text, or None where it cannot be done this way. The text is a proposal: `patch` reads it again
and checks it.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.text.nodes import Mapping, Scalar, Sequence
from bbsd.text.writing.writer import WIDTH, entry_lines, flow_entry, flow_text, has_mapping, value_lines

if TYPE_CHECKING:
    from bbsd.text.nodes import Data, Entry, Node
    from bbsd.text.source import Source

COLON = re.compile(r"[ \t]*:")
COMMENT_LINE = re.compile(r"(?:[ \t]*(?:\r\n|\r|\n))+( *)#[^\r\n]*")
BLANK_LINE = re.compile(r"(?:\r\n|\r|\n)[ \t]*(?:\r\n|\r|\n)")
AFTER_BLANK_LINE = re.compile(r"(?:\r\n|\r|\n)[ \t]*(?:\r\n|\r|\n)\Z")
LINE_BREAK = re.compile(r"\r\n|\r|\n")


def replace_entry(source: Source, parent: Mapping, key: str, value: Data) -> str | None:
    """Give an entry of a mapping another value."""
    entry = parent.entries[key]
    if parent.flow:
        flow = f": {flow_text(value)}"
        return _splice_flow(source, entry.key.end, entry.value.end, flow, value)
    colon = COLON.match(source.text, entry.key.end)
    return _replace_in_block(source, entry, key, value, colon.end()) if colon else None


def _replace_in_block(source: Source, entry: Entry, key: str, value: Data, head_end: int) -> str:
    node, indent = entry.value, _column(source, entry.key.start)
    flow = _kept_inline(node, value, source, head_end)
    first, *rest = flow or value_lines(value, indent, _column(source, head_end) + 1, key)
    below = _indented_below(source, rest, indent)
    is_beside = source.line_number(node.start) == source.line_number(head_end)
    replaced = (
        _beside_key(source, node, first, below)
        if is_beside
        else _below_key(source, node, head_end, first, below)
    )
    return source.text[:head_end] + replaced + _rest(source, source.line_end(written_end(source, node)))


def _beside_key(source: Source, node: Node, first: str, below: str) -> str:
    """Return the text that replaces a value beside its key, with the comment after it."""
    last = written_end(source, node)
    return _with_comment(first, below, source.text[last : source.line_end(last)].rstrip())


def _below_key(source: Source, node: Node, head_end: int, first: str, below: str) -> str:
    """Return the text that replaces a block, with the comments between its key and it."""
    above = source.text[head_end : source.line_start(node.start)]
    return _with_comment(first, below, above.rstrip()) if first else above + below.lstrip("\r\n")


def _with_comment(first: str, below: str, comment: str) -> str:
    """Return a value with its comment, placed before a block but after a folded text, which cannot contain it."""
    is_folded = below and first and not first.startswith("|")
    head = f" {first}" if first else ""
    return head + below + comment if is_folded else head + comment + below


def _rest(source: Source, offset: int) -> str:
    return source.text[offset:] or line_break(source)


def _kept_inline(node: Node, value: Data, source: Source, head_end: int) -> list[str] | None:
    """Return a value on one line if it replaces a collection in brackets and fits there, else None."""
    if not isinstance(node, Mapping | Sequence) or not node.flow or not suits_flow(value):
        return None
    flow = flow_text(value)
    return [flow] if _column(source, head_end) + 1 + len(flow) <= WIDTH else None


def add_entry(source: Source, parent: Mapping, key: str, value: Data, after: str | None = None) -> str | None:
    """Add an entry to a mapping, after the entry of the key `after` if there is one, else at the end."""
    entries = [*parent.entries.values()]
    if parent.flow:
        at, flow = parent.end - 1, flow_entry(key, value)
        if entries:
            at, flow = entries[-1].value.end, f", {flow}"
        return _splice_flow(source, at, at, flow, value)
    before = entries[-1] if after is None else parent.entries.get(after, entries[-1])
    column = _column(source, entries[0].key.start)
    at = _behind_comments(source, written_end(source, before.value), max(column, 1))
    gap = _gap(source, entries, before, value) if column == 0 else ""
    closing = gap if before is not entries[-1] and not BLANK_LINE.match(source.text, at) else ""
    lines = _indented_below(source, entry_lines(key, value, column), column)
    return source.text[:at] + gap + lines + closing + _rest(source, at)


def _gap(source: Source, entries: list[Entry], before: Entry, value: Data) -> str:
    """Return a line break to add before a new block at the top if the file has blank lines between entries."""
    between = source.text[entries[0].key.start : entries[-1].key.start]
    has_blocks = isinstance(value, dict | list) or isinstance(before.value, Mapping | Sequence)
    return line_break(source) if has_blocks and BLANK_LINE.search(between) else ""


def _behind_comments(source: Source, offset: int, indent: int) -> int:
    """Return the end of the line of an offset, or of the comments below it that have at least that indent."""
    end = source.line_end(offset)
    while (match := COMMENT_LINE.match(source.text, end)) and len(match[1]) >= indent:
        end = match.end()
    return end


def delete_entry(source: Source, parent: Mapping, key: str) -> str | None:
    """Remove an entry that has lines of its own from a mapping that keeps other entries."""
    entry, text = parent.entries[key], source.text
    start = source.line_start(entry.key.start)
    if parent.flow or len(parent.entries) == 1 or text[start : entry.key.start].strip():
        return None
    rest = _without_break(text[source.line_end(written_end(source, entry.value)) :])
    is_after_blank = not text[:start].strip() or AFTER_BLANK_LINE.search(text, max(0, start - 100), start)
    return text[:start] + (_without_break(rest) if is_after_blank else rest)


def _without_break(text: str) -> str:
    match = LINE_BREAK.match(text)
    return text[match.end() :] if match else text


def replace_item(source: Source, parent: Sequence, index: int, value: Data) -> str | None:
    """Give an item of a list another value: any that fits in brackets, else a single value for a single one."""
    item = parent.items[index]
    if parent.flow:
        return _splice_flow(source, item.start, item.end, flow_text(value), value)
    if not isinstance(item, Scalar) or item.style in {"|", ">"} or isinstance(value, dict | list):
        return None
    first, *rest = value_lines(value, 0, _column(source, item.start))
    return None if rest else source.text[: item.start] + first + source.text[item.end :]


def suits_flow(value: Data) -> bool:
    """Say whether a value may stand between brackets: there is no list of mappings in it."""
    if isinstance(value, dict):
        return all(suits_flow(item) for item in value.values())
    return not isinstance(value, list) or not has_mapping(value)


def _splice_flow(source: Source, start: int, end: int, flow: str, value: Data) -> str | None:
    line = source.text[source.line_start(start) : start] + flow + source.text[end : source.line_end(end)]
    if isinstance(value, dict | list) and (not suits_flow(value) or len(line) > WIDTH):
        return None
    return source.text[:start] + flow + source.text[end:]


def written_end(source: Source, node: Node) -> int:
    """Return the offset at which a node ends, without the blank lines after a block scalar."""
    return node.start + len(source.text[node.start : node.end].rstrip())


def _column(source: Source, offset: int) -> int:
    return offset - source.line_start(offset)


def line_break(source: Source) -> str:
    """Return the line break that a file uses."""
    match = LINE_BREAK.search(source.text)
    return match[0] if match else "\n"


def _indented_below(source: Source, lines: list[str], indent: int) -> str:
    """Return lines as text that continues another line: each after a line break, indented."""
    return "".join(line_break(source) + " " * indent + line for line in lines)
