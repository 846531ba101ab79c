"""What functions are called elsewhere, and the same calls as they are written here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.foreign.tokens import arguments, operand_end, tokens
from bbsd.expression.vocabulary import DRAWS, FUNCTIONS

if TYPE_CHECKING:
    from collections.abc import Sequence

OTHER_NAMES = {
    "fabs": "abs",
    "absolute": "abs",
    "magnitude": "abs",
    "ln": "log",
    "log_10": "log10",
    "lg": "log10",
    "arctan2": "atan2",
    "arctan": "atan",
    "arcsin": "asin",
    "arccos": "acos",
    "sgn": "sign",
    "signum": "sign",
    "copysign": "sign",
    "ceiling": "ceil",
    "deg2rad": "radians",
    "rad2deg": "degrees",
    "to_radians": "radians",
    "to_degrees": "degrees",
    "norm": "hypot",
    "minimum": "min",
    "maximum": "max",
    "fmin": "min",
    "fmax": "max",
    "average": "mean",
    "avg": "mean",
    "total": "sum",
    "gauss": "normal",
    "gaussian": "normal",
    "normalvariate": "normal",
    "randn": "normal",
    "randint": "integers",
    "randi": "integers",
    "random_integers": "integers",
    "random": "uniform",
    "rand": "uniform",
    "unif": "uniform",
    "bernoulli": "chance",
    "probability": "chance",
    "prob": "chance",
    "prev": "before",
    "previous": "before",
    "last": "before",
    "old": "before",
    "pre": "before",
    "delay": "before",
    "lag": "before",
    "clamp": "clip",
    "normalize_angle": "wrap",
    "wrap_angle": "wrap",
    "wrap_to_pi": "wrap",
    "digitize": "cut",
    "discretize": "cut",
    "bins": "cut",
    "bucket": "cut",
    "saturate": "clip",
    "constrain": "clip",
    "limit": "clip",
    "bound": "clip",
}
"""What functions are called elsewhere, and what they are called here."""
IN_DEGREES = {"sind": "sin", "cosd": "cos", "tand": "tan"}
OUT_OF_DEGREES = {"asind": "asin", "acosd": "acos", "atand": "atan", "atan2d": "atan2"}


FORMS: dict[str, tuple[str, bool]] = {
    "pow power 2": ("{a} ** {b}", True),
    "square sqr sq 1": ("{a} ** 2", True),
    "mod fmod remainder modulo 2": ("{a} % {b}", True),
    "where ifelse iif cond select choose 3": ("({1} if {0} else {2})", True),
    "int trunc fix 1": ("floor({0})", False),
    "float double bool array asarray tuple 1": ("{0}", True),
    "log 2": ("log({0}) / log({1})", True),
    "round 2": ("round({a} * 10 ** {b}) / 10 ** {b}", True),
    "atan arctan 2": ("atan2({0}, {1})", True),
    "clip clamp saturate constrain limit bound 2": ("clip({0}, -{b}, {b})", False),
    "rand random 0": ("uniform(0, 1)", True),
    "randn 0": ("normal(0, 1)", True),
}
"""Calls of functions with so many arguments as they are written here, and whether that is certain.

`{0}` is an argument, `{a}` the first in parentheses where it is more than one operand, `{b}` the second.
"""


def other_name(function: str, values: Sequence[str]) -> tuple[str, bool] | None:
    """Return a call as it is written here, and whether that is certain; None for a function of no other language."""
    given = ", ".join(values)
    for names, (form, is_certain) in FORMS.items():
        *functions, number = names.split()
        if function in functions and len(values) == int(number):
            first, second = (*map(_atom, values[:2]), "", "")[:2]
            return form.format(*values, a=first, b=second), is_certain
    if function in FILLED and values and (FILLED[function] or len(values) > 1):
        return _filled(function, values), False
    if function in IN_DEGREES and len(values) == 1:
        return f"{IN_DEGREES[function]}(radians({given}))", True
    if function in OUT_OF_DEGREES:
        return f"degrees({OUT_OF_DEGREES[function]}({given}))", True
    if function not in OTHER_NAMES:
        return None
    name = OTHER_NAMES[function]
    arity = DRAWS[name][0] if name in DRAWS else FUNCTIONS[name].arity if name in FUNCTIONS else None
    return f"{name}({given})", arity in (None, len(values))


FILLED = {"zeros": "0", "ones": "1", "falses": "false", "trues": "true", "full": "", "fill": "", "repmat": ""}
"""Functions that make lists of equal elements, and what they are filled with."""


def _filled(function: str, values: Sequence[str]) -> str:
    """Return a list of equal elements: of MATLAB's `zeros(rows, columns)`, or numpy's `zeros((rows, columns))`."""
    element, sizes = FILLED[function], [*values]
    if not element:
        element = sizes.pop(0) if function == "repmat" else sizes.pop()
    if len(sizes) == 1 and (found := tokens(sizes[0])) and found[0].text in ("(", "["):
        read = arguments(sizes[0], found, 0)
        sizes = read[0] if read and read[1] == len(found) - 1 else sizes
    for name, size in zip("kjihg", reversed(sizes), strict=False):
        element = f"list({element} for {name} in range({size}))"
    return element


def _atom(text: str) -> str:
    """Return a text in parentheses where it is more than one operand."""
    found = tokens(text)
    return text if operand_end(found, 0) == len(found) else f"({text})"
