"""Calls of what is no function of the language."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import nearest
from bbsd.expression.foreign.functions import other_name
from bbsd.expression.mistaken.calls import LENGTHS, Instead, indexed, number_of_elements
from bbsd.expression.scope import Definition, Unusable
from bbsd.expression.syntax.mistakes import Rewriting
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Generator, Span
from bbsd.expression.vocabulary import AGGREGATES, DRAWS, FUNCTIONS, PARTITIONS, SOURCES

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Scope, Value
    from bbsd.expression.syntax.tree import Call, Expr


def report_uncallable(expr: Call, scope: Scope, elaborate: Callable[[Expr, Scope], Value]) -> Node:
    """Report a call of what is no function, with what is probably meant, and return the unknown value."""
    name, binding = expr.function, scope.names.get(expr.function)
    if isinstance(binding, Unusable) and not binding.reason:
        return scope.graph.unknown
    if name in PARTITIONS:
        message = f"{name}(...) cuts an input or a sensor into cells; it is not a number"
        return scope.mistake("BB053", message, expr.span)
    if name in SOURCES:
        return scope.mistake("BB053", f"{name} can only stand after in", expr.span)
    if binding is not None or name in scope.local:
        instead = indexed(expr, scope) or Instead("", None)
        return scope.mistake("BB053", f"{name} is not a function", expr.span, *instead)
    span, message = Span(expr.span.start, len(name)), f'unknown function "{name}"'
    match expr.arguments:
        case (argument,) if name in LENGTHS and not isinstance(argument, Generator):
            length = number_of_elements(expr, elaborate(argument, scope), scope)
            if length is not None:
                return scope.mistake("BB053", message, span, *length)
    if (other := other_name(name, [render(argument) for argument in expr.arguments])) is not None:
        new, is_certain = other
        return scope.mistake("BB053", message, span, f"write {new}", Rewriting(new, expr.span, is_certain))
    definitions = [key for key, bound in scope.names.items() if isinstance(bound, Definition)]
    near = nearest(name, [*FUNCTIONS, *AGGREGATES, *DRAWS, "before", *definitions])
    hint = f'; did you mean "{near}"?' if near else ""
    correction = Rewriting(near, span, is_certain=False) if near else None
    return scope.mistake("BB053", f"{message}{hint}", span, correction=correction)
