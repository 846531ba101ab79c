"""Aggregates: what they go through, and what they make of it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.checks import has_arguments, known_whole, of_kind
from bbsd.expression.kinds import Kind
from bbsd.expression.lookup import unseen
from bbsd.expression.operations import BY_AGGREGATE
from bbsd.expression.tree import Call, Each, Name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.graph import Node
    from bbsd.expression.lookup import Elaborate
    from bbsd.expression.scope import Scope, Value
    from bbsd.expression.tree import Expr, Span

MAX_ELEMENTS = 10_000
"""Of a list, with those of the lists in it."""

ELEMENT_WORK = 5


class Element(NamedTuple):
    """One of the values aggregated: what `argmin` would give for it, the value, and where it is written."""

    label: Value
    value: Value
    span: Span


def aggregate(expr: Call, scope: Scope, elaborate: Elaborate) -> Value:
    """The value of an aggregate of arguments, of a list, or of a generator."""
    elements = _elements(expr, scope, elaborate)
    if elements is None:
        return scope.graph.unknown
    if expr.function == "list":
        return _list(expr, elements, scope)
    if not elements:
        return scope.mistake("BB056", f"{expr.function} of nothing", expr.span)
    kind = Kind.TRUTH if expr.function in ("any", "all") else Kind.NUMBER
    nodes = [of_kind(element.value, kind, element.span, scope) for element in elements]
    if any(node.kind is Kind.UNKNOWN for node in nodes):
        return scope.graph.unknown
    if expr.function in ("argmin", "argmax"):
        return _best(expr, elements, nodes, scope)
    return _folded(expr.function, nodes, scope)


def _list(expr: Call, elements: Sequence[Element], scope: Scope) -> Value:
    size = 0
    for element in elements:
        size += _size(element.value)
        if size > MAX_ELEMENTS:
            return scope.mistake("BB060", f"a list of more than {MAX_ELEMENTS} elements", expr.span)
    return tuple(element.value for element in elements)


def _size(value: Value) -> int:
    return sum(_size(item) for item in value) if isinstance(value, tuple) else 1


def _folded(function: str, nodes: Sequence[Node], scope: Scope) -> Node:
    graph = scope.graph
    if function == "mean":
        return graph.apply("divide", graph.fold("+", nodes), graph.number(len(nodes)))
    return graph.fold(BY_AGGREGATE[function], nodes)


def _best(expr: Call, elements: Sequence[Element], nodes: Sequence[Node], scope: Scope) -> Node:
    labels = [element.label for element in elements if not isinstance(element.label, tuple)]
    if len(labels) < len(elements):
        return scope.mistake("BB062", f"{expr.function} needs one number after for, not a row", expr.span)
    graph, operation = scope.graph, "<" if expr.function == "argmin" else ">"
    best, chosen = nodes[0], labels[0]
    for node, label in zip(nodes[1:], labels[1:], strict=True):
        better = graph.apply(operation, node, best)
        best, chosen = graph.apply("select", better, node, best), graph.apply("select", better, label, chosen)
    return chosen


def _elements(expr: Call, scope: Scope, elaborate: Elaborate) -> list[Element] | None:
    match expr.arguments:
        case (Each() as each,):
            return _generated(each, scope, elaborate)
        case (argument,):
            return _listed(expr, argument, elaborate(argument, scope), scope)
        case arguments if any(isinstance(argument, Each) for argument in arguments):
            scope.mistake("BB062", "a generator must be the only argument", expr.span)
            return None
    found = [(argument.span, elaborate(argument, scope)) for argument in expr.arguments]
    return [Element(scope.graph.number(place), value, span) for place, (span, value) in enumerate(found)]


def _listed(expr: Call, argument: Expr, found: Value, scope: Scope) -> list[Element] | None:
    """The elements of one argument: those of a list; one value is a list of one, and no more than that."""
    items = found if isinstance(found, tuple) else (found,)
    if not isinstance(found, tuple) and found.kind is not Kind.UNKNOWN and expr.function != "list":
        advice = "give it several, a list, or (e for v in ...)"
        scope.mistake("BB056", f"{expr.function} of one value", expr.span, advice)
        return None
    return [Element(scope.graph.number(place), item, argument.span) for place, item in enumerate(items)]


def _generated(each: Each, scope: Scope, elaborate: Elaborate) -> list[Element] | None:
    elements: list[Element] = []
    items = _source(each, scope, elaborate)
    scope.graph.spend(len(items or ()) * ELEMENT_WORK)
    for place, item in enumerate(items or ()):
        names = _unpacked(each, item, scope)
        if names is None:
            return None
        draws = scope.draws and replace(scope.draws, elements=(*scope.draws.elements, place))
        value = elaborate(each.element, scope.inside(names, draws))
        elements.append(Element(item, value, each.element.span))
    return None if items is None else elements


def _unpacked(each: Each, item: Value, scope: Scope) -> dict[str, Value] | None:
    if len(each.names) == 1:
        return {each.names[0]: item}
    if isinstance(item, tuple) and len(item) == len(each.names):
        return dict(zip(each.names, item, strict=True))
    if isinstance(item, tuple) or item.kind is not Kind.UNKNOWN:
        has = f"has {len(item)} numbers" if isinstance(item, tuple) else "is one value"
        scope.mistake("BB062", f"{len(each.names)} names after for, but an element {has}", each.span)
    return None


def _source(each: Each, scope: Scope, elaborate: Elaborate) -> Sequence[Value] | None:
    match each.source:
        case Name(name="team" | "others" as name) if scope.behavior:
            unseen("the whole team" if name == "team" else "the other robots", each.source.span, scope)
            return None
        case Name(name="team"):
            return [scope.graph.number(robot) for robot in range(scope.robots)]
        case Name(name="others"):
            return _others(each.source, scope)
        case Call(function="range") as call:
            return _range(call, scope, elaborate)
    found = elaborate(each.source, scope)
    if isinstance(found, tuple):
        return found
    if found.kind is not Kind.UNKNOWN:
        advice = "after in stands team, others, range(n) or a list"
        scope.mistake("BB062", "this is one value and cannot be gone through", each.source.span, advice)
    return None


def _others(source: Name, scope: Scope) -> Sequence[Value] | None:
    if scope.robot is None:
        message = "others has a meaning only for one robot; here the team is meant"
        scope.mistake("BB059", message, source.span)
        return None
    return [scope.graph.number(robot) for robot in range(scope.robots) if robot != scope.robot]


def _range(call: Call, scope: Scope, elaborate: Elaborate) -> Sequence[Value] | None:
    if not has_arguments(call, 1, scope):
        return None
    (count,) = call.arguments
    length = known_whole(elaborate(count, scope), "a range's length", count.span, scope)
    if length is None:
        return None
    if length > MAX_ELEMENTS:
        message = f"a range of {length}; at most {MAX_ELEMENTS} elements are allowed"
        scope.mistake("BB060", message, call.span)
        return None
    return [scope.graph.number(place) for place in range(length)]
