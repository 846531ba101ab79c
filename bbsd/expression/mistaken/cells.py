"""Comparisons with cells of partitions, which expressions do not know."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.scope import Unusable
from bbsd.expression.syntax.mistakes import Rewriting
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Comparison, Name
from bbsd.expression.vocabulary import DRAWS

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
    condition = render(parse(condition))
    advice = f"write the condition that makes the cell: {condition}"
    # A condition of several parts binds weaker than a comparison; in parentheses it means the same everywhere.
    new = f"({condition})" if " and " in condition or condition.startswith("not ") else condition
    correction = Rewriting(new, expr.span, is_certain=not draws_again(condition))
    return scope.mistake(CELL, message, expr.span, advice, correction)


def draws_again(condition: str) -> bool:
    """Return whether a condition draws numbers, which would be others than those that the cell was drawn with."""
    return any(f"{draw}(" in condition for draw in DRAWS)
