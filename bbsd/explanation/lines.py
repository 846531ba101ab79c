"""Lines of plain text: paragraphs, hanging paragraphs and columns, 80 characters wide."""

from __future__ import annotations

from itertools import zip_longest
from textwrap import wrap
from typing import TYPE_CHECKING

from bbsd.errors import escape

if TYPE_CHECKING:
    from collections.abc import Sequence

LINE_WIDTH = 80
NARROWEST = 8
"""Characters of a column that is made narrower, at least."""
GAP = "  "
UNBROKEN = "\u00a0"
"""A space at which no line is broken."""


def wrapped(text: str, first: str = "", rest: str = "") -> list[str]:
    """Return a text in as many indented lines as it needs; its leading spaces are kept, and no percentage is split."""
    text = escape(text).replace(" %", f"{UNBROKEN}%")
    lead = " " * (len(text) - len(text.lstrip(" ")))
    lines = wrap(
        text.lstrip(" "),
        LINE_WIDTH,
        initial_indent=first + lead,
        subsequent_indent=rest + lead,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return [line.replace(UNBROKEN, " ") for line in lines]


def hanging(head: str, column: int, sentences: Sequence[str]) -> list[str]:
    """Return sentences, each on lines of its own from a column on; the head is before the first, or above it."""
    indent = " " * column
    lines = [line for sentence in sentences for line in wrapped(sentence, indent, indent + "  ")]
    return [head + lines[0][column:], *lines[1:]] if len(head) == column else [head.rstrip(), *lines]


def percent(share: float) -> str:
    """Return a share in percent with one decimal, as all commands show shares."""
    return f"{100 * share:.1f} %"


def table_lines(
    head: Sequence[str], rows: Sequence[Sequence[str]], indent: str = "", right: frozenset[int] = frozenset()
) -> list[str]:
    """Return a table; where it would be too wide, the texts of its widest columns are wrapped.

    Args:
        head: the columns' names.
        rows: a text for each column.
        indent: before each line.
        right: columns whose texts stand at the right.
    """
    cells = [[escape(text) for text in row] for row in (head, *rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    room = LINE_WIDTH - len(indent) - len(GAP) * (len(widths) - 1)
    while sum(widths) > room and max(widths) > NARROWEST:
        widths[widths.index(max(widths))] -= 1
    lines = [line for row in cells for line in _row_lines(row, widths, indent, right)]
    n_head = len(_row_lines(cells[0], widths, indent, right))
    rule = indent + GAP.join("-" * width for width in widths)
    return [*lines[:n_head], rule, *lines[n_head:]]


def _row_lines(row: Sequence[str], widths: Sequence[int], indent: str, right: frozenset[int]) -> list[str]:
    parts = [
        wrap(text, width, break_on_hyphens=False) or [""] for text, width in zip(row, widths, strict=True)
    ]
    return [
        (
            indent
            + GAP.join(
                part.rjust(width) if column in right else part.ljust(width)
                for column, (part, width) in enumerate(zip(line, widths, strict=True))
            )
        ).rstrip()
        for line in zip_longest(*parts, fillvalue="")
    ]
