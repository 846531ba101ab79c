"""Tree to graph: one expression, for one robot, in one scope. All mistakes that can be told apart are found together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from bbsd.errors import did_you_mean
from bbsd.expression import picking
from bbsd.expression.graph import Kind, Node, value_of
from bbsd.expression.scope import Deferred, Definition, Draws, PerRobot, Scope, Shared, Unusable, Value
from bbsd.expression.tree import (
    Binary,
    Call,
    Comparison,
    Conditional,
    Each,
    Expr,
    Index,
    Logical,
    Name,
    Number,
    Span,
    Truth,
    Unary,
    parts,
)
from bbsd.expression.vocabulary import AGGREGATES, CONSTANTS, DRAWS, FUNCTIONS, PARTITIONS, SOURCES
from bbsd.kernel.streams import fold, name_word, word_of

MAX_ELEMENTS = 10_000
MAX_WHOLE_POWER = 64


def number(expr: Expr, scope: Scope) -> Node:
    """The expression as a number; anything else is a mistake."""
    return _scalar(expr, _enter(expr, scope), Kind.NUMBER)


def truth(expr: Expr, scope: Scope) -> Node:
    """The expression as a truth; anything else is a mistake."""
    return _scalar(expr, _enter(expr, scope), Kind.TRUTH)


def value(expr: Expr, scope: Scope) -> Value:
    """The expression as whatever it is: a number, a truth or a list."""
    return _value(expr, _enter(expr, scope))


def scalar(expr: Expr, scope: Scope) -> Node:
    """The expression as a number or a truth; a list is a mistake."""
    found = value(expr, scope)
    if isinstance(found, tuple):
        return scope.mistake("BB056", "a list, where one value is needed", expr.span, "take an element or an aggregate of it")
    return found


def one(found: Value) -> Node:
    """A value that is known not to be a list."""
    assert isinstance(found, Node)
    return found


def whole(expr: Expr, scope: Scope, purpose: str) -> Node:
    """The expression as a number that must turn out to be whole."""
    found = number(expr, scope)
    scope.findings.wholes.append((scope.path, expr.span, purpose, found))
    return found


def static_whole(expr: Expr, scope: Scope, purpose: str) -> int | None:
    """The expression as a whole number that is the same for the whole run, or None after a mistake."""
    found = number(expr, scope)
    if found.kind is Kind.UNKNOWN:
        return None
    known = scope.static(found) if not found.literal else value_of(found)
    if known is None or not float(known).is_integer():
        scope.mistake("BB064", f"{purpose} must be a whole number that is the same for the whole run", expr.span)
        return None
    return int(known)


def _enter(expr: Expr, scope: Scope) -> Scope:
    if scope.draws is None or scope.draws.ordinals:
        return scope
    ordinals = {call.span: ordinal for ordinal, call in enumerate(_draws_in(expr))}
    return replace(scope, draws=replace(scope.draws, ordinals=ordinals))


def _draws_in(expr: Expr) -> list[Call]:
    own = [expr] if isinstance(expr, Call) and expr.function in DRAWS else []
    return own + [call for part in parts(expr) for call in _draws_in(part)]


def _scalar(expr: Expr, scope: Scope, kind: Kind) -> Node:
    found = _value(expr, scope)
    if isinstance(found, tuple):
        return scope.mistake("BB056", f"a list, where {kind.value} is needed", expr.span, "take an element or an aggregate of it")
    if found.kind not in (kind, Kind.UNKNOWN):
        advice = "write the condition as: 1 if ... else 0" if found.kind is Kind.TRUTH else "compare it with something"
        return scope.mistake("BB055", f"{found.kind.value}, where {kind.value} is needed", expr.span, advice)
    return found


def _numbers(exprs: Sequence[Expr], scope: Scope) -> list[Node]:
    return [_scalar(expr, scope, Kind.NUMBER) for expr in exprs]


def _truths(exprs: Sequence[Expr], scope: Scope) -> list[Node]:
    return [_scalar(expr, scope, Kind.TRUTH) for expr in exprs]


ARITHMETIC = {"+": "+", "-": "-", "*": "*", "/": "divide", "//": "floor_divide", "%": "modulo"}


def _value(expr: Expr, scope: Scope) -> Value:
    graph = scope.graph
    match expr:
        case Number(value=literal):
            return graph.number(literal)
        case Truth(value=literal):
            return graph.truth(value=literal)
        case Name(name=name):
            return _name(name, expr.span, scope)
        case Unary(operator="not", operand=operand):
            return graph.apply("not", _scalar(operand, scope, Kind.TRUTH))
        case Unary(operator=sign, operand=operand):
            inner = _scalar(operand, scope, Kind.NUMBER)
            return graph.apply("negate", inner) if sign == "-" else inner
        case Binary(operator="**"):
            return _power(expr, scope)
        case Binary(operator=operator, left=left, right=right):
            return graph.apply(ARITHMETIC[operator], *_numbers((left, right), scope))
        case Comparison():
            return _comparison(expr, scope)
        case Logical(operator=operator, operands=operands):
            return graph.fold("&" if operator == "and" else "|", _truths(operands, scope))
        case Conditional():
            return _conditional(expr, scope)
        case Call():
            return _call(expr, scope)
        case Index(of=of, index=index):
            return _index(of, index, scope)
        case Each():
            return scope.mistake("BB062", "a generator can only be the one argument of an aggregate", expr.span)


def _name(name: str, span: Span, scope: Scope) -> Value:
    if name in scope.local:
        return scope.local[name]
    if name in CONSTANTS:
        return scope.graph.number(CONSTANTS[name])
    match scope.names.get(name):
        case Shared(value=found):
            return found
        case Deferred(value=make):
            return make()
        case PerRobot(value=of_robot):
            if scope.robot is not None:
                return of_robot(scope.robot)
            return _no_robot(name, span, scope)
        case Definition(parameters=()) as definition:
            return _definition(name, definition, (), scope)
        case Definition(parameters=parameters):
            return scope.mistake("BB054", f"{name} needs arguments: {name}({', '.join(parameters)})", span)
        case Unusable(code=code, reason=reason, advice=advice):
            return scope.mistake(code, reason, span, advice) if reason else scope.graph.unknown
        case None:
            return _unknown_name(name, span, scope)


def _no_robot(name: str, span: Span, scope: Scope) -> Node:
    advice = f"use an aggregate, like max({name}[r] for r in team), or one robot's, like {name}[0]"
    return scope.mistake("BB059", f"{name} is one value for each robot; here the team is meant", span, advice)


def _unknown_name(name: str, span: Span, scope: Scope) -> Node:
    if name in FUNCTIONS or name in AGGREGATES or name in DRAWS:
        return scope.mistake("BB052", f"{name} is a function and needs its arguments in parentheses", span)
    if name in ("team", "others"):
        return scope.mistake("BB052", f"{name} can only stand after in: max(x[r] for r in {name})", span)
    known = [*scope.local, *scope.names, *CONSTANTS]
    return scope.mistake("BB052", f'unknown name "{name}"{did_you_mean(name, known)}', span)


def _definition(name: str, definition: Definition, arguments: tuple[Value, ...], scope: Scope) -> Value:
    key = (name, scope.robot, arguments)
    if key not in scope.memo:
        local = dict(zip(definition.parameters, arguments, strict=True))
        inner = replace(scope, path=definition.path, local=local, draws=None)
        scope.memo[key] = _value(definition.expression, inner)
    return scope.memo[key]


def _power(expr: Binary, scope: Scope) -> Value:
    base = _scalar(expr.left, scope, Kind.NUMBER)
    exponent = _scalar(expr.right, scope, Kind.NUMBER)
    if Kind.UNKNOWN in (base.kind, exponent.kind):
        return scope.graph.unknown
    known = value_of(exponent) if exponent.literal else scope.static(exponent)
    if known is not None and float(known).is_integer() and abs(known) <= MAX_WHOLE_POWER:
        return scope.graph.apply("whole_power", base, data=int(known))
    if known is None and not (base.literal or scope.static(base) is not None):
        return scope.mistake("BB061", "a power of a changing number needs a constant exponent", expr.right.span, "write exp(y * log(x))")
    return scope.graph.apply("power", base, exponent)


def _comparison(expr: Comparison, scope: Scope) -> Value:
    values = [_value(operand, scope) for operand in expr.operands]
    for found, operand in zip(values, expr.operands, strict=True):
        if isinstance(found, tuple):
            return scope.mistake("BB056", "lists cannot be compared", operand.span, "compare elements, or use any(...) or all(...)")
    nodes = [found for found in values if isinstance(found, Node)]
    kinds = {node.kind for node in nodes} - {Kind.UNKNOWN}
    equality = set(expr.operators) <= {"==", "!="}
    if len(kinds) > 1:
        return scope.mistake("BB055", "a truth is compared with a number", expr.span)
    if kinds == {Kind.TRUTH} and not equality:
        return scope.mistake("BB055", "truths have no order; they can only be == or !=", expr.span)
    pairs = zip(expr.operators, nodes, nodes[1:], strict=False)
    return scope.graph.fold("&", [scope.graph.apply(operator, left, right) for operator, left, right in pairs])


def _conditional(expr: Conditional, scope: Scope) -> Value:
    condition = _scalar(expr.condition, scope, Kind.TRUTH)
    arms = [_value(arm, scope) for arm in (expr.then, expr.otherwise)]
    for found, arm in zip(arms, (expr.then, expr.otherwise), strict=True):
        if isinstance(found, tuple):
            return scope.mistake("BB056", "a conditional chooses between single values, not lists", arm.span)
    then, otherwise = (found for found in arms if isinstance(found, Node))
    if len({then.kind, otherwise.kind} - {Kind.UNKNOWN}) > 1:
        return scope.mistake("BB055", f"one arm is {then.kind.value}, the other {otherwise.kind.value}", expr.span)
    return scope.graph.apply("select", condition, then, otherwise)


def _call(expr: Call, scope: Scope) -> Value:
    name = expr.function
    binding = scope.names.get(name)
    if isinstance(binding, Definition):
        return _call_definition(expr, binding, scope)
    if name in FUNCTIONS:
        wanted = FUNCTIONS[name]
        if not _arity(expr, wanted.arity, scope):
            return scope.graph.unknown
        return scope.graph.apply(wanted.operation, *_numbers(expr.arguments, scope))
    if name in AGGREGATES:
        return _aggregate(expr, scope)
    if name in DRAWS:
        return _draw(expr, scope)
    if name == "before":
        return _before(expr, scope)
    if name in PARTITIONS:
        return scope.mistake("BB053", f"{name}(...) cuts an input or a sensor into cells; it is not a number", expr.span)
    if name in SOURCES:
        return scope.mistake("BB053", f"{name} can only stand after in", expr.span)
    if binding is not None or name in scope.local:
        return scope.mistake("BB053", f"{name} is not a function", expr.span)
    known = [*FUNCTIONS, *AGGREGATES, *DRAWS, "before", *(key for key, found in scope.names.items() if isinstance(found, Definition))]
    return scope.mistake("BB053", f'unknown function "{name}"{did_you_mean(name, known)}', Span(expr.span.start, len(name)))


def _arity(expr: Call, wanted: int, scope: Scope) -> bool:
    if any(isinstance(argument, Each) for argument in expr.arguments):
        scope.mistake("BB062", f"{expr.function} takes no generator", expr.span)
        return False
    if len(expr.arguments) != wanted:
        scope.mistake("BB054", f"{expr.function} takes {wanted} argument{'s' * (wanted != 1)}, not {len(expr.arguments)}", expr.span)
        return False
    return True


def _call_definition(expr: Call, definition: Definition, scope: Scope) -> Value:
    if not definition.parameters:
        return scope.mistake("BB054", f"{expr.function} has no parameters; write it without parentheses", expr.span)
    if not _arity(expr, len(definition.parameters), scope):
        return scope.graph.unknown
    return _definition(expr.function, definition, tuple(_value(argument, scope) for argument in expr.arguments), scope)


def _before(expr: Call, scope: Scope) -> Value:
    earlier = scope if scope.starting else scope.before
    if earlier is None:
        return scope.mistake("BB065", "before(...) has a meaning only after the decision: in dynamics, sensors, reward and ends", expr.span)
    if not _arity(expr, 1, scope):
        return scope.graph.unknown
    then = replace(earlier, path=scope.path, robot=scope.robot, local=scope.local, draws=None)
    return _value(expr.arguments[0], then)


def _draw(expr: Call, scope: Scope) -> Value:
    if scope.draws is None:
        advice = "draw it as a state variable and use that"
        return scope.mistake("BB058", f"{expr.function}(...) cannot be drawn here", expr.span, advice)
    if not _arity(expr, DRAWS[expr.function][0], scope):
        return scope.graph.unknown
    operands = _numbers(expr.arguments, scope)
    if any(node.kind is Kind.UNKNOWN for node in operands):
        return scope.graph.unknown
    return scope.graph.draw(expr.function, _place_word(scope.draws, expr.span, scope.robot or 0), tuple(operands))


def _place_word(draws: Draws, span: Span, robot: int) -> int:
    """The name of a draw: its place in the spec, then the robot, then the elements of the generators around it."""
    word = name_word(f"{draws.place}#{draws.ordinals[span]}")
    for part in (robot, *draws.elements):
        word = fold(word, word_of(part))
    return word


def _index(of: Expr, index: Expr, scope: Scope) -> Value:
    if isinstance(of, Name) and of.name not in scope.local and scope.robots > 1:
        robots = _of_robots(of.name, scope)
        if robots is not None:
            return _pick(robots, index, scope)
    items = _value(of, scope)
    if isinstance(items, Node):
        if items.kind is Kind.UNKNOWN:
            return items
        return scope.mistake("BB057", "only lists, and what each robot has, can be indexed", of.span)
    return _pick(items, index, scope)


def _of_robots(name: str, scope: Scope) -> tuple[Value, ...] | None:
    """The values of all robots, where the name is one scalar for each of them; None where it is something else."""
    match scope.names.get(name):
        case PerRobot(value=of_robot):
            values = tuple(of_robot(robot) for robot in range(scope.robots))
        case Definition(parameters=()) as definition:
            values = tuple(_definition(name, definition, (), replace(scope, robot=robot)) for robot in range(scope.robots))
        case _:
            return None
    return values if isinstance(values[0], Node) else None


def _pick(items: tuple[Value, ...], index: Expr, scope: Scope) -> Value:
    chosen = _scalar(index, scope, Kind.NUMBER)
    if chosen.kind is Kind.UNKNOWN:
        return chosen
    if not items:
        return scope.mistake("BB057", "an empty list has no elements", index.span)
    scope.findings.wholes.append((scope.path, index.span, "an index", chosen))
    if len({len(item) if isinstance(item, tuple) else -1 for item in items}) > 1 and not chosen.literal:
        return scope.mistake("BB057", "rows of different lengths can only be indexed by a plain number", index.span)
    if chosen.literal and not 0 <= value_of(chosen) < len(items):
        return scope.mistake("BB057", f"there is no element {value_of(chosen):g}; the {len(items)} count from 0", index.span)
    return picking.pick(items, chosen, scope.graph)


def _aggregate(expr: Call, scope: Scope) -> Value:
    pairs = _elements(expr, scope)
    if pairs is None:
        return scope.graph.unknown
    labels, values, spans = zip(*pairs, strict=True) if pairs else ((), (), ())
    if expr.function == "list":
        return tuple(values)
    if not values:
        return scope.mistake("BB056", f"{expr.function} of nothing", expr.span)
    kind = Kind.TRUTH if expr.function in ("any", "all") else Kind.NUMBER
    nodes = [_element(found, kind, span, scope) for found, span in zip(values, spans, strict=True)]
    if any(node.kind is Kind.UNKNOWN for node in nodes):
        return scope.graph.unknown
    return _reduce(expr, nodes, labels, scope)


def _element(found: Value, kind: Kind, span: Span, scope: Scope) -> Node:
    if isinstance(found, tuple):
        return scope.mistake("BB056", f"an element is a list, where {kind.value} is needed", span)
    if found.kind not in (kind, Kind.UNKNOWN):
        return scope.mistake("BB055", f"an element is {found.kind.value}, where {kind.value} is needed", span)
    return found


FOLDED = {"min": "minimum", "max": "maximum", "sum": "+", "any": "|", "all": "&"}


def _reduce(expr: Call, nodes: list[Node], labels: tuple[Value, ...], scope: Scope) -> Value:
    graph = scope.graph
    if expr.function == "mean":
        return graph.apply("divide", graph.fold("+", nodes), graph.number(len(nodes)))
    if expr.function in FOLDED:
        return graph.fold(FOLDED[expr.function], nodes)
    if any(isinstance(label, tuple) for label in labels):
        return scope.mistake("BB062", f"{expr.function} needs one name after for", expr.span)
    best, chosen = nodes[0], labels[0]
    for node, label in zip(nodes[1:], labels[1:], strict=True):
        better = graph.apply("<" if expr.function == "argmin" else ">", node, best)
        assert isinstance(label, Node)
        assert isinstance(chosen, Node)
        best, chosen = graph.apply("select", better, node, best), graph.apply("select", better, label, chosen)
    return chosen


Element = tuple[Value, Value, Span]
"""What `argmin` would give, the element's value, and where it is written."""


def _elements(expr: Call, scope: Scope) -> list[Element] | None:
    match expr.arguments:
        case (Each() as each,):
            return _generated(each, scope)
        case (argument,):
            found = _value(argument, scope)
            if isinstance(found, tuple):
                return [(scope.graph.number(place), item, argument.span) for place, item in enumerate(found)]
            if found.kind is not Kind.UNKNOWN and expr.function != "list":
                scope.mistake("BB056", f"{expr.function} of one value", expr.span, "give it several, a list, or (e for v in ...)")
                return None
            return [(scope.graph.number(0), found, argument.span)]
        case arguments:
            if any(isinstance(argument, Each) for argument in arguments):
                scope.mistake("BB062", "a generator must be the only argument", expr.span)
                return None
            values = [(argument, _value(argument, scope)) for argument in arguments]
            return [(scope.graph.number(place), item, argument.span) for place, (argument, item) in enumerate(values)]


def _generated(each: Each, scope: Scope) -> list[Element] | None:
    items = _source(each, scope)
    if items is None:
        return None
    elements: list[Element] = []
    for place, item in enumerate(items):
        names = _unpack(each, item, scope)
        if names is None:
            return None
        inner = scope.binding(names)
        if scope.draws is not None:
            inner = replace(inner, draws=replace(scope.draws, elements=(*scope.draws.elements, place)))
        elements.append((item, _value(each.element, inner), each.element.span))
    return elements


def _unpack(each: Each, item: Value, scope: Scope) -> dict[str, Value] | None:
    if len(each.names) == 1:
        return {each.names[0]: item}
    if isinstance(item, tuple) and len(item) == len(each.names):
        return dict(zip(each.names, item, strict=True))
    has = f"has {len(item)} numbers" if isinstance(item, tuple) else "is one value"
    scope.mistake("BB062", f"{len(each.names)} names after for, but an element {has}", each.span)
    return None


def _source(each: Each, scope: Scope) -> Sequence[Value] | None:
    graph, source = scope.graph, each.source
    match source:
        case Name(name="team"):
            return [graph.number(robot) for robot in range(scope.robots)]
        case Name(name="others"):
            if scope.robot is None:
                scope.mistake("BB059", "others has a meaning only for one robot; here the team is meant", source.span)
                return None
            return [graph.number(robot) for robot in range(scope.robots) if robot != scope.robot]
        case Call(function="range", arguments=(count,)):
            length = static_whole(count, scope, "a range's length")
            if length is not None and length > MAX_ELEMENTS:
                scope.mistake("BB060", f"a range of {length}; at most {MAX_ELEMENTS} elements are allowed", source.span)
                return None
            return None if length is None else [graph.number(place) for place in range(length)]
        case _:
            found = _value(source, scope)
            if isinstance(found, tuple):
                return found
            if found.kind is not Kind.UNKNOWN:
                advice = "after in stands team, others, range(n) or a list"
                scope.mistake("BB062", "this is one value and cannot be gone through", source.span, advice)
            return None
