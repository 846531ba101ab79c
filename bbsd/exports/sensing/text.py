"""Expressions of C: each knows how tightly it binds, so that only parentheses that help are written."""

from __future__ import annotations

from math import copysign
from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable

CHOICE, OR, AND, EQUALITY, COMPARISON, SUM, PRODUCT, SIGN, ATOM = range(9)
"""From the loosest to the tightest."""

INFIX = {
    "|": ("||", OR),
    "&": ("&&", AND),
    "==": ("==", EQUALITY),
    "!=": ("!=", EQUALITY),
    "<": ("<", COMPARISON),
    "<=": ("<=", COMPARISON),
    ">": (">", COMPARISON),
    ">=": (">=", COMPARISON),
    "+": ("+", SUM),
    "-": ("-", SUM),
    "*": ("*", PRODUCT),
    "divide": ("/", PRODUCT),
}
"""Operations written between their operands, with C's operator and how tightly it binds."""
TYPES = {Kind.NUMBER: "double", Kind.TRUTH: "bool", Kind.CELL: "int"}


class Text(NamedTuple):
    """The source of an expression."""

    source: str
    binds: int = ATOM


def grouped(text: Text, binds: int) -> str:
    """Return the source of an operand, in parentheses if it binds less tightly than needed."""
    return text.source if text.binds >= binds else f"({text.source})"


def infix(operation: str, left: Text, right: Text) -> Text:
    """Join two operands; what compilers warn of, as `&&` within `||`, gets parentheses, too."""
    operator, binds = INFIX[operation]
    if binds in (OR, AND):
        sides = [
            text.source if text.binds in (binds, ATOM) or text.binds > AND else f"({text.source})"
            for text in (left, right)
        ]
    elif binds in (EQUALITY, COMPARISON):
        sides = [grouped(left, SUM), grouped(right, SUM)]
    else:
        sides = [grouped(left, binds), grouped(right, binds + 1)]
    return Text(f"{sides[0]} {operator} {sides[1]}", binds)


def negated(text: Text) -> Text:
    """Return the opposite of a truth."""
    return Text(f"!{grouped(text, ATOM)}", SIGN)


def minus(text: Text) -> Text:
    """Return the negative of a number."""
    return Text(f"-{grouped(text, ATOM)}", SIGN)


def choice(condition: Text, then: Text, otherwise: Text) -> Text:
    """Return the one or the other; the last of several may follow without parentheses."""
    sides = [grouped(condition, OR), grouped(then, OR)]
    return Text(f"{sides[0]} ? {sides[1]} : {otherwise.source}", CHOICE)


def call(function: str, arguments: Iterable[Text]) -> Text:
    """Return a call."""
    return Text(f"{function}({', '.join(text.source for text in arguments)})")


def number(value: float) -> Text:
    """Return the source of a binary64 number, from which C reads the same one."""
    if value != value:  # noqa: PLR0124 - NaN
        return Text("(double)NAN", SIGN)
    if value in (float("inf"), float("-inf")):
        return Text("(double)INFINITY" if value > 0 else "-(double)INFINITY", SIGN)
    return Text(repr(value), SIGN if copysign(1.0, value) < 0.0 else ATOM)


def literal(value: float, kind: Kind) -> Text:
    """Return the source of a literal number, truth or cell."""
    if kind is Kind.NUMBER:
        return number(value)
    if kind is Kind.TRUTH:
        return Text("true" if value else "false")
    return Text(str(int(value)))
