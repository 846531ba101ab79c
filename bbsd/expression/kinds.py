"""The kinds of values: numbers, truths and cells."""

from __future__ import annotations

from enum import Enum


class Kind(Enum):
    """What a value is."""

    NUMBER = "a number"
    TRUTH = "a truth"
    CELL = "a cell"
    NAMED = "a named value"
    """What a state that is one of several names has; no node, only a value of an expression, is of this kind."""
    UNKNOWN = "unknown"
    """What could not be understood; it silences mistakes that would only follow from the first."""


class Wholeness(Enum):
    """When the value of an operation is a whole number."""

    NEVER = "not certainly"
    LIKE_OPERANDS = "where its operands are"
    ALWAYS = "always"
