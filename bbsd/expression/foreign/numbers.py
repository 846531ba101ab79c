"""Numbers as they are written elsewhere: with units, in percent, with a decimal comma."""

from __future__ import annotations

import itertools
import re
from typing import TYPE_CHECKING

from bbsd.expression.foreign.tokens import KEYWORDS, Step, begins_operand, replacing, tokens

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.foreign.tokens import Token

TIMES, LENGTHS = "s sec secs second seconds steps step", "m meter meters metre metres"
OTHERS = "rad radian kg N V A W J K Hz C"
SCALED = "ms us ns min mins minute minutes h hr hour hours mm cm dm km g mg lb ft rpm kmh mph kHz MHz percent pct px"
BASE_UNITS = frozenset(f"{TIMES} {LENGTHS} {OTHERS}".split())
"""Units in which models are written: the number is the same without them."""
ANGLES = frozenset({"deg", "degs", "degree", "degrees", "°"})
UNITS = BASE_UNITS | ANGLES | frozenset(SCALED.split())
NO_UNITS = "numbers have no units"
DECIMAL_COMMA = re.compile(r"(?<![\w.,])(\d+),(\d+)(?![\w.,])")


def unit(text: str, _key: str) -> Step | None:
    """Find a number with a unit: `0.1s`, `90 deg`, `1 m/s`."""
    found = tokens(text)
    for at, (number, name) in enumerate(itertools.pairwise(found)):
        is_glued = number.end == name.start
        is_unit = name.text in UNITS or (
            is_glued and name.kind == "word" and name.text not in KEYWORDS and len(name.text) > 1
        )
        if (
            number.kind != "number"
            or not is_unit
            or (not begins_operand(found, at) and found[at - 1].text not in "+-")
        ):
            continue
        if at + 2 < len(found) and found[at + 2].text == "(":
            continue
        stop = _end_of_unit(found, at + 1)
        return _without_unit(text, number, name.text, stop)
    return None


def _end_of_unit(found: Sequence[Token], at: int) -> int:
    """Return where a unit such as `m/s` or `rad/s^2` ends in the text."""
    stop = found[at].end
    while (
        at + 2 < len(found)
        and found[at + 1].text in ("/", "^", "**")
        and found[at + 1].start == found[at].end
    ):
        if found[at + 2].text not in UNITS and found[at + 2].kind != "number":
            break
        at += 2
        stop = found[at].end
    return stop


def _without_unit(text: str, number: Token, unit: str, stop: int) -> Step:
    written = text[number.start : stop]
    if unit in ANGLES and stop == number.end + len(text[number.end : stop]):
        new, advice = f"radians({number.text})", "functions take radians: radians(...) converts degrees"
        return _step(text, number.start, stop, f'{NO_UNITS}: "{written}"', advice, new, is_certain=False)
    if unit in BASE_UNITS and "/" not in written:
        advice = "write the value in the unit that all of the model has"
        return _step(text, number.start, stop, f'{NO_UNITS}: "{written}"', advice, number.text)
    advice = "write the value in the unit that all of the model has, converted if need be"
    return _step(
        text,
        number.start,
        stop,
        f'{NO_UNITS}: "{written}"',
        advice,
        number.text,
        is_certain=unit in BASE_UNITS,
    )


def percent(text: str, _key: str) -> Step | None:
    """Find a number in percent."""
    found = tokens(text)
    for at, (number, sign) in enumerate(itertools.pairwise(found)):
        after = found[at + 2] if at + 2 < len(found) else None
        if number.kind != "number" or sign.text != "%" or (after and _is_operand(after)):
            continue
        message = (
            f'numbers have no percent: "{text[number.start : sign.end]}"; % is the remainder of a division'
        )
        part = f"{float(number.text) / 100:g}"
        advice = f"write {number.text} where the whole is 100, {part} where it is 1"
        new = part if found[at - 2 : at - 1] and found[at - 2].text == "chance" else number.text
        return _step(text, number.start, sign.end, message, advice, new, is_certain=False)
    return None


def _is_operand(token: Token) -> bool:
    return token.text == "(" or (token.kind in ("number", "word") and token.text not in KEYWORDS)


def decimal_comma(text: str, _key: str) -> Step | None:
    """Find a decimal comma, outside of brackets."""
    for match in DECIMAL_COMMA.finditer(text):
        before = text[: match.start()]
        if before.count("(") + before.count("[") == before.count(")") + before.count("]"):
            new = f"{match[1]}.{match[2]}"
            message = "a decimal is written with a point, not with a comma"
            return _step(text, match.start(), match.end(), message, f"write {new}", new)
    return None


def _step(
    text: str, start: int, stop: int, message: str, advice: str, new: str, *, is_certain: bool = True
) -> Step:
    return replacing(text, start, stop, new, message, advice, is_certain)
