"""Plain data as YAML text in one style: blocks indented by two blanks, short lists on one line."""

from __future__ import annotations

from textwrap import wrap
from typing import TYPE_CHECKING

from bbsd.text.writing.scalars import is_plain, literal_lines, scalar_text

if TYPE_CHECKING:
    from bbsd.text.nodes import Data

WIDTH = 100
STEP = "  "
FLOW_KEYS = frozenset({"when"})  # keys whose mappings read best on one line


def write(data: dict[str, Data]) -> str:
    """Return a mapping as YAML text that reads as the same data, with blank lines around its blocks.

    Texts are quoted only where a reader of YAML 1.2 or 1.1 would take them for something else. Raises
    TypeError for anything but dicts with text keys, lists and single values.
    """
    if not data:
        return "{}\n"
    text, is_block = "", False
    for key, value in data.items():
        was_block, is_block = is_block, isinstance(value, dict | list)
        gap = "\n" if text and (is_block or was_block) else ""
        text += gap + "\n".join(entry_lines(key, value)) + "\n"
    return text


def entry_lines(key: str, value: Data, indent: int = 0) -> list[str]:
    """Return the lines of a key with its value, which stand `indent` blanks from the left."""
    head = f"{key_text(key)}:"
    first, *rest = value_lines(value, indent, indent + len(head) + 1, key)
    return [f"{head} {first}" if first else head, *rest]


def value_lines(value: Data, indent: int, column: int, key: str = "") -> list[str]:
    """Return the text after a key on its line ('' for a block) and the lines below, indented from the key.

    The key stands `indent` blanks from the left, and its value would begin at `column`.
    """
    if isinstance(value, str):
        lines = literal_lines(value) or _folded(value, indent, column)
        return [lines[0], *_indented(lines[1:])]
    if (inline := _inline(value, column, key)) is not None:
        return [inline]
    return ["", *_indented(_block_lines(value, indent + len(STEP)))]


def _block_lines(value: Data, indent: int) -> list[str]:
    if isinstance(value, dict):
        return [line for key, item in value.items() for line in entry_lines(key, item, indent)]
    items = value if isinstance(value, list) else [value]
    return [line for item in items for line in _item_lines(item, indent)]


def _item_lines(item: Data, indent: int) -> list[str]:
    first, *rest = value_lines(item, indent, indent + len(STEP))
    if not first:  # a block begins on the line of its dash
        first, *rest = rest
    return [f"- {first.strip()}", *rest]


def _indented(lines: list[str]) -> list[str]:
    return [STEP + line for line in lines]


def _folded(text: str, indent: int, column: int) -> list[str]:
    """Return a text on one line, or broken at blanks where it is long and YAML will join the lines again."""
    if column + len(text) <= WIDTH or "  " in text or not is_plain(text):
        return [scalar_text(text)]
    width = WIDTH - indent - len(STEP)
    lead = "x" * (column - indent - len(STEP))  # in place of the key before the first line
    lines = wrap(lead + text, width, break_long_words=False, break_on_hyphens=False)
    return [lines[0][len(lead) :], *lines[1:]]


def _inline(value: Data, column: int, key: str) -> str | None:
    """Return a value on one line if the style writes it so at this column, else None.

    Single values and empty collections always are; lists without mappings and mappings under `when`, where they fit.
    """
    if not isinstance(value, dict | list) or not value:
        return flow_text(value)
    if key not in FLOW_KEYS and has_mapping(value):
        return None
    text = flow_text(value)
    return text if column + len(text) <= WIDTH else None


def has_mapping(value: Data) -> bool:
    """Say whether a value is a mapping that is not empty, or a list that contains one."""
    if isinstance(value, list):
        return any(has_mapping(item) for item in value)
    return isinstance(value, dict) and bool(value)


def flow_text(value: Data) -> str:
    """Return a value on one line, with collections in brackets and braces."""
    if isinstance(value, dict):
        return "{" + ", ".join(flow_entry(key, item) for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(flow_text(item) for item in value) + "]"
    return scalar_text(value, flow=True)


def flow_entry(key: str, value: Data) -> str:
    """Return a key with its value as it stands between braces."""
    return f"{key_text(key, flow=True)}: {flow_text(value)}"


def key_text(key: str, flow: bool = False) -> str:
    """Return a key as YAML; raises TypeError if it is not a text."""
    if not isinstance(key, str):
        raise TypeError(f"a key must be a text, not {type(key).__name__}")
    return scalar_text(key, flow)
