"""Conditionals of other languages: `c ? a : b`, `if c then a else b`, `elif`, `if(c, a, b)`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.foreign.tokens import (
    OPENING,
    Step,
    arguments,
    begins_operand,
    closing,
    reads,
    replacing,
    spliced,
    split_in_two,
    tokens,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.foreign.tokens import Token

FORM = "a conditional is written x if ... else y"
ELSE_IF = ("elif", "elseif", "elsif")


def question_mark(text: str, _key: str) -> Step | None:
    """Find `c ? a : b`."""
    found = tokens(text)
    marks = [at for at, token in enumerate(found) if token.text == "?"]
    if not marks:
        return None
    at = marks[-1]
    first = _start_of_part(found, at)
    colon = next(
        (i for i in range(at + 1, len(found)) if found[i].text == ":" and _depth(found, at, i) == 0), None
    )
    start = found[first].start
    if colon is None:
        return Step(start, found[at].end - start, f'there is no "?" in expressions: {FORM}', "", None)
    last = _end_of_part(found, colon + 1)
    condition = text[start : found[at].start].strip()
    then = text[found[at].end : found[colon].start].strip()
    otherwise = text[found[colon].end : found[last - 1].end].strip()
    new = f"{_enclosed(then)} if {_enclosed(condition)} else {otherwise}"
    if first and found[first - 1].text == "?":
        new = f"({new})"
    stop = found[last - 1].end
    message = 'there is no "? :" in expressions'
    return replacing(text, start, stop, new, message, FORM)


def _start_of_part(found: Sequence[Token], at: int) -> int:
    """Return the index where the condition before a question mark begins."""
    depth = 0
    for index in range(at - 1, -1, -1):
        text = found[index].text
        depth += (text in OPENING.values()) - (text in OPENING)
        if depth < 0 or (depth == 0 and text in (",", "?", ":")):
            return index + 1
    return 0


def _end_of_part(found: Sequence[Token], at: int, stops: Sequence[str] = (",", ":")) -> int:
    """Return the index where what begins at an index ends: at a closing bracket, a comma, or the end."""
    depth = 0
    for index in range(at, len(found)):
        text = found[index].text
        depth += (text in OPENING) - (text in OPENING.values())
        if depth < 0 or (depth == 0 and text in stops):
            return index
    return len(found)


def _depth(found: Sequence[Token], start: int, end: int) -> int:
    parts = [token.text for token in found[start:end]]
    return sum(part in OPENING for part in parts) - sum(part in OPENING.values() for part in parts)


def _enclosed(text: str) -> str:
    """Return a part of a conditional, in parentheses if it is one itself."""
    return (
        f"({text})" if any(token.text == "if" for token in tokens(text)) and not _is_enclosed(text) else text
    )


def _is_enclosed(text: str) -> bool:
    found = tokens(text)
    return bool(found) and found[0].text == "(" and closing(found, 0) == len(found) - 1


def if_first(text: str, _key: str) -> Step | None:
    """Find `if c then a else b`, `if (c) a else b`, `if c: a else: b`, `if(c, a, b)`."""
    found = tokens(text)
    starts = [at for at, token in enumerate(found) if token.text == "if" and begins_operand(found, at)]
    if not starts:
        return None
    at = starts[-1]
    last = _end_of_part(found, at + 1, (",", ";") if found[at + 1 : at + 2] else ())
    start, stop = found[at].start, found[last - 1].end
    new = _as_call(text, found, at, last) or _written_first(text, found[at + 1 : last])
    message = "a conditional does not begin with if"
    return Step(start, stop - start, message, FORM, None if new is None else spliced(text, start, stop, new))


def _as_call(text: str, found: Sequence[Token], at: int, last: int) -> str | None:
    if at + 1 < len(found) and found[at + 1].text == "(":
        read = arguments(text, found, at + 1)
        if read and len(read[0]) == 3 and read[1] == last - 1:
            condition, then, otherwise = read[0]
            return f"({_enclosed(then)} if {_enclosed(condition)} else {otherwise})"
    return None


def _written_first(text: str, found: Sequence[Token]) -> str | None:
    """Return a conditional that begins with `if` in the language's order, from the tokens behind that word."""
    otherwise_at = next(
        (i for i, token in enumerate(found) if token.text == "else" and _depth(found, 0, i) == 0), None
    )
    chain = next((i for i, token in enumerate(found) if token.text in ELSE_IF), None)
    if chain is not None and (otherwise_at is None or chain < otherwise_at):
        head, rest = found[:chain], _written_first(text, found[chain + 1 :])
    elif otherwise_at is not None:
        head, tail = found[:otherwise_at], [t for t in found[otherwise_at + 1 :] if t.text not in ("{", "}")]
        tail = tail[1:] if tail and tail[0].text == ":" else tail
        rest = text[tail[0].start : tail[-1].end].rstrip(";") if tail else None
    else:
        head, rest = [*found], "0"
    pair = _condition_and_value(text, head)
    if pair is None or rest is None:
        return None
    condition, then = pair
    return f"{_enclosed(then)} if {_enclosed(condition)} else {rest}"


def _condition_and_value(text: str, found: Sequence[Token]) -> tuple[str, str] | None:
    """Return the condition and the value of `c then a`, `c: a`, `(c) a`, `c a`."""
    kept = [token for token in found if token.text not in ("{", "}", ";")]
    for at, token in enumerate(kept):
        if token.text in ("then", ":", "THEN"):
            condition, value = kept[:at], kept[at + 1 :]
            if not condition or not value:
                return None
            return _text(text, condition), _text(text, value)
    return split_in_two(text, kept) if kept else None


def _text(text: str, found: Sequence[Token]) -> str:
    return text[found[0].start : found[-1].end].strip()


def else_if(text: str, _key: str) -> Step | None:
    """Find `a if c elif d b else e`, and `a if c elif b if d else e`."""
    found = tokens(text)
    at = next((i for i in range(len(found) - 1, -1, -1) if found[i].text in ELSE_IF), None)
    if at is None:
        return None
    token = found[at]
    message = f'there is no "{token.text}" in expressions'
    advice = "write a if ... else b if ... else c"
    last = _end_of_part(found, at + 1)
    after = next(
        (i for i in range(at + 1, last) if found[i].text == "else" and _depth(found, at, i) == 0), last
    )
    part = found[at + 1 : after]
    if any(token.text == "if" for token in part):
        return replacing(text, token.start, token.end, "else", message, advice)
    pair = _condition_and_value(text, part)
    if pair is None or after == last:
        return Step(token.start, len(token.text), message, advice, None)
    new = f"else {pair[1]} if {pair[0]} "
    return Step(
        token.start, len(token.text), message, advice, spliced(text, token.start, found[after].start, new)
    )


def without_else(text: str, _key: str) -> Step | None:
    """Find `a if c`, without `else`."""
    found = tokens(text)
    words = [token.text for token in found]
    if words.count("if") != words.count("else") + 1 or not reads(f"{text} else 0"):
        return None
    at = len(words) - 1 - words[::-1].index("if")
    start = found[at].start
    message = "a conditional without else has no value where its condition does not hold"
    return Step(
        start,
        len(text) - start,
        message,
        "a conditional has three parts: x if ... else y",
        f"{text.rstrip()} else 0",
        is_certain=False,
    )
