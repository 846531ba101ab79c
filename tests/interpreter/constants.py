"""The values of a spec's constants in one generation."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.language.field_types import Expression
from tests.interpreter.draws import draws_of_constant
from tests.interpreter.expressions import Moment, Scope, Value, evaluate

if TYPE_CHECKING:
    from bbsd.language.models import ConstantValue, Spec


def read_constants(spec: Spec, seed: int, generation: int) -> dict[str, Value]:
    """The constants by name, each evaluated after those it uses."""
    purpose = fold(name_word(f"bbsd seed {seed}") ^ word_of(seed), name_word("constants"))
    sizes = {"generation": generation, "robots": spec.environment.robots, "steps": spec.environment.steps}

    @cache
    def value(name: str, robot: int) -> Value:
        if name in sizes:
            return float(sizes[name])
        key = fold(purpose, name_word(name))
        return valued(spec.constants[name], f"constants.{name}", key, Moment(value))

    return {name: value(name, 0) for name in spec.constants}


def valued(written: ConstantValue, place: str, key: int, moment: Moment) -> Value:
    """An expression's value, or the list of its elements'."""
    if not isinstance(written, Expression):
        return [valued(element, f"{place}.{number}", key, moment) for number, element in enumerate(written)]
    draw = draws_of_constant(place, written.tree, key)
    return evaluate(written.tree, Scope(moment, robots=0, robot=0, draw=draw))
