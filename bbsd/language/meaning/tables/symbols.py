"""A table as text: a character for each cell, in row-major order of the inputs; white space is ignored."""

from __future__ import annotations

import re
from collections import Counter
from functools import lru_cache
from itertools import islice
from math import prod
from string import ascii_letters
from typing import TYPE_CHECKING

from bbsd.expression.syntax.tree import Span
from bbsd.language.meaning.tables.table import NO_ACTION, OPEN_CELL, Table

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bbsd.expression.scope import Findings, Path
    from bbsd.language.meaning.tables.table import Inputs

ACCENTED = "".join(map(chr, (*range(0xC0, 0xD7), *range(0xD8, 0xF7), *range(0xF8, 0x180))))
ACTIONS = "123456789" + ascii_letters + ACCENTED
"""The characters for the first action, the second, and so on: as many as a behavior may have, and more."""
SYMBOLS = {NO_ACTION: ".", OPEN_CELL: "?"} | dict(enumerate(ACTIONS[:200], 1))
CELLS = {symbol: cell for cell, symbol in SYMBOLS.items()} | {"0": NO_ACTION}
CODES = {ord(symbol): cell for symbol, cell in CELLS.items()}
MAX_REPORTED = 5
"""Wrong characters of one table that are reported."""
LINE_LENGTH = 90


def table_of_text(
    text: str,
    inputs: Inputs,
    actions: Sequence[str],
    path: Path,
    findings: Findings,
    *,
    is_known: bool = True,
) -> Table:
    """Return the cells that a text gives; where it does not fit, report why and return a table of open cells.

    With `is_known` False, inputs or actions had mistakes that were reported before, so no mistake is reported in the
    number of cells or actions.
    """
    n_cells, compact = prod(map(len, inputs.values())), _compact(text)
    used = _symbols(text)
    wrong = used - CELLS.keys()
    if is_known:
        wrong |= {symbol for symbol in used & CELLS.keys() if len(actions) < CELLS[symbol] < OPEN_CELL}
    for symbol in sorted(wrong, key=text.index)[:MAX_REPORTED]:
        message, advice = _wrong_symbol(symbol, actions)
        findings.report(path, "BB046", message, Span(text.index(symbol), 1), advice)
    if is_known and len(compact) != n_cells:
        findings.report(path, "BB046", *_wrong_length(text, len(compact), inputs))
    if wrong or len(compact) != n_cells:
        return Table(bytes([OPEN_CELL]) * n_cells)
    return Table(compact.translate(CODES).encode("latin-1"))


def text_of_table(cells: Sequence[int], inputs: Inputs) -> str:
    """Return the text of a table, in lines of whole rows of the last input where they are not too long."""
    row = len([*inputs.values()][-1]) if inputs else 1
    width = row * (LINE_LENGTH // row) or LINE_LENGTH
    text = "".join(map(SYMBOLS.__getitem__, cells))
    return "".join(f"{text[start : start + width]}\n" for start in range(0, len(text), width))


def filled_text(text: str, cells: Iterable[int]) -> str:
    """Return a table's text with its open cells filled from the table, and all else as it was."""
    remaining = iter(cells)

    def fill(symbol: str) -> str:
        if symbol.isspace():
            return symbol
        cell = next(remaining)
        return SYMBOLS[cell] if symbol == SYMBOLS[OPEN_CELL] else symbol

    return "".join(map(fill, text))


# Many behaviors may repeat the same long text: caching the last one goes through it once.
@lru_cache(maxsize=1)
def _compact(text: str) -> str:
    return "".join(text.split())


@lru_cache(maxsize=1)
def _symbols(text: str) -> frozenset[str]:
    return frozenset(_compact(text))


def _wrong_symbol(symbol: str, actions: Sequence[str]) -> tuple[str, str]:
    """Return message and advice for a character that stands for no cell of a table."""
    last = f" to {ACTIONS[len(actions) - 1]}" if len(actions) > 1 else ""
    numbered = f"1{last}: {', '.join(actions)}" if actions else "none"
    advice = f". or 0: no action; {numbered}; ?: open"
    if CELLS.get(symbol, 0):
        return f'"{symbol}" stands for action {CELLS[symbol]}, and there are {len(actions)}', advice
    return f'"{symbol}" stands for nothing in a table', advice


def _wrong_length(text: str, n_given: int, inputs: Inputs) -> tuple[str, Span, str]:
    """Return message, span and advice for a table with too many cells or too few: an odd line, or the end."""
    sizes = [f"{len(cells):,} of {name}" for name, cells in inputs.items()]
    product = f" ({' x '.join(sizes)})" if len(sizes) > 1 else ""
    given, wanted = f"{n_given:,} cell{'s' * (n_given != 1)}", prod(map(len, inputs.values()))
    message = f"this table has {given}, and its inputs make {wanted:,}{product}"
    return message, *_where_wrong(text)


@lru_cache(maxsize=1)
def _where_wrong(text: str) -> tuple[Span, str]:
    lengths = [len(line) for line in text.split()]
    [(usual, times)] = Counter(lengths).most_common(1) or [(0, 0)]
    odd = next((index for index, length in enumerate(lengths[:-1]) if length != usual), None)
    if odd is None or times < 2:
        return Span(max(0, len(text.rstrip()) - 1), 1), "the last input changes fastest"
    start = next(islice(re.finditer(r"\S+", text), odd, None)).start()
    return Span(start, lengths[odd]), f"this line has {lengths[odd]}, others have {usual}"
