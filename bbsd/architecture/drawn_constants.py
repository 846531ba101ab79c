"""Constants that a seed drew, as given ones: their values, or expressions where they change with the generation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import value_of
from bbsd.expression.reconstruction import reconstruct
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Call, Expr, parts
from bbsd.expression.vocabulary import DRAWS
from bbsd.language.field_types import expressions_in

if TYPE_CHECKING:
    from bbsd.expression.scope import Plain
    from bbsd.language.meaning import Meaning
    from bbsd.text import Data, DataPath

LARGEST_WHOLE = 1e15
"""From here on a float is easier to read than its digits."""


def drawn_constants(meaning: Meaning) -> dict[DataPath, Data]:
    """Return the values of the constants that contain draws, as plain data at their paths."""
    return {
        ("constants", name): _datum(meaning.constants.values[name])
        for name, written in meaning.spec.constants.items()
        if any(_has_draws(expression.tree) for expression in expressions_in(written))
    }


def _has_draws(expr: Expr) -> bool:
    return (isinstance(expr, Call) and expr.function in DRAWS) or any(map(_has_draws, parts(expr)))


def _datum(value: Plain) -> Data:
    if isinstance(value, tuple):
        return [_datum(item) for item in value]
    if not value.literal:
        return render(reconstruct(value))
    number = float(value_of(value))
    return int(number) if number.is_integer() and abs(number) < LARGEST_WHOLE else number
