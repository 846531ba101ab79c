"""Comparisons with cells of partitions, which expressions do not know."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.scope import Unusable
from bbsd.expression.syntax.mistakes import Rewriting
from bbsd.expression.syntax.tree import Comparison, Name

if TYPE_CHECKING:
    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Scope

CELL = "BB067"
"""The code of the use of a partition as a value."""


def compared_with_cell(expr: Comparison, scope: Scope) -> Node | None:
    """Report the comparison of a partition's name with one of its cells, and return the unknown value; else None."""
    match expr:
        case Comparison(operators=("==" | "!=" as operator,), operands=(Name(name=name), Name(name=cell))):
            pass
        case _:
            return None
    partition = scope.names.get(name)
    if (
        name in scope.local
        or not isinstance(partition, Unusable)
        or cell in scope.names
        or cell in scope.local
    ):
        return None
    if cell not in partition.cells:
        return None
    message = f"{cell} is a cell of {name}, and only rules know cells"
    condition = partition.cells[cell] if operator == "==" else f"not ({partition.cells[cell]})"
    advice = f"write the condition that makes the cell: {condition}"
    # A conditional's parts bind weaker than a comparison's; in parentheses it means the same everywhere.
    new = f"({condition})" if " and " in condition or condition.startswith("not ") else condition
    return scope.mistake(CELL, message, expr.span, advice, Rewriting(new, expr.span))
