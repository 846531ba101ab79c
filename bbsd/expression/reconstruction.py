"""Graph to tree, the mirror of elaboration: an expression of the language that means a node."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import value_of
from bbsd.expression.operations import COMPARISONS, OPERATIONS
from bbsd.expression.syntax.tree import (
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
)

if TYPE_CHECKING:
    from bbsd.expression.graph import Node

NOWHERE = Span(0, 0)


def reconstruct(node: Node) -> Expr:
    """Return an expression that means a node of literals, slots of the world and operations on them."""
    if node.literal:
        return _literal(value_of(node))
    if node.operation == "slot":
        return Name(node.slot.name, NOWHERE)
    operands = tuple(reconstruct(operand) for operand in node.operands)
    match node.operation, operands:
        case "negate", (operand,):
            return Unary("-", operand, NOWHERE)
        case "not", (operand,):
            return Unary("not", operand, NOWHERE)
        case "whole_power", (base,):
            return Binary("**", base, Number(float(node.index), NOWHERE), NOWHERE)
        case "select", (condition, then, otherwise):
            return Conditional(condition, then, otherwise, NOWHERE)
        case "&" | "|", _:
            return Logical(OPERATIONS[node.operation].word, operands, NOWHERE)
    word = OPERATIONS[node.operation].word
    if node.operation in COMPARISONS:
        return Comparison((word,), operands, NOWHERE)
    if word.isidentifier():
        return Call(word, operands, NOWHERE)
    left, right = operands
    return Binary(word, left, right, NOWHERE)


def _literal(value: float) -> Expr:
    return Truth(value, NOWHERE) if isinstance(value, bool) else Number(value, NOWHERE)
