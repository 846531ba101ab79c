"""The kind of an expression, as far as its outermost operation tells."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.kinds import Kind
from bbsd.expression.syntax.tree import Binary, Call, Comparison, Expr, Logical, Number, Truth, Unary
from bbsd.expression.vocabulary import FUNCTIONS

if TYPE_CHECKING:
    from collections.abc import Container

AGGREGATES_OF_NUMBERS = ("sum", "mean", "argmin", "argmax")
AGGREGATES_OF_TRUTHS = ("any", "all")


def kind_by_form(expr: Expr, defined: Container[str] = ()) -> Kind:
    """Return number or truth where the outermost operation tells, else unknown; `defined` are the spec's functions."""
    match expr:
        case Call(function=name) if name in defined:
            return Kind.UNKNOWN
        case Number() | Binary() | Unary(operator="-" | "+"):
            return Kind.NUMBER
        case Truth() | Comparison() | Logical() | Unary():
            return Kind.TRUTH
        case Call(function=name) if name in FUNCTIONS or name in AGGREGATES_OF_NUMBERS:
            return Kind.NUMBER
        case Call(function=name) if name in AGGREGATES_OF_TRUTHS:
            return Kind.TRUTH
    return Kind.UNKNOWN
