"""Tree to text, which parses to the same tree and has no more parentheses than it needs."""

from __future__ import annotations

from math import copysign

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
    Truth,
    Unary,
)

LEVELS = {
    "if": 0,
    "or": 1,
    "and": 2,
    "not": 3,
    "<": 4,
    "+": 5,
    "-": 5,
    "*": 6,
    "/": 6,
    "//": 6,
    "%": 6,
    "**": 8,
}
SIGN, POWER, ATOM = 7, 8, 9


def number_text(value: float) -> str:
    """Return the shortest text of a number; whole numbers have no point, but for the zero that has a sign."""
    is_whole = value == int(value) and abs(value) < 1e15 and (value != 0 or copysign(1, value) > 0)
    return str(int(value)) if is_whole else repr(value)


def render(expr: Expr) -> str:
    """Return the text of an expression."""
    return _render(expr)[0]


def _at_least(expr: Expr, level: int) -> str:
    text, own = _render(expr)
    return text if own >= level else f"({text})"


def _atom(expr: Number | Truth | Name) -> str:
    match expr:
        case Number(value=value):
            return number_text(value)
        case Truth(value=value):
            return str(value).lower()
        case Name(name=name):
            return name


def _render(expr: Expr) -> tuple[str, int]:
    match expr:
        case OneOf(names=names, start=start, at_random=at_random):
            first = (
                " starting at random" if at_random else "" if start is None else f" starting {render(start)}"
            )
            return f"one of [{', '.join(names)}]{first}", LEVELS["if"]
        case Number() | Truth() | Name():
            return _atom(expr), SIGN if isinstance(expr, Number) and expr.value < 0 else ATOM
        case Unary(operator="not", operand=operand):
            return f"not {_at_least(operand, LEVELS['not'])}", LEVELS["not"]
        case Unary(operator=operator, operand=operand):
            return f"{operator}{_at_least(operand, SIGN)}", SIGN
        case Binary(operator="**", left=left, right=right):
            return f"{_at_least(left, ATOM)} ** {_at_least(right, SIGN)}", POWER
        case Binary(operator=operator, left=left, right=right):
            level = LEVELS[operator]
            return f"{_at_least(left, level)} {operator} {_at_least(right, level + 1)}", level
        case Comparison(operators=operators, operands=operands):
            first, *rest = (_at_least(operand, LEVELS["<"] + 1) for operand in operands)
            tail = "".join(f" {operator} {text}" for operator, text in zip(operators, rest, strict=True))
            return first + tail, LEVELS["<"]
        case Logical(operator=operator, operands=operands):
            level = LEVELS[operator]
            return f" {operator} ".join(_at_least(operand, level + 1) for operand in operands), level
        case Conditional(condition=condition, then=then, otherwise=otherwise):
            level = LEVELS["or"]
            text = f"{_at_least(then, level)} if {_at_least(condition, level)} else {_at_least(otherwise, 0)}"
            return text, LEVELS["if"]
        case Call(function=function, arguments=arguments):
            return f"{function}({', '.join(_render(argument)[0] for argument in arguments)})", ATOM
        case Index(of=of, index=index):
            return f"{_at_least(of, ATOM)}[{_render(index)[0]}]", ATOM
        case Generator(element=element, names=names, source=source):
            text = f"{_at_least(element, 0)} for {', '.join(names)} in {_at_least(source, LEVELS['or'])}"
            return text, LEVELS["if"]
