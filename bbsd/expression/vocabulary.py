"""The words of the expression language: functions, aggregates, draws, and all else that means something."""

from __future__ import annotations

from keyword import kwlist
from math import pi
from typing import NamedTuple

from bbsd.expression.kinds import Wholeness


class Function(NamedTuple):
    """A function of numbers."""

    arity: int
    """The number of its arguments."""
    operation: str
    """The name of the kernel's function, and of the operation in graphs; empty where it consists of others."""
    meaning: str
    """What the manual says of its value."""
    wholeness: Wholeness = Wholeness.NEVER
    """When its value is a whole number."""
    is_expensive: bool = False
    """Whether it takes so long that kernels give it a line, and perhaps a loop, of its own."""


FUNCTIONS: dict[str, Function] = {
    "abs": Function(1, "abs", "absolute value", Wholeness.LIKE_OPERANDS),
    "acos": Function(1, "acos", "arc cosine, in radians", is_expensive=True),
    "asin": Function(1, "asin", "arc sine, in radians", is_expensive=True),
    "atan": Function(1, "atan", "arc tangent, in radians", is_expensive=True),
    "atan2": Function(2, "atan2", "angle of the point (second, first), in radians", is_expensive=True),
    "ceil": Function(1, "ceil", "smallest whole number not below", Wholeness.ALWAYS),
    "clip": Function(
        3, "", "the first, but not below the second, and not above the third", Wholeness.LIKE_OPERANDS
    ),
    "cos": Function(1, "cos", "cosine of radians", is_expensive=True),
    "degrees": Function(1, "degrees", "radians to degrees"),
    "exp": Function(1, "exp", "power of e", is_expensive=True),
    "floor": Function(1, "floor", "largest whole number not above", Wholeness.ALWAYS),
    "hypot": Function(2, "hypot", "length of the vector (first, second)"),
    "log": Function(1, "log", "natural logarithm", is_expensive=True),
    "log10": Function(1, "log10", "logarithm to base 10", is_expensive=True),
    "log2": Function(1, "log2", "logarithm to base 2", is_expensive=True),
    "radians": Function(1, "radians", "degrees to radians"),
    "round": Function(1, "round_half_even", "nearest whole number, halves to the even one", Wholeness.ALWAYS),
    "sign": Function(1, "sign", "-1, 0 or 1", Wholeness.ALWAYS),
    "sin": Function(1, "sin", "sine of radians", is_expensive=True),
    "sqrt": Function(1, "sqrt", "square root"),
    "tan": Function(1, "tan", "tangent of radians", is_expensive=True),
    "tanh": Function(1, "tanh", "hyperbolic tangent", is_expensive=True),
    "wrap": Function(1, "wrap", "the angle less whole turns, from -pi, included, up to pi, not included"),
}

AGGREGATES: dict[str, str] = {
    "all": "true where all are",
    "any": "true where one is",
    "argmax": "the first v for which e is largest",
    "argmin": "the first v for which e is smallest",
    "list": "a list of the elements",
    "max": "the largest",
    "mean": "the sum divided by the number",
    "min": "the smallest",
    "sum": "the sum, from left to right",
}

DRAWS: dict[str, tuple[int, str]] = {
    "chance": (1, "true with the given probability"),
    "integers": (2, "a whole number from the first to the last, both included"),
    "normal": (2, "Gaussian with mean and standard deviation"),
    "uniform": (2, "uniform from the first up to the second"),
}

CONSTANTS: dict[str, float] = {"pi": pi}
"""Numbers every expression may use."""

SOURCES = ("team", "others", "range")
PARTITIONS = ("cut", "values")
CELL_WORDS = ("otherwise", "below", "to", "from", "open", "no", "action", "nobody")
OPERATORS = ("and", "or", "not", "if", "else", "for", "in", "is", "as", "def", "lambda", "true", "false")
POSITIONS: dict[str, str] = {
    "step": "the number of the step",
    "steps": "the number of steps of an episode",
    "robot": "the index of the robot",
    "robots": "the number of robots",
    "episode": "the number of the episode",
    "episodes": "the number of episodes of a lifetime",
    "generation": "the number of the generation",
    "generations": "the number of generations of a run",
}
"""Numbers that expressions can use without a spec naming them, and what they are."""
YAML_WORDS = ("yes", "no", "on", "off", "null")

WORDS: frozenset[str] = frozenset().union(
    FUNCTIONS,
    AGGREGATES,
    DRAWS,
    CONSTANTS,
    SOURCES,
    PARTITIONS,
    CELL_WORDS,
    OPERATORS,
    POSITIONS,
    YAML_WORDS,
    ("before",),
)
"""All words that mean something somewhere in a spec; most of them can be names all the same."""

UNREADABLE: frozenset[str] = frozenset(kwlist) - WORDS
"""Words that mean nothing in the language, and that an expression cannot be read with, as Python keeps them."""
