"""What tables and texts for a terminal show, as HTML; every text in it is escaped."""

from __future__ import annotations

from html import escape as escape_html
from typing import TYPE_CHECKING

from rich.console import Group
from rich.table import Table
from rich.text import Text

from bbsd.errors import escape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import RenderableType
    from rich.table import Column


def html_of(renderable: RenderableType) -> str:
    """Return HTML of what `bbsd.report` makes for rich: texts, tables, and groups of them."""
    match renderable:
        case Group():
            return "".join(html_of(part) for part in renderable.renderables)
        case Table():
            return _table(renderable)
        case Text() | str():
            words = _words(renderable)
            return f"<p>{words}</p>" if words else ""
    raise TypeError(f"{type(renderable).__name__} has no HTML")


def preformatted(text: str) -> str:
    """Return a text with its lines and blanks as they are."""
    return f"<pre>{escape_html(_visible(text))}</pre>"


def table_of(headings: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """Return a table of values; numbers stand at the right."""
    head = "".join(f'<th scope="col">{escape_html(_visible(heading))}</th>' for heading in headings)
    body = "".join(f"<tr>{''.join(map(_value, row))}</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _value(value: object) -> str:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    text = f"{value:.6g}" if isinstance(value, float) else str(value)
    return f"<td{_align('right' if is_number else 'left')}>{escape_html(_visible(text))}</td>"


def _table(table: Table) -> str:
    columns = table.columns
    head = "".join(f'<th scope="col"{_align(each.justify)}>{_words(each.header)}</th>' for each in columns)
    rows = zip(*(each.cells for each in columns), strict=True)
    body = "".join(f"<tr>{_cells(columns, row)}</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _cells(columns: Sequence[Column], row: Sequence[RenderableType]) -> str:
    return "".join(
        f"<td{_align(column.justify)}>{_words(cell)}</td>" for column, cell in zip(columns, row, strict=True)
    )


def _align(justify: str) -> str:
    return f' style="text-align: {"right" if justify == "right" else "left"}"'


def _words(cell: RenderableType) -> str:
    text = cell.plain if isinstance(cell, Text) else str(cell)
    return "<br>".join(escape_html(_visible(line)) for line in text.split("\n"))


def _visible(text: str) -> str:
    """Return a text in which what steers or hides is visible, line by line."""
    return "\n".join(escape(line) for line in text.split("\n"))
