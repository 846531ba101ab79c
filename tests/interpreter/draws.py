"""What a draw gives: a function of where it stands, of the robot, the elements around it, and the step."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING

from bbsd.expression.syntax.tree import Call, Expr, OneOf, parts
from bbsd.expression.vocabulary import DRAWS
from bbsd.kernel.streams import DISTRIBUTIONS, fold, name_word, word_of

if TYPE_CHECKING:
    from tests.interpreter.expressions import Draw, Value

TOP_BIT = 1 << 63


def draw_calls(expr: Expr) -> list[Call | OneOf]:
    """All draws of an expression, each before those in its arguments."""
    is_draw = expr.at_random if isinstance(expr, OneOf) else isinstance(expr, Call) and expr.function in DRAWS
    own = [expr] if is_draw else []
    return own + [call for part in parts(expr) for call in draw_calls(part)]


def word(place: str, expr: Expr, call: Call | OneOf, robot: int, positions: tuple[int, ...]) -> int:
    """The word of a draw, the same in all steps."""
    named = name_word(f"{place}#{draw_calls(expr).index(call)}")
    return reduce(fold, [word_of(number) for number in (robot, *positions)], named)


def draws_of_episode(place: str, expr: Expr, robot: int, step: int, key: int) -> Draw:
    """The draws of an expression of the episode, for one robot in one step."""

    def draw(call: Call | OneOf, positions: tuple[int, ...], arguments: list[Value]) -> Value:
        named = fold(word(place, expr, call, robot, positions) | TOP_BIT, word_of(step))
        distribution = call.function if isinstance(call, Call) else "integers"
        return DISTRIBUTIONS[distribution](key, named, *arguments)

    return draw


def draws_of_constant(place: str, expr: Expr, key: int) -> Draw:
    """The draws of a constant's expression."""

    def draw(call: Call | OneOf, positions: tuple[int, ...], arguments: list[Value]) -> Value:
        assert isinstance(call, Call)
        return DISTRIBUTIONS[call.function](key, word(place, expr, call, 0, positions), *arguments)

    return draw
