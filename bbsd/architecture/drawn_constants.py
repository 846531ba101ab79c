"""Constants that a seed drew, as given ones: their values, or expressions where they change with the generation."""

from __future__ import annotations

from math import copysign, isfinite, isnan
from typing import TYPE_CHECKING

from bbsd.expression.graph import value_of
from bbsd.expression.operations import COMPARISONS
from bbsd.expression.text import render
from bbsd.expression.tree import (
    Binary,
    Call,
    Comparison,
    Conditional,
    Expr,
    Logical,
    Name,
    Number,
    Span,
    Truth,
    Unary,
    parts,
)
from bbsd.expression.vocabulary import DRAWS, FUNCTIONS
from bbsd.language.field_types import expressions_in

if TYPE_CHECKING:
    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Value
    from bbsd.language.meaning import Meaning
    from bbsd.text import Data, DataPath

NOWHERE = Span(0, 0)
LARGEST_WHOLE = 1e15  # from here on a float reads better than its digits

BINARY = {"+": "+", "-": "-", "*": "*", "divide": "/", "floor_divide": "//", "modulo": "%", "power": "**"}
LOGICAL = {"&": "and", "|": "or"}
CALLS = {function.operation: name for name, function in FUNCTIONS.items()} | {
    "minimum": "min",
    "maximum": "max",
}


def drawn_constants(meaning: Meaning) -> dict[DataPath, Data]:
    """The values of the constants that contain draws, as plain data at their paths."""
    return {
        ("constants", name): _datum(meaning.constants.values[name])
        for name, written in meaning.spec.constants.items()
        if any(_draws(expression.tree) for expression in expressions_in(written))
    }


def _draws(expr: Expr) -> bool:
    return (isinstance(expr, Call) and expr.function in DRAWS) or any(map(_draws, parts(expr)))


def _datum(value: Value) -> Data:
    if isinstance(value, tuple):
        return [_datum(item) for item in value]
    if not value.literal or not isfinite(value_of(value)):
        return render(_tree(value))
    number = float(value_of(value))
    return int(number) if number.is_integer() and abs(number) < LARGEST_WHOLE else number


def _tree(node: Node) -> Expr:
    """An expression of constants that means a node."""
    if node.literal:
        return _literal(value_of(node))
    if node.operation == "slot":
        return Name(node.slot.name, NOWHERE)
    operands = tuple(_tree(operand) for operand in node.operands)
    match node.operation, operands:
        case "negate", (operand,):
            return Unary("-", operand, NOWHERE)
        case "not", (operand,):
            return Unary("not", operand, NOWHERE)
        case "whole_power", (base,):
            return Binary("**", base, Number(float(node.index), NOWHERE), NOWHERE)
        case "select", (condition, then, otherwise):
            return Conditional(condition, then, otherwise, NOWHERE)
        case operation, (left, right) if operation in BINARY:
            return Binary(BINARY[operation], left, right, NOWHERE)
        case operation, _ if operation in COMPARISONS:
            return Comparison((operation,), operands, NOWHERE)
        case operation, _ if operation in LOGICAL:
            return Logical(LOGICAL[operation], operands, NOWHERE)
    return Call(CALLS[node.operation], operands, NOWHERE)


def _literal(value: float | bool) -> Expr:
    """A literal; numbers that cannot be written, as the division that gives them."""
    if isinstance(value, bool):
        return Truth(value, NOWHERE)
    if isfinite(value):
        return Number(value, NOWHERE)
    over = 0.0 if isnan(value) else copysign(1.0, value)
    return Binary("/", Number(over, NOWHERE), Number(0.0, NOWHERE), NOWHERE)
