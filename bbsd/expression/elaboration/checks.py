"""Checks of values and of the arguments of calls, which report what does not fit."""

from __future__ import annotations

from math import isfinite, isnan
from typing import TYPE_CHECKING

from bbsd.expression.elaboration.naming import listed
from bbsd.expression.graph import value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.scope import Named
from bbsd.expression.syntax.mistakes import Enclosing
from bbsd.expression.syntax.tree import Generator

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Scope, Value
    from bbsd.expression.syntax.tree import Call, Span

AS_NUMBER = "1 if ", " else 0"
ADVICE = {Kind.TRUTH: "write the condition as: 1 if ... else 0", Kind.NUMBER: "compare it with something"}


def require_kind(value: Value, kind: Kind, span: Span, scope: Scope) -> Node:
    """Return a value of a kind, or the unknown one; report any other value and return the unknown one."""
    if isinstance(value, tuple):
        advice = "take an element or an aggregate of it"
        return scope.mistake("BB056", f"a list, where {kind.value} is needed", span, advice)
    if isinstance(value, Named):
        message = f"a named value, where {kind.value} is needed"
        name = value.names[0]
        advice = f"compare it: ... == {name}" if kind is Kind.TRUTH else f"write 1 if ... == {name} else 0"
        if kind is Kind.NUMBER and scope.path[-2:-1] != ("reward",) and scope.path[-1] in scope.names:
            advice = f"names have no next one: write which it becomes, {listed(value.names)}"
        return scope.mistake("BB139", message, span, advice)
    if value.kind not in (kind, Kind.UNKNOWN):
        message = f"{value.kind.value}, where {kind.value} is needed"
        correction = Enclosing(*AS_NUMBER, span) if value.kind is Kind.TRUTH else None
        return scope.mistake("BB055", message, span, ADVICE.get(value.kind, ""), correction)
    return value


def require_finite(value: Value, span: Span, scope: Scope) -> Value:
    """Return a value with literals that are infinite or not a number reported and replaced by unknown ones."""
    if isinstance(value, tuple):
        return tuple(require_finite(item, span, scope) for item in value)
    if isinstance(value, Named) or not value.literal or isfinite(value_of(value)):
        return value
    what = "not a number" if isnan(value_of(value)) else "infinite"
    return scope.mistake("BB125", f"this is {what}: it goes beyond binary64, or divides by zero", span)


def require_static_whole(value: Value, purpose: str, span: Span, scope: Scope) -> int | None:
    """Return a value as a whole number that is the same for the whole run; report any other value and return None."""
    node = require_kind(value, Kind.NUMBER, span, scope)
    if node.kind is Kind.UNKNOWN:
        return None
    number = scope.static_value(node)
    if number is None or not number.is_integer():
        message = f"{purpose} must be a whole number that is the same for the whole run"
        scope.mistake("BB064", message, span)
        return None
    return int(number)


def has_arguments(call: Call, wanted: int, scope: Scope, parameters: Sequence[str] = ()) -> bool:
    """Return whether a call has as many arguments as are wanted and no generator; report it if not."""
    if any(isinstance(argument, Generator) for argument in call.arguments):
        scope.mistake("BB062", f"{call.function} takes no generator", call.span)
        return False
    if len(call.arguments) != wanted:
        takes = f"{wanted} argument{'s' * (wanted != 1)}"
        from bbsd.expression.mistaken.calls import wrong_number

        message = f"{call.function} takes {takes}, not {len(call.arguments)}"
        scope.mistake("BB054", message, call.span, *wrong_number(call, parameters))
        return False
    return True
