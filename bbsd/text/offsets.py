"""Offsets of the characters of a value in the text of its file."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.text.nodes import Scalar

BLANKS = frozenset(" \t\r\n\x85\u2028\u2029")
PROPERTIES = r"(?:[&!]\S*\s+)*"
OPENINGS = {"'": "'", '"': '"', "|": r"\|[^\r\n]*", ">": r">[^\r\n]*"}
SPELLINGS = {
    "'": re.compile(r"''|.", re.DOTALL),
    '"': re.compile(r"\\(?:x..|u....|U........|.)|.", re.DOTALL),
}
ESCAPES = {
    "0": "\0",
    "a": "\a",
    "b": "\b",
    "e": "\x1b",
    "f": "\f",
    "v": "\v",
    "n": "\n",
    "r": "\r",
    "t": "\t",
}
ESCAPES |= {"N": "\x85", "_": "\xa0", "L": "\u2028", "P": "\u2029"}


def source_offsets(text: str, scalar: Scalar) -> list[int]:
    """Return the offset of each character of a scalar in the text of its file, and of the scalar's end.

    YAML drops indentation, folds line breaks and resolves escapes, but characters that are not blank stay in order:
    they are matched one by one, and blanks to the blanks between them.
    """
    pieces = [*_pieces(text, scalar)]
    offsets, index = [], 0
    for character in scalar.text:
        if character not in BLANKS:
            while index < len(pieces) and pieces[index][1] in BLANKS:
                index += 1
        offsets.append(pieces[min(index, len(pieces) - 1)][0])
        if character not in BLANKS or (index < len(pieces) and pieces[index][1] in BLANKS):
            index += 1
    return [*offsets, pieces[min(index, len(pieces) - 1)][0]]


def _pieces(text: str, scalar: Scalar) -> Iterator[tuple[int, str]]:
    """Yield the offset and the character of each spelling in the source; last the end and ''."""
    opening = re.compile(PROPERTIES + OPENINGS.get(scalar.style, "")).match(text, scalar.start)
    start = opening.end() if opening else scalar.start
    end = scalar.end - (scalar.style in {"'", '"'})
    if spelling := SPELLINGS.get(scalar.style):
        yield from ((match.start(), _spelled(match[0])) for match in spelling.finditer(text, start, end))
    else:
        yield from enumerate(text[start:end], start)
    yield end, ""


def _spelled(piece: str) -> str:
    """Return the character that a spelling stands for: itself, a doubled quote, or an escape."""
    if len(piece) == 1:
        return piece
    if piece == "''":
        return "'"
    if piece[1] in "xuU":
        return chr(int(piece.lstrip("\\xuU"), 16))
    return ESCAPES.get(piece[1], piece[1])
