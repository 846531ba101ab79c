"""Whether the numbers of a draw are possible."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.syntax.mistakes import Rewriting
from bbsd.expression.syntax.text import number_text, render
from bbsd.expression.syntax.tree import Call, Generator, Number, Span

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.syntax.mistakes import ValuePath

WHOLE_PERCENT = 100
TAKES = {
    "normal": "mean and deviation",
    "uniform": "the smallest and the largest value",
    "integers": "the smallest and the largest value",
}
"""What draws of two numbers take."""


class ImpossibleDraw(NamedTuple):
    """What is wrong with a draw, and what is probably meant."""

    message: str
    span: Span
    advice: str
    correction: Rewriting | None


def impossible_draw(draw: Call, values: Sequence[float | None]) -> ImpossibleDraw | None:
    """Return what is wrong with the numbers of a draw, as far as they are the same for the whole run."""
    match draw.function, values:
        case "chance", [float(probability)] if not 0 <= probability <= 1:
            return _chance(draw, probability)
        case "normal", [_, float(deviation)] if deviation < 0:
            what = f"a standard deviation is not negative, and this is {deviation:g}"
            return ImpossibleDraw(what, draw.arguments[1].span, f"write {-deviation:g}", None)
        case "uniform" | "integers", [float(low), float(high)] if low > high:
            first, second = draw.arguments
            new = f"{draw.function}({render(second)}, {render(first)})"
            what = f"{draw.function} draws from the smaller number up to the larger one, and {high:g} is below {low:g}"
            return ImpossibleDraw(what, draw.span, f"write {new}", Rewriting(new, draw.span))
    return None


def missing_first(draw: Call) -> ImpossibleDraw | None:
    """Return what is wrong with the one argument of a draw that takes two; None for other draws and a generator."""
    (argument,) = draw.arguments
    if draw.function not in TAKES or isinstance(argument, Generator):
        return None
    new = f"{draw.function}(0, {render(argument)})"
    what = f"{draw.function} takes 2 arguments, {TAKES[draw.function]}, not 1"
    return ImpossibleDraw(
        what,
        draw.span,
        f"write {new}, if 0 is meant as the first",
        Rewriting(new, draw.span, is_certain=False),
    )


def _chance(draw: Call, probability: float) -> ImpossibleDraw:
    (argument,) = draw.arguments
    what = f"a probability is between 0 and 1, and this is {probability:g}"
    if not (isinstance(argument, Number) and 1 < probability <= WHOLE_PERCENT):
        return ImpossibleDraw(what, argument.span, "", None)
    new = number_text(probability / WHOLE_PERCENT)
    correction = Rewriting(new, argument.span, is_certain=False)
    return ImpossibleDraw(
        what, argument.span, f"write {new} where {probability:g} percent are meant", correction
    )


def undrawn(expr: Call, path: ValuePath) -> tuple[str, Span, str]:
    """Return message, span and advice for a draw where nothing is drawn: by the key whose value would draw."""
    keys = [segment for segment in path if isinstance(segment, str)]
    where = next((key for key in reversed(keys) if key in UNDRAWN), "")
    message = f"{UNDRAWN.get(where, 'what stands here')} draws nothing at random"
    name, start = ("coin", "false") if expr.function == "chance" else ("luck", "0")
    advice = (
        f"draw it in dynamics: under state {name}: {start}, under dynamics {name}: {render(expr)}, "
        f"and here {name} in its place"
    )
    return message, expr.span, advice


UNDRAWN = {
    "excited": "excited",
    "inputs": "an input",
    "reward": "the reward",
    "ends": "ends",
    "definitions": "a definition",
    "view": "the picture",
    "expects": "expects",
}
"""Blocks and keys below which nothing is drawn, and what a message calls what stands there."""
