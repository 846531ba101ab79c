"""Pieces of a kernel's source, each with how tightly it binds, so that only needed parentheses are written."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.operations import BINDING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.expression.graph import Node

Text = tuple[str, int]
"""An expression's source and how tightly its outermost operation binds."""

LOWEST, COMPARISON, SIGN, ATOM = 0, 1, 7, 9


def grouped(text: Text, binds: int) -> str:
    """A text as an operand of what binds so tightly."""
    source, own = text
    return source if own >= binds else f"({source})"


def infix(operation: str, left: Text, right: Text) -> Text:
    """Two texts joined by an operation that is done from left to right, or by a comparison."""
    own = BINDING[operation]
    leftmost = own + (own == COMPARISON)
    return f"{grouped(left, leftmost)} {operation} {grouped(right, own + 1)}", own


def sum_of(texts: Iterable[Text]) -> Text:
    """Texts added from left to right; zeros are left out."""
    first, *rest = [text for text in texts if text[0] != "0"] or [("0", ATOM)]
    for text in rest:
        first = infix("+", first, text)
    return first


def times(factor: int, text: Text) -> Text:
    """A multiple of an integer's text."""
    if factor == 1:
        return text
    return infix("*", (str(factor), ATOM), text) if factor else ("0", ATOM)


def literal_text(node: Node) -> Text:
    """The source of a literal."""
    value = value_of(node)
    return number_text(value) if node.kind is Kind.NUMBER else (str(value), ATOM)


def number_text(value: float) -> Text:
    """The source of a number."""
    if value != value:  # noqa: PLR0124 - NaN
        return "np.nan", ATOM
    if value in (float("inf"), float("-inf")):
        return ("np.inf", ATOM) if value > 0 else ("-np.inf", SIGN)
    text = repr(value)
    return text, SIGN if text.startswith("-") else ATOM
