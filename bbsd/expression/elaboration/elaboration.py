"""Tree to graph: one expression, for one robot, in one scope.

All independent mistakes are found at once: what could not be understood is unknown from then on, and nothing more is
reported of it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.expression.elaboration.aggregates import aggregate
from bbsd.expression.elaboration.checks import (
    has_arguments,
    require_finite,
    require_kind,
    require_static_whole,
)
from bbsd.expression.elaboration.lookup import call_definition, element, name_value
from bbsd.expression.elaboration.naming import report_unknown_values, settled
from bbsd.expression.elaboration.relations import comparison, conditional
from bbsd.expression.kinds import Kind
from bbsd.expression.mistaken.calls import mean_by_hand
from bbsd.expression.mistaken.draws import impossible_draw, missing_first, undrawn
from bbsd.expression.mistaken.names import comment
from bbsd.expression.operations import BY_WORD
from bbsd.expression.scope import Definition, Named
from bbsd.expression.syntax.tree import (
    Binary,
    Call,
    Comparison,
    Conditional,
    Expr,
    Generator,
    Index,
    Logical,
    Name,
    Number,
    OneOf,
    Span,
    Truth,
    Unary,
    parts,
)
from bbsd.expression.vocabulary import AGGREGATES, DRAWS, FUNCTIONS
from bbsd.kernel.streams import fold, name_word, word_of

if TYPE_CHECKING:
    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Draws, Names, Scope, Value

MAX_WHOLE_POWER = 64
"""The largest constant exponent whose power is computed by multiplications."""
EXPRESSION_WORK = 5
"""The work of starting an expression for a robot, beside that of its nodes."""

STORED = (("environment", "state"), ("environment", "world"))
"""Where `one of [...]` may stand."""


def number(expr: Expr, scope: Scope) -> Node:
    """Elaborate an expression that must be a number."""
    return require_kind(value(expr, scope), Kind.NUMBER, expr.span, scope)


def truth(expr: Expr, scope: Scope) -> Node:
    """Elaborate an expression that must be a truth."""
    return require_kind(value(expr, scope), Kind.TRUTH, expr.span, scope)


def scalar(expr: Expr, scope: Scope) -> Node:
    """Elaborate an expression that must be a number or a truth, not a list."""
    result = value(expr, scope)
    if isinstance(result, tuple):
        advice = "take an element or an aggregate of it"
        return scope.mistake("BB056", "a list, where one value is needed", expr.span, advice)
    return result.node if isinstance(result, Named) else result


def value(expr: Expr, scope: Scope) -> Value:
    """Elaborate an expression that may be a number, a truth or a list."""
    scope.findings.entered = (scope.path, expr.span)
    scope.graph.spend(EXPRESSION_WORK)
    result = _value(expr, _number_draws(expr, scope))
    # What sensors show at the start, of values that begin at 0, say, may be infinite there alone.
    return result if scope.starting else require_finite(result, expr.span, scope)


def value_of_names(expr: Expr, what: str, names: Names, scope: Scope) -> Value:
    """Elaborate an expression that must be one of the names that `what` can be."""
    report_unknown_values(expr, what, names, scope)
    return settled(value(expr, scope), what, names, expr.span, scope)


def whole(expr: Expr, scope: Scope, purpose: str) -> Node:
    """Elaborate an expression that must be a number; that it is whole must be proven later."""
    node = number(expr, scope)
    scope.findings.wholes.append((scope.path, expr.span, purpose, node))
    return node


def static_whole(expr: Expr, scope: Scope, purpose: str) -> int | None:
    """Elaborate an expression that must be a whole number, the same for the whole run; None after a mistake."""
    return require_static_whole(value(expr, scope), purpose, expr.span, scope)


def _number_draws(expr: Expr, scope: Scope) -> Scope:
    if scope.draws is None or not (calls := _draws_in(expr)):
        return scope
    ordinals = {call.span: ordinal for ordinal, call in enumerate(calls)}
    return replace(scope, draws=scope.draws._replace(ordinals=ordinals))


def _draws_in(expr: Expr) -> list[Call | OneOf]:
    own: list[Call | OneOf] = []
    if (isinstance(expr, Call) and expr.function in DRAWS) or (isinstance(expr, OneOf) and expr.at_random):
        own = [expr]
    return own + [call for part in parts(expr) for call in _draws_in(part)]


def _value(expr: Expr, scope: Scope) -> Value:
    match expr:
        case Number() | Truth():
            return _literal(expr, scope)
        case Name():
            return name_value(expr, scope, _value)
        case Unary():
            return _unary(expr, scope)
        case Binary(operator="**"):
            return _power(expr, scope)
        case Binary():
            return _arithmetic(expr, scope)
        case Comparison():
            return comparison(expr, scope, _value)
        case Logical():
            return _logical(expr, scope)
        case Conditional():
            return conditional(expr, scope, _value)
        case Call():
            return _call(expr, scope)
        case Index():
            return element(expr, scope, _value)
        case Generator():
            message = "a generator can only be the one argument of an aggregate"
            return scope.mistake("BB062", message, expr.span)
        case OneOf():
            return _one_of(expr, scope)


def _one_of(expr: OneOf, scope: Scope) -> Value:
    """Return what a state that is one of several names is at first."""
    if scope.path[:-1] not in STORED:
        advice = "name the state in state or world, and use its name here"
        return scope.mistake(
            "BB136", "one of [...] says what a state or a value of the world can be", expr.span, advice
        )
    graph = scope.graph
    if expr.at_random and scope.draws is not None:
        word = _word_of_draw(scope.draws, expr.span, scope.robot or 0)
        ends = graph.number(0), graph.number(len(expr.names) - 1)
        return Named(((expr.names, graph.draw("integers", word, ends)),))
    if expr.start is None:
        return Named(((expr.names, graph.number(0)),))
    report_unknown_values(expr.start, str(scope.path[-1]), expr.names, scope)
    return settled(_value(expr.start, scope), str(scope.path[-1]), expr.names, expr.start.span, scope)


def _of_kind(expr: Expr, kind: Kind, scope: Scope) -> Node:
    return require_kind(_value(expr, scope), kind, expr.span, scope)


def _literal(expr: Number | Truth, scope: Scope) -> Node:
    if isinstance(expr, Truth):
        return scope.graph.truth(value=expr.value)
    return scope.graph.number(expr.value)


def _unary(expr: Unary, scope: Scope) -> Node:
    if expr.operator == "not":
        return scope.graph.apply("not", _of_kind(expr.operand, Kind.TRUTH, scope))
    operand = _of_kind(expr.operand, Kind.NUMBER, scope)
    return scope.graph.apply("negate", operand) if expr.operator == "-" else operand


def _arithmetic(expr: Binary, scope: Scope) -> Node:
    if (told := comment(expr, scope) or mean_by_hand(expr, scope)) is not None:
        return told
    left = _of_kind(expr.left, Kind.NUMBER, scope)
    return scope.graph.apply(BY_WORD[expr.operator], left, _of_kind(expr.right, Kind.NUMBER, scope))


def _power(expr: Binary, scope: Scope) -> Node:
    base = _of_kind(expr.left, Kind.NUMBER, scope)
    exponent = _of_kind(expr.right, Kind.NUMBER, scope)
    if Kind.UNKNOWN in (base.kind, exponent.kind):
        return scope.graph.unknown
    constant = scope.static_value(exponent)
    if constant is not None and constant.is_integer() and abs(constant) <= MAX_WHOLE_POWER:
        return scope.graph.apply("whole_power", base, data=int(constant))
    if constant is None and scope.static_value(base) is None:
        message = "a power of a changing number needs a constant exponent"
        return scope.mistake("BB061", message, expr.right.span, "write exp(y * log(x))")
    return scope.graph.apply("power", base, exponent)


def _logical(expr: Logical, scope: Scope) -> Node:
    nodes = [_of_kind(operand, Kind.TRUTH, scope) for operand in expr.operands]
    return scope.graph.fold(BY_WORD[expr.operator], nodes)


def _call(expr: Call, scope: Scope) -> Value:
    name = expr.function
    binding = scope.names.get(name)
    if isinstance(binding, Definition) and binding.parameters:
        return call_definition(expr, binding, scope, _value)
    if name in FUNCTIONS:
        return _function(expr, scope)
    if name in AGGREGATES:
        return aggregate(expr, scope, _value)
    if name in DRAWS:
        return _draw(expr, scope)
    if name == "before":
        return _before(expr, scope)
    if isinstance(binding, Definition):
        return call_definition(expr, binding, scope, _value)
    from bbsd.expression.mistaken.uncallable import report_uncallable

    return report_uncallable(expr, scope, _value)


def _numbers(expr: Call, wanted: int, scope: Scope) -> list[Node]:
    """Return the arguments as numbers; all unknown if there are more or fewer than are wanted."""
    if not has_arguments(expr, wanted, scope):
        return [scope.graph.unknown] * wanted
    return [_of_kind(argument, Kind.NUMBER, scope) for argument in expr.arguments]


def _function(expr: Call, scope: Scope) -> Node:
    function = FUNCTIONS[expr.function]
    if expr.function == "clip":
        return _clip(expr, scope)
    return scope.graph.apply(function.operation, *_numbers(expr, function.arity, scope))


def _clip(expr: Call, scope: Scope) -> Node:
    """Return the nodes of `min(max(x, low), high)`, in the same order."""
    if not has_arguments(expr, 3, scope):
        return scope.graph.unknown
    number, low, high = expr.arguments
    raised = scope.graph.apply(
        "maximum", _of_kind(number, Kind.NUMBER, scope), _of_kind(low, Kind.NUMBER, scope)
    )
    return scope.graph.apply("minimum", raised, _of_kind(high, Kind.NUMBER, scope))


def _before(expr: Call, scope: Scope) -> Value:
    earlier = scope if scope.starting else scope.before
    if earlier is None:
        message = "before(...) has a meaning only after the decision: in dynamics, sensors, reward, ends and expects"
        return scope.mistake("BB065", message, expr.span)
    if not has_arguments(expr, 1, scope):
        return scope.graph.unknown
    then_scope = replace(earlier, path=scope.path, robot=scope.robot, local=scope.local, draws=None)
    return _value(expr.arguments[0], then_scope)


def _draw(expr: Call, scope: Scope) -> Node:
    if scope.draws is None:
        return scope.mistake("BB058", *undrawn(expr, scope.path))
    if len(expr.arguments) == 1 and (missing := missing_first(expr)) is not None:
        return scope.mistake("BB054", missing.message, missing.span, missing.advice, missing.correction)
    operands = _numbers(expr, DRAWS[expr.function][0], scope)
    if any(node.kind is Kind.UNKNOWN for node in operands):
        return scope.graph.unknown
    if (wrong := impossible_draw(expr, [scope.static_value(node) for node in operands])) is not None:
        return scope.mistake("BB141", wrong.message, wrong.span, wrong.advice, wrong.correction)
    word = _word_of_draw(scope.draws, expr.span, scope.robot or 0)
    return scope.graph.draw(expr.function, word, tuple(operands))


def _word_of_draw(draws: Draws, span: Span, robot: int) -> int:
    """Return the word of a draw, made of its place in the spec, the robot, and the elements of generators around it."""
    word = name_word(f"{draws.place}#{draws.ordinals[span]}")
    for part in (robot, *draws.elements):
        word = fold(word, word_of(part))
    return word
