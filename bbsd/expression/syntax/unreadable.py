"""Finds where an expression that cannot be read goes wrong, and what is probably meant."""

from __future__ import annotations

import re

from bbsd.expression.vocabulary import UNREADABLE

FOREIGN_SIGN = re.compile(r"(?<![<>=!:])=(?!=)|&&|\|\||!(?!=)")
EQUALITY = "equality is written =="
INSTEAD = {"=": EQUALITY, "&&": "write and", "||": "write or", "!": "write not"}
CLOSING = {"(": ")", "[": "]", "{": "}"}


def find_culprit(text: str, failed_at: int) -> tuple[int, int, str]:
    """Return start, length and advice for the mistake in a text; Python's parser may have failed only behind it."""
    if sign := FOREIGN_SIGN.search(text):
        return sign.start(), len(sign[0]), INSTEAD[sign[0]]
    if bracket := _unbalanced_bracket(text):
        start, advice = bracket
        return start, 1, advice
    return failed_at, 0, _advice_on_words(re.findall(r"\b[a-z]+\b", text))


def _unbalanced_bracket(text: str) -> tuple[int, str] | None:
    """Return the first bracket that closes nothing or the wrong one, or the last that is never closed, and advice."""
    still_open: list[int] = []
    for position, sign in enumerate(text):
        if sign in CLOSING:
            still_open.append(position)
        elif sign in CLOSING.values():
            wanted = CLOSING[text[still_open.pop()]] if still_open else ""
            if sign != wanted:
                return position, f"{wanted} is missing before it" if wanted else f"this {sign} closes nothing"
    if not still_open:
        return None
    sign = text[still_open[-1]]
    return still_open[-1], f"this {sign} is never closed; {CLOSING[sign]} is missing"


def _advice_on_words(words: list[str]) -> str:
    if words.count("if") != words.count("else"):
        return "a conditional has three parts: x if ... else y"
    return next((f"{word} cannot be a name in expressions" for word in words if word in UNREADABLE), "")
