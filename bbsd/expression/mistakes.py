"""What can be said of a mistake inside an expression, before anyone knows the file it stands in."""

from __future__ import annotations

from dataclasses import dataclass

from bbsd.expression.tree import Span

WHOLE = Span(0, 0)
"""Stands for a value as a whole, whatever it is written as."""
KEY = Span(-1, 0)
"""Stands for the key of a value."""


@dataclass(frozen=True, slots=True)
class Mistake:
    """A diagnosis relative to the text of one expression, to a whole value, or to its key."""

    code: str
    message: str
    span: Span = WHOLE
    advice: str = ""


class ExpressionError(ValueError):
    """An expression that cannot be read."""

    def __init__(self, mistake: Mistake) -> None:
        super().__init__(mistake.message)
        self.mistake = mistake


class TooManyMistakesError(Exception):
    """So much is wrong that no more needs to be looked for."""
