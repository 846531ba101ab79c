"""What can be said of a mistake inside an expression, before anyone knows the file it stands in."""

from __future__ import annotations

from dataclasses import dataclass

from bbsd.expression.tree import Span


@dataclass(frozen=True, slots=True)
class Mistake:
    """A diagnosis relative to the text of one expression."""

    code: str
    message: str
    span: Span
    advice: str = ""


class ExpressionError(ValueError):
    """An expression that cannot be read."""

    def __init__(self, mistake: Mistake) -> None:
        super().__init__(mistake.message)
        self.mistake = mistake
