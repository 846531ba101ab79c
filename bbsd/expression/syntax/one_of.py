"""Text to tree of `one of [idle, search, home]`, which says what a state can be."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.reserved import RESERVED, Use, another_name
from bbsd.expression.syntax.mistakes import ExpressionError, Mistake
from bbsd.expression.syntax.tree import OneOf, Span, with_spans

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.expression.syntax.tree import Expr

BEGINNING = re.compile(r"\s*one\s+of\b")
WHOLE = r"\s*one\s+of\s*\[(?P<names>[^\[\]]*)\](?:\s*,?\s*starting\b\s*(?P<start>.*\S)?)?\s*"
AT_RANDOM = r"at\s+random\Z"
NAME = re.compile(r"[a-z][a-z0-9_]*\Z")
EXAMPLE = "one of [idle, search, home]"


def is_one_of(text: str) -> bool:
    """Return whether a text begins as `one of [...]` does."""
    return BEGINNING.match(text) is not None


def read_one_of(text: str, parse: Callable[[str], Expr]) -> OneOf:
    """Return the tree of a text that begins with `one of`; `parse` reads what it starts with.

    Raises ExpressionError for what is wrong with it.
    """
    match = re.fullmatch(WHOLE, text, re.DOTALL)
    if match is None:
        advice = f"write {EXAMPLE}, or {EXAMPLE} starting home"
        raise _error("names in brackets come after one of", 0, len(text), advice)
    names = _names(match["names"], match.start("names"))
    start, begin = match["start"], match.start("start")
    span = Span(0, len(text))
    if start is None and "starting" in text[match.end("names") :]:
        raise _error(
            "what it is at first is missing after starting", 0, len(text), f"write {EXAMPLE} starting home"
        )
    if start is None or re.match(AT_RANDOM, start):
        return OneOf(names, None, start is not None, span)
    try:
        tree = parse(start)
    except ExpressionError as error:
        mistake = error.mistake
        moved = Span(mistake.span.start + begin, mistake.span.length)
        raise ExpressionError(Mistake(mistake.code, mistake.message, moved, mistake.advice)) from None
    return OneOf(
        names,
        with_spans(tree, lambda part: Span(part.start + begin, part.length)),
        at_random=False,
        span=span,
    )


def _names(text: str, begin: int) -> tuple[str, ...]:
    """Return the names between the brackets, which begin at a position of the whole text."""
    names: list[str] = []
    for item in text.split(","):
        name, at = item.strip(), begin + len(item) - len(item.lstrip())
        begin += len(item) + 1
        if not NAME.match(name):
            raise _no_name(name, at)
        if name in RESERVED[Use.VALUE]:
            advice = f"write another one, such as {another_name(name)}"
            raise _error(f'"{name}" cannot be a value: {RESERVED[Use.VALUE][name]}', at, len(name), advice)
        if name in names:
            raise _error(f"{name} is listed twice", at, len(name))
        names.append(name)
    if len(names) < 2:
        raise _error("a state is one of two values or more", begin - len(text) - 1, len(text))
    return tuple(names)


def _no_name(text: str, at: int) -> ExpressionError:
    bare = text.strip("\"' ")
    if not text:
        return _error("a name is missing here", at, 1, f"write {EXAMPLE}")
    if NAME.match(bare):
        return _error("values are written without quotes", at, len(text), f"write {bare}")
    if re.fullmatch(r"[-+.\d]+", text):
        advice = "for whole numbers, start with one and let inputs tell them apart: values(x, 1, 3)"
        return _error(f"values have names, and {text} is a number", at, len(text), advice)
    advice = "names are small letters, digits and _, a letter first"
    return _error(f'"{text}" cannot be a value\'s name', at, len(text), advice)


def _error(message: str, start: int, length: int, advice: str = "") -> ExpressionError:
    return ExpressionError(Mistake("BB136", message, Span(start, max(length, 1)), advice))
