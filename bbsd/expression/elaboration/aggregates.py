"""Aggregates: their elements, from a list, a generator or arguments, and their values."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.elaboration.checks import has_arguments, require_kind, require_static_whole
from bbsd.expression.elaboration.lookup import report_unseen
from bbsd.expression.graph import Node
from bbsd.expression.kinds import Kind
from bbsd.expression.operations import BY_AGGREGATE
from bbsd.expression.syntax.tree import Call, Generator, Name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.elaboration.lookup import Elaborate
    from bbsd.expression.scope import Scope, Value
    from bbsd.expression.syntax.tree import Expr, Span

MAX_ELEMENTS = 10_000
"""The most elements of a list, those of the lists in it included."""

ELEMENT_WORK = 5
"""The work of an element of a generator, beside that of its nodes."""


class Element(NamedTuple):
    """One of the values aggregated: its label, which `argmin` gives, the value, and where it is written."""

    label: Value
    value: Value
    span: Span


def aggregate(expr: Call, scope: Scope, elaborate: Elaborate) -> Value:
    """Return the value of an aggregate of arguments, of a list, or of a generator."""
    elements = _elements(expr, scope, elaborate)
    if elements is None:
        return scope.graph.unknown
    if expr.function == "list":
        return _list(expr, elements, scope)
    if not elements:
        return scope.mistake("BB056", f"{expr.function} of nothing", expr.span)
    kind = Kind.TRUTH if expr.function in ("any", "all") else Kind.NUMBER
    nodes = [require_kind(element.value, kind, element.span, scope) for element in elements]
    if any(node.kind is Kind.UNKNOWN for node in nodes):
        return scope.graph.unknown
    if expr.function in ("argmin", "argmax"):
        return _label_of_best(expr, elements, nodes, scope)
    return _fold(expr.function, nodes, scope)


def _list(expr: Call, elements: Sequence[Element], scope: Scope) -> Value:
    size = 0
    for element in elements:
        size += _size(element.value)
        if size > MAX_ELEMENTS:
            return scope.mistake("BB060", f"a list of more than {MAX_ELEMENTS} elements", expr.span)
    return tuple(element.value for element in elements)


def _size(value: Value) -> int:
    return sum(_size(item) for item in value) if isinstance(value, tuple) else 1


def _fold(function: str, nodes: Sequence[Node], scope: Scope) -> Node:
    graph = scope.graph
    if function == "mean":
        return graph.apply("divide", graph.fold("+", nodes), graph.number(len(nodes)))
    return graph.fold(BY_AGGREGATE[function], nodes)


def _label_of_best(expr: Call, elements: Sequence[Element], nodes: Sequence[Node], scope: Scope) -> Node:
    labels = [element.label for element in elements if isinstance(element.label, Node)]
    if len(labels) < len(elements):
        return scope.mistake(
            "BB062", f"{expr.function} needs one number after for, not a row or a name", expr.span
        )
    graph, operation = scope.graph, "<" if expr.function == "argmin" else ">"
    best, its_label = nodes[0], labels[0]
    for node, label in zip(nodes[1:], labels[1:], strict=True):
        better = graph.apply(operation, node, best)
        best = graph.apply("select", better, node, best)
        its_label = graph.apply("select", better, label, its_label)
    return its_label


def _elements(expr: Call, scope: Scope, elaborate: Elaborate) -> list[Element] | None:
    match expr.arguments:
        case (Generator() as generator,):
            if isinstance(generator.source, Call) and len(generator.source.arguments) == 2:
                from bbsd.expression.mistaken.calls import from_first_to_last

                if (instead := from_first_to_last(generator, expr.function)) is not None:
                    message = "range takes 1 argument, not 2: it counts from 0"
                    scope.mistake("BB054", message, generator.source.span, *instead)
                    return None
            return _of_generator(generator, scope, elaborate)
        case (argument,):
            return _of_list(expr, argument, elaborate(argument, scope), scope)
        case arguments if any(isinstance(argument, Generator) for argument in arguments):
            scope.mistake("BB062", "a generator must be the only argument", expr.span)
            return None
    values = [(argument.span, elaborate(argument, scope)) for argument in expr.arguments]
    return [Element(scope.graph.number(index), value, span) for index, (span, value) in enumerate(values)]


def _of_list(expr: Call, argument: Expr, value: Value, scope: Scope) -> list[Element] | None:
    """Return the elements of one argument, which must be a list; but list(...) may have one value."""
    items = value if isinstance(value, tuple) else (value,)
    if not isinstance(value, tuple) and value.kind is not Kind.UNKNOWN and expr.function != "list":
        from bbsd.expression.mistaken.calls import Instead, of_all_robots

        instead = of_all_robots(argument, expr.function, scope)
        advice, correction = instead or Instead("give it several, a list, or (e for v in ...)", None)
        scope.mistake("BB056", f"{expr.function} of one value", expr.span, advice, correction)
        return None
    return [Element(scope.graph.number(index), item, argument.span) for index, item in enumerate(items)]


def _of_generator(generator: Generator, scope: Scope, elaborate: Elaborate) -> list[Element] | None:
    elements: list[Element] = []
    items = _source(generator, scope, elaborate)
    scope.graph.spend(len(items or ()) * ELEMENT_WORK)
    for index, item in enumerate(items or ()):
        names = _unpack(generator, item, scope)
        if names is None:
            return None
        draws = scope.draws and scope.draws._replace(elements=(*scope.draws.elements, index))
        value = elaborate(generator.element, scope.inside(names, draws))
        elements.append(Element(item, value, generator.element.span))
    return None if items is None else elements


def _unpack(generator: Generator, item: Value, scope: Scope) -> dict[str, Value] | None:
    if len(generator.names) == 1:
        return {generator.names[0]: item}
    if isinstance(item, tuple) and len(item) == len(generator.names):
        return dict(zip(generator.names, item, strict=True))
    if isinstance(item, tuple) or item.kind is not Kind.UNKNOWN:
        has = f"has {len(item)} numbers" if isinstance(item, tuple) else "is one value"
        scope.mistake(
            "BB062", f"{len(generator.names)} names after for, but an element {has}", generator.span
        )
    return None


def _source(generator: Generator, scope: Scope, elaborate: Elaborate) -> Sequence[Value] | None:
    match generator.source:
        case Name(name="team" | "others" as name) if scope.behavior:
            report_unseen(
                "the whole team" if name == "team" else "the other robots", generator.source.span, scope
            )
            return None
        case Name(name="team"):
            return [scope.graph.number(robot) for robot in range(scope.robots)]
        case Name(name="others"):
            return _others(generator.source, scope)
        case Call(function="range") as call:
            return _range(call, scope, elaborate)
    items = elaborate(generator.source, scope)
    if isinstance(items, tuple):
        return items
    if items.kind is not Kind.UNKNOWN:
        advice = "after in stands team, others, range(n) or a list"
        scope.mistake("BB062", "this is one value and cannot be gone through", generator.source.span, advice)
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
    length = require_static_whole(elaborate(count, scope), "a range's length", count.span, scope)
    if length is None:
        return None
    if length > MAX_ELEMENTS:
        message = f"a range of {length}; at most {MAX_ELEMENTS} elements are allowed"
        scope.mistake("BB060", message, call.span)
        return None
    return [scope.graph.number(index) for index in range(length)]
