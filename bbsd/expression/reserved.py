"""Which words cannot be names: only those that mean something where the name would stand."""

from __future__ import annotations

from enum import Enum
from keyword import kwlist
from typing import TYPE_CHECKING

from bbsd.expression.vocabulary import AGGREGATES, CONSTANTS, DRAWS, PARTITIONS, POSITIONS

if TYPE_CHECKING:
    from collections.abc import Mapping


class Use(Enum):
    """What a name is for."""

    ANY = "a name"
    """Of something that no expression uses and that nothing else stands beside: a reward's term, an input, a mark."""
    BEHAVIOR = "a behavior's name"
    ACTION = "an action's name"
    VALUE = "the name of a value"
    """Of what expressions use without brackets: constants, world, state, sensors, definitions, a state's values."""
    FUNCTION = "the name of a definition with parameters"


_NOT_TEXT = {
    "true": "it is a truth in YAML, not a text",
    "false": "it is a truth in YAML, not a text",
    "null": "it is nothing in YAML, not a text",
}
_OPEN_LAYER = "in a structure it is a layer for any behavior"
_NOBODY = "it is who controls a robot where no behavior does"
_OPEN_CELL = "in a rule it leaves a cell to be designed"
_OF_EXPRESSIONS: Mapping[str, str] = {
    **{word: "it is a word of expressions" for word in kwlist if word.islower()},
    **dict.fromkeys(CONSTANTS, "it is a number that every expression knows"),
    **{word: f"it is {meaning}" for word, meaning in POSITIONS.items()},
    "team": "after in it is all robots",
    "others": "after in it is all robots but this one",
    "otherwise": "it is the condition of the last of named cells",
}
_SPECIAL_CALLS: Mapping[str, str] = {
    **{word: f"{word}(...) is an aggregate, which takes lists" for word in AGGREGATES},
    **{word: f"{word}(...) is a random draw" for word in DRAWS},
    **{word: f"{word}(...) cuts a value into cells" for word in PARTITIONS},
    "range": "range(...) counts, after in",
    "before": "before(...) is a value as it was at the decision",
}

RESERVED: Mapping[Use, Mapping[str, str]] = {
    Use.ANY: _NOT_TEXT,
    Use.BEHAVIOR: {**_NOT_TEXT, "open": _OPEN_LAYER, "nobody": _NOBODY},
    Use.ACTION: {**_NOT_TEXT, "open": _OPEN_CELL},
    Use.VALUE: {**_NOT_TEXT, **_OF_EXPRESSIONS},
    Use.FUNCTION: {**_NOT_TEXT, **_OF_EXPRESSIONS, **_SPECIAL_CALLS},
}
"""For each use of names, the words that are taken there, and what by."""


def another_name(word: str) -> str:
    """Return what to write instead of a word that is taken."""
    return f"my_{word}"
