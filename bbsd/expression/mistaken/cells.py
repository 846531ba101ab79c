"""Comparisons with cells of partitions, which expressions do not know."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.scope import Unusable
from bbsd.expression.syntax.mistakes import Rewriting
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Comparison, Name, Number
from bbsd.expression.vocabulary import DRAWS

if TYPE_CHECKING:
    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Scope

CELL = "BB067"
"""The code of the use of a partition as a value."""


def compared_with_cell(expr: Comparison, scope: Scope) -> Node | None:
    """Report the comparison of a partition's name with one of its cells, and return the unknown value; else None."""
    if (told := _compared_with_number(expr, scope)) is not None:
        return told
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


def _compared_with_number(expr: Comparison, scope: Scope) -> Node | None:
    """Report the comparison of a partition that cuts a number with a number: that number is meant."""
    match expr:
        case Comparison(operators=(operator,), operands=(Name(name=name), Number() as bound)):
            partition = scope.names.get(name)
        case _:
            return None
    if name in scope.local or not isinstance(partition, Unusable):
        return None
    first = next(iter(partition.cells.items()), ("", ""))
    number, sign, _ = first[1].rpartition(" < ")
    if not first[0].startswith("below ") or not sign:
        return None
    new = f"{number} {operator} {render(bound)}"
    message = f"{name} is a partition, not a value"
    correction = Rewriting(new, expr.span, is_certain=not draws_again(number))
    return scope.mistake(CELL, message, expr.span, f"write what it cuts: {new}", correction)


def draws_again(condition: str) -> bool:
    """Return whether a condition draws numbers, which would be others than those that the cell was drawn with."""
    return any(f"{draw}(" in condition for draw in DRAWS)
