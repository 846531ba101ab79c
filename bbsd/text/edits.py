"""Edits of a YAML text that touch one entry and leave the rest of the file as it is, byte for byte.

Each returns the new text, or None where it has no way to do it. None is sure of its result: `patch` reads it again.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.text.nodes import Mapping, Scalar, Sequence
from bbsd.text.writer import WIDTH, entry_lines, flow_entry, flow_text, has_mapping, value_lines

if TYPE_CHECKING:
    from bbsd.text.nodes import Data, Entry, Node
    from bbsd.text.source import Source

COLON = re.compile(r"[ \t]*:")
COMMENT_LINE = re.compile(r"(?:[ \t]*(?:\r\n|\r|\n))+( *)#[^\r\n]*")
BLANK_LINE = re.compile(r"(?:\r\n|\r|\n)[ \t]*(?:\r\n|\r|\n)")
LINE_BREAK = re.compile(r"\r\n|\r|\n")


def replaced_entry(source: Source, parent: Mapping, key: str, value: Data) -> str | None:
    """Give an entry of a mapping another value."""
    entry = parent.entries[key]
    if parent.flow:
        flow = f": {flow_text(value)}"
        return _spliced_flow(source, entry.key.end, entry.value.end, flow, value)
    colon = COLON.match(source.text, entry.key.end)
    return _replaced_in_block(source, entry, key, value, colon.end()) if colon else None


def _replaced_in_block(source: Source, entry: Entry, key: str, value: Data, after_colon: int) -> str:
    text, node, indent = source.text, entry.value, _column(source, entry.key.start)
    first, *rest = _like(node, value, source, after_colon) or value_lines(
        value, indent, after_colon + 1 - source.line_start(after_colon), key
    )
    last = written_end(source, node)
    tail = text[last : source.line_end(last)]  # a comment behind the value
    is_below = source.line_number(node.start) > source.line_number(after_colon)
    below = _joined(source, rest, indent)
    if is_below and not first:
        above = text[after_colon : source.line_start(node.start)]
        return text[:after_colon] + above + below.lstrip("\r\n") + text[source.line_end(last) :]
    if is_below:
        tail = "" if rest else text[after_colon : source.line_start(node.start)].rstrip()
    head = f" {first}" if first else ""
    comment = tail.rstrip()
    folded = rest and first and not first.startswith("|")
    after_head, after_all = ("", comment) if folded else (comment, "")
    return text[:after_colon] + head + after_head + below + after_all + text[source.line_end(last) :]


def _like(node: Node, value: Data, source: Source, column_from: int) -> list[str] | None:
    """Return a value on one line if the one it replaces was a collection on one line and it fits."""
    if not isinstance(node, Mapping | Sequence) or not node.flow or not suits_flow(value):
        return None
    flow = flow_text(value)
    return [flow] if _column(source, column_from) + 1 + len(flow) <= WIDTH else None


def added_entry(
    source: Source, parent: Mapping, key: str, value: Data, after: str | None = None
) -> str | None:
    """Add an entry to a mapping, behind the entry of the key `after` if there is one, else at the end."""
    entries = [*parent.entries.values()]
    if parent.flow:
        at, flow = parent.end - 1, flow_entry(key, value)
        if entries:
            at, flow = entries[-1].value.end, f", {flow}"
        return _spliced_flow(source, at, at, flow, value)
    before = parent.entries.get(after or "", entries[-1])
    column = _column(source, entries[0].key.start)
    at = _behind_comments(source, written_end(source, before.value), max(column, 1))
    gap = _gap(source, entries, before, value) if column == 0 else ""
    rest = source.text[at:]
    closing = gap if before is not entries[-1] and not BLANK_LINE.match(rest) else ""
    return source.text[:at] + gap + _joined(source, entry_lines(key, value, column), column) + closing + rest


def _gap(source: Source, entries: list[Entry], before: Entry, value: Data) -> str:
    """Return the additional line break before a new block at the top where the file has blank lines there."""
    between = source.text[entries[0].key.start : entries[-1].key.start]
    has_blocks = isinstance(value, dict | list) or isinstance(before.value, Mapping | Sequence)
    return line_break(source) if has_blocks and BLANK_LINE.search(between) else ""


def _behind_comments(source: Source, offset: int, indent: int) -> int:
    """Return the end of the line of an offset, or of the comments below it that are indented as far."""
    end = source.line_end(offset)
    while (found := COMMENT_LINE.match(source.text, end)) and len(found[1]) >= indent:
        end = found.end()
    return end


def deleted_entry(source: Source, parent: Mapping, key: str) -> str | None:
    """Remove an entry that has lines of its own from a mapping that keeps others."""
    entry, text = parent.entries[key], source.text
    start = source.line_start(entry.key.start)
    if parent.flow or len(parent.entries) == 1 or text[start : entry.key.start].strip():
        return None
    rest = text[source.line_end(written_end(source, entry.value)) :]
    rest = LINE_BREAK.sub("", rest, count=1)
    ends_blank = not text[:start].strip() or BLANK_LINE.search(text[:start][-4:] + "|") is not None
    return text[:start] + (
        LINE_BREAK.sub("", rest, count=1) if ends_blank and LINE_BREAK.match(rest) else rest
    )


def replaced_item(source: Source, parent: Sequence, index: int, value: Data) -> str | None:
    """Give an item of a list another value: in brackets any that fits, else a single value for a single value."""
    item = parent.items[index]
    if parent.flow:
        return _spliced_flow(source, item.start, item.end, flow_text(value), value)
    if not isinstance(item, Scalar) or item.style in {"|", ">"} or isinstance(value, dict | list):
        return None
    first, *rest = value_lines(value, 0, _column(source, item.start))
    return None if rest else source.text[: item.start] + first + source.text[item.end :]


def suits_flow(value: Data) -> bool:
    """Say whether a value may stand between brackets: there is no list of mappings in it."""
    if isinstance(value, dict):
        return all(suits_flow(each) for each in value.values())
    return not isinstance(value, list) or not has_mapping(value)


def _spliced_flow(source: Source, start: int, end: int, flow: str, value: Data) -> str | None:
    line = source.text[source.line_start(start) : start] + flow + source.text[end : source.line_end(end)]
    if isinstance(value, dict | list) and (not suits_flow(value) or len(line) > WIDTH):
        return None
    return source.text[:start] + flow + source.text[end:]


def written_end(source: Source, node: Node) -> int:
    """Return where the text of a node ends, without the blank lines that a block scalar claims."""
    return node.start + len(source.text[node.start : node.end].rstrip())


def _column(source: Source, offset: int) -> int:
    return offset - source.line_start(offset)


def line_break(source: Source) -> str:
    """Return how the lines of a file end."""
    found = LINE_BREAK.search(source.text)
    return found[0] if found else "\n"


def _joined(source: Source, lines: list[str], indent: int) -> str:
    """Return lines to be put behind another line, indented."""
    return "".join(line_break(source) + " " * indent + line for line in lines)
