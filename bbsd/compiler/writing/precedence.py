"""Expressions of a kernel's source: each knows how tightly it binds, which names it uses, and whether it is expensive.

Only needed parentheses are written.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.graph import value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.operations import BINDING, EXPENSIVE

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.expression.graph import Node

LOWEST, COMPARISON, SIGN, ATOM = 0, 1, 7, 9
EXPENSIVE_CALLS = EXPENSIVE | {"normal"}
NO_NAMES: frozenset[str] = frozenset()


class Text(NamedTuple):
    """The source of an expression."""

    source: str
    binds: int = ATOM
    """How tightly its outermost operation binds."""
    uses: frozenset[str] = NO_NAMES
    """The local names of values that occur in it; arrays, arguments and functions do not count."""
    expensive: bool = False
    """Whether it calls a function that takes long."""


def name_text(name: str) -> Text:
    """Return the source of a local name."""
    return Text(name, ATOM, frozenset((name,)))


def grouped(text: Text, binds: int) -> str:
    """Return the source of an operand, in parentheses if it binds less tightly than needed."""
    return text.source if text.binds >= binds else f"({text.source})"


def infix(operation: str, left: Text, right: Text) -> Text:
    """Join two operands by an operator that groups from left to right, or by a comparison."""
    binds = BINDING[operation]
    leftmost = binds + (binds == COMPARISON)
    source = f"{grouped(left, leftmost)} {operation} {grouped(right, binds + 1)}"
    return Text(source, binds, left.uses | right.uses, left.expensive or right.expensive)


def join(operation: str, texts: Iterable[Text]) -> Text:
    """Join one or more operands from left to right."""
    first, *rest = texts
    for text in rest:
        first = infix(operation, first, text)
    return first


def sum_of(texts: Iterable[Text]) -> Text:
    """Add integers from left to right; zeros are left out."""
    return join("+", [text for text in texts if text.source != "0"] or [Text("0")])


def times(factor: int, text: Text) -> Text:
    """Return a multiple of an integer."""
    if factor == 1:
        return text
    return infix("*", Text(str(factor)), text) if factor else Text("0")


def call(function: str, arguments: Iterable[Text]) -> Text:
    """Return the source of a call."""
    arguments, uses, expensive = list(arguments), NO_NAMES, function in EXPENSIVE_CALLS
    for text in arguments:
        uses, expensive = uses | text.uses, expensive or text.expensive
    return Text(f"{function}({', '.join([text.source for text in arguments])})", ATOM, uses, expensive)


def literal_text(node: Node) -> Text:
    """Return the source of a literal."""
    value = value_of(node)
    return number_text(value) if node.kind is Kind.NUMBER else Text(str(value))


def number_text(value: float) -> Text:
    """Return the source of a number."""
    if value != value:  # noqa: PLR0124 - NaN
        return Text("np.nan")
    if value in (float("inf"), float("-inf")):
        return Text("np.inf") if value > 0 else Text("-np.inf", SIGN)
    source = repr(value)
    return Text(source, SIGN if source.startswith("-") else ATOM)
