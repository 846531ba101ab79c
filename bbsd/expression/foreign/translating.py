"""What is foreign in the text of an expression, and the same expression as it is written here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.foreign.calls import attribute, foreign_function, listed_arguments, module, open_bracket
from bbsd.expression.foreign.conditionals import else_if, if_first, question_mark, without_else
from bbsd.expression.foreign.lists import (
    braces,
    comprehension,
    filtered,
    list_in_brackets,
    membership,
    repeated,
    slice_of_list,
    tuple_of_values,
    two_indices,
)
from bbsd.expression.foreign.numbers import decimal_comma, percent, unit
from bbsd.expression.foreign.signs import (
    assignment,
    bars,
    capitals,
    comment,
    foreign_sign,
    named_argument,
    power_of_square,
    quoted,
    quotes,
    times,
)
from bbsd.expression.foreign.tokens import reads
from bbsd.expression.syntax.mistakes import Mistake, Rewriting
from bbsd.expression.syntax.tree import Span

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.expression.foreign.tokens import Step

MAX_STEPS = 20
MAX_LENGTH = 1000
"""Characters of a text in which foreign things are searched."""
ONE_OF = "BB136"
"""The code of what is wrong in `one of [...]`, where a list stands in brackets."""
RULES: tuple[Callable[[str, str], Step | None], ...] = (
    quotes,
    assignment,
    comment,
    question_mark,
    else_if,
    unit,
    percent,
    decimal_comma,
    power_of_square,
    bars,
    module,
    attribute,
    named_argument,
    membership,
    slice_of_list,
    two_indices,
    braces,
    comprehension,
    filtered,
    repeated,
    foreign_sign,
    listed_arguments,
    list_in_brackets,
    open_bracket,
    if_first,
    without_else,
    times,
    capitals,
    quoted,
    tuple_of_values,
)
"""What is searched, in this order: what moves parts of a text stands behind what makes them readable."""


def translated(text: str, mistake: Mistake, key: str = "") -> Mistake:
    """Return the mistake of a text that is no expression, told by what is foreign in it and with its correction.

    A mistake in which nothing foreign is found is returned as it is. `key` is the key whose value the text is.
    """
    if len(text) > MAX_LENGTH or mistake.code == ONE_OF:
        return mistake
    steps = _steps(text.replace("\n", " ").replace("\t", " "), key)
    if not steps:
        return mistake
    first, last = steps[0], steps[-1]
    correction = None
    if last.text is not None and (reads(last.text) or _is_comment(last.text)):
        correction = _difference(text, last.text, all(step.is_certain for step in steps))
    span = Span(first.start, max(first.length, 1))
    message = first.message or mistake.message
    return mistake._replace(message=message, span=span, advice=first.advice, correction=correction)


def _steps(text: str, key: str) -> list[Step]:
    """Return what is foreign, each found in the text that the one before left."""
    steps: list[Step] = []
    while len(steps) < MAX_STEPS and not reads(text):
        step = next((step for rule in RULES if (step := rule(text, key))), None)
        if step is None:
            break
        steps.append(step)
        if step.text is None or _is_comment(step.text) or step.text == text:
            break
        text = step.text
    while steps and reads(text) and (step := foreign_function(text, key)) and step.text is not None:
        steps.append(step)
        text = step.text
        if len(steps) > MAX_STEPS:
            break
    return steps


def _is_comment(text: str) -> bool:
    return "#" in text and reads(text[: text.index("#")].rstrip())


def _difference(text: str, new: str, is_certain: bool) -> Rewriting:
    """Return what to write for the part in which two texts differ."""
    start = 0
    while start < min(len(text), len(new)) and text[start] == new[start]:
        start += 1
    end = 0
    while end < min(len(text), len(new)) - start and text[-1 - end] == new[-1 - end]:
        end += 1
    if start == 0 and end == len(text):
        return Rewriting(
            new, Span(0, len(text)), is_certain
        )  # what is only put before it has no span of its own
    return Rewriting(new[start : len(new) - end], Span(start, len(text) - end - start), is_certain)
