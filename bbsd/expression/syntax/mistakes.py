"""Mistakes in expressions, placed relative to the expression: its file is not known here."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.syntax.tree import Span

if TYPE_CHECKING:
    from bbsd.errors import Correction

ValuePath = tuple[str | int, ...]
"""Keys and positions from the top of a spec that lead to a value, as in scopes."""
WHOLE = Span(0, 0)
"""The span of a whole value, however it is written."""
KEY = Span(-1, 0)
"""The span of the key of a value."""


def in_key(span: Span) -> Span:
    """Return the span of characters in the key of a value."""
    return Span(KEY.start - 1 - span.start, span.length)


def characters_of_key(span: Span) -> Span | None:
    """Return the characters of a key that a span of `in_key` means; None for other spans."""
    return Span(KEY.start - 1 - span.start, span.length) if span.start < KEY.start else None


class Rewriting(NamedTuple):
    """A text for a part of an expression, for a whole value (as YAML on one line), or for its key."""

    text: str
    span: Span = WHOLE
    is_certain: bool = True
    """Whether there is one reading of what was meant."""
    at: ValuePath | None = None
    """The path of the value that is rewritten, where it is not the one that the mistake is told at."""


class Enclosing(NamedTuple):
    """Texts around a part of an expression; the whole is put in parentheses where it is not all, nor a call.

    It is never certain.
    """

    before: str
    after: str
    span: Span


class Addition(NamedTuple):
    """An entry, `key: value`, that a block mapping lacks: its first one, or the one behind the entry at `behind`.

    It is never certain, as its value is the author's to choose.
    """

    text: str
    mapping: ValuePath
    behind: str = ""


class Mistake(NamedTuple):
    """A diagnosis relative to the text of one expression, to a whole value, or to its key.

    Its correction is relative to the same, or already placed in the file. `seen_at` are paths of what the
    message speaks of, whose lines are told behind it.
    """

    code: str
    message: str
    span: Span = WHOLE
    advice: str = ""
    correction: Rewriting | Enclosing | Addition | Correction | None = None
    seen_at: tuple[ValuePath, ...] = ()


class ExpressionError(ValueError):
    """An expression that cannot be read."""

    def __init__(self, mistake: Mistake) -> None:
        super().__init__(mistake.message)
        self.mistake = mistake


class TooManyMistakesError(Exception):
    """There are so many mistakes that no more are searched."""
