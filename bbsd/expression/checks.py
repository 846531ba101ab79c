"""What a value and the arguments of a call must be; whatever they are not is told of once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.kinds import Kind
from bbsd.expression.tree import Each

if TYPE_CHECKING:
    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Scope, Value
    from bbsd.expression.tree import Call, Span

ADVICE = {Kind.TRUTH: "write the condition as: 1 if ... else 0", Kind.NUMBER: "compare it with something"}


def of_kind(found: Value, kind: Kind, span: Span, scope: Scope) -> Node:
    """The value as one of that kind; anything else but what was not understood is a mistake."""
    if isinstance(found, tuple):
        advice = "take an element or an aggregate of it"
        return scope.mistake("BB056", f"a list, where {kind.value} is needed", span, advice)
    if found.kind not in (kind, Kind.UNKNOWN):
        message = f"{found.kind.value}, where {kind.value} is needed"
        return scope.mistake("BB055", message, span, ADVICE.get(found.kind, ""))
    return found


def known_whole(found: Value, purpose: str, span: Span, scope: Scope) -> int | None:
    """The value as a whole number that is the same for the whole run; None after a mistake."""
    node = of_kind(found, Kind.NUMBER, span, scope)
    if node.kind is Kind.UNKNOWN:
        return None
    known = scope.known(node)
    if known is None or not known.is_integer():
        message = f"{purpose} must be a whole number that is the same for the whole run"
        scope.mistake("BB064", message, span)
        return None
    return int(known)


def has_arguments(call: Call, wanted: int, scope: Scope) -> bool:
    """Whether a call has as many arguments as are wanted, none of them a generator."""
    if any(isinstance(argument, Each) for argument in call.arguments):
        scope.mistake("BB062", f"{call.function} takes no generator", call.span)
        return False
    if len(call.arguments) != wanted:
        takes = f"{wanted} argument{'s' * (wanted != 1)}"
        scope.mistake("BB054", f"{call.function} takes {takes}, not {len(call.arguments)}", call.span)
        return False
    return True
