"""Texts that YAML accepts, but reads as something else than their author meant."""

from __future__ import annotations

import re
from itertools import islice
from typing import TYPE_CHECKING, TypeAlias

from bbsd.errors import Correction, Diagnosis
from bbsd.text.nodes import Node, Scalar

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bbsd.text.source import Source

Piece: TypeAlias = tuple[Node, Node]
"""What stands between two commas: a key and its value, or a value and NOTHING."""
NOTHING = Scalar(0, 0, "", "", None)
MAX_PIECES = 100  # of one expression; more are not searched, so that no file takes quadratic time
GLUED = re.compile(r"([A-Za-z_]\w*):[^\s/:]")


def join_at_commas(text: str, pieces: Iterable[Piece]) -> tuple[list[Piece], list[Scalar]]:
    """Rejoin the pieces of a flow mapping or list that a comma between parentheses separated.

    `{speed: min(speed, top)}` is the key `speed` with the text `min(speed`, and a key `top)` without a
    value. Returns the pieces, rejoined, and the scalars that were made by it.
    """
    rest, rejoined, joined = list(pieces)[::-1], [], []
    while rest:
        piece = rest.pop()
        if count := _pieces_to_closing(piece, islice(reversed(rest), MAX_PIECES)):
            last = rest[-count]
            del rest[-count:]
            piece, scalar = _join(text, piece, last)
            rest.append(piece)
            joined.append(scalar)
        else:
            rejoined.append(piece)
    return rejoined, joined


def _pieces_to_closing(piece: Piece, following: Iterable[Piece]) -> int:
    """Return how many following pieces close the parenthesis that this one leaves open; 0 if none do."""
    key, value = piece
    is_bare = _is_nothing(value)
    depth = _opened(key if is_bare else value)
    if depth <= 0:
        return 0
    for count, (key, value) in enumerate(following, 1):
        depth += _opened(key)
        if depth <= 0:
            return count if is_bare or _is_nothing(value) else 0
        if not _is_nothing(value):
            return 0
    return 0


def _opened(node: Node) -> int:
    return node.text.count("(") - node.text.count(")") if isinstance(node, Scalar) and node.is_plain else 0


def _is_nothing(node: Node) -> bool:
    return isinstance(node, Scalar) and node.is_unwritten


def _join(text: str, first: Piece, last: Piece) -> tuple[Piece, Scalar]:
    key, value = first
    is_bare = _is_nothing(value)
    start, end = (key if is_bare else value).start, last[0].end
    value_text = " ".join(text[start:end].split())
    scalar = Scalar(start, end, "", value_text, value_text)
    return ((scalar, last[1]) if is_bare else (key, scalar)), scalar


def comma_mistakes(source: Source, joined: Sequence[Scalar]) -> list[Diagnosis]:
    """Return the diagnoses of values that commas cut into pieces."""
    return [
        Diagnosis(
            "BB016",
            "a comma ends a value inside {...} and [...], even between parentheses",
            source.place(scalar.start, scalar.end),
            "write the value on its own line under its key, or in quotes",
            _in_quotes(source, scalar),
        )
        for scalar in joined
    ]


def _in_quotes(source: Source, scalar: Scalar) -> Correction | None:
    text = source.text[scalar.start : scalar.end]
    if '"' in text or "\\" in text or "\n" in text:
        return None
    return Correction((source.edit(scalar.start, scalar.end, f'"{text}"'),))


def glued_mistake(source: Source, key: Scalar, value: Node, flow: bool) -> Diagnosis | None:
    """Return the diagnosis of `key:value`, which YAML reads as one text: a key in braces, or a value below its key."""
    suspect = key if flow and _is_nothing(value) else value
    if not isinstance(suspect, Scalar) or not suspect.is_plain or not GLUED.match(suspect.text):
        return None
    if suspect is value and (flow or source.line_number(key.start) == source.line_number(value.start)):
        return None
    return glued(source, suspect.start)


def glued(source: Source, start: int) -> Diagnosis | None:
    """Return the diagnosis of the `key:value` that begins at an offset, if one does: a colon without a blank."""
    match = GLUED.match(source.text, start)
    if not match:
        return None
    message = f'there is no blank after the colon of "{match[1]}:"'
    colon = match.end() - 1
    blank = Correction((source.edit(colon, colon, " "),))
    return Diagnosis("BB017", message, source.place(start, colon), "write `key: value`", blank)


def empty_block_mistake(source: Source, scalar: Scalar) -> Diagnosis | None:
    """Return the diagnosis of a value such as `>3`, which begins a block of text that has no lines."""
    if scalar.style not in {"|", ">"} or scalar.text.strip():
        return None
    return Diagnosis(
        "BB018",
        f'"{scalar.style}" announces a text on the lines below, and there is none',
        source.place(scalar.start, scalar.end),
        "put the value in quotes, if an expression is meant",
    )
