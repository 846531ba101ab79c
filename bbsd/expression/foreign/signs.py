"""Operators and assignments of other languages."""

from __future__ import annotations

import itertools
import re
from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.expression.foreign.tokens import (
    KEYWORDS,
    OPERATOR_SIGNS,
    Step,
    begins_operand,
    operand_end,
    operand_start,
    reads,
    spliced,
    tokens,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.foreign.tokens import Token

SIGNS = {
    "&&": "and",
    "||": "or",
    "&": "and",
    "|": "or",
    "^": "**",
    "~=": "!=",
    "<>": "!=",
    "=!": "!=",
    "!==": "!=",
    "===": "==",
    "=<": "<=",
    "=>": ">=",
    ":=": "==",
    "=": "==",
    "≠": "!=",
    "≤": "<=",
    "≥": ">=",
    "×": "*",
    "·": "*",
    "÷": "/",
    "−": "-",
    "∧": "and",
    "∨": "or",
}
"""Signs that have one other form here."""
WORDS = {
    "AND": "and",
    "OR": "or",
    "NOT": "not",
    "True": "true",
    "False": "false",
    "TRUE": "true",
    "FALSE": "false",
    "PI": "pi",
    "Pi": "pi",
    "π": "pi",
    "xor": "!=",
    "XOR": "!=",
    "IF": "if",
    "ELSE": "else",
    "THEN": "then",
}
"""Words that have one other form here."""
COMPARISONS = frozenset(["==", "!=", "<", ">", "<=", ">=", "+", "-", "*", "/", "%", "**"])
CONDITIONS = ("excited", "ends", "expects")
"""Keys whose value is a truth."""
MEANINGS = {
    "==": "equality is written ==",
    "**": "a power is written **",
    "!=": "what differs is compared by !=",
}


def assignment(text: str, key: str) -> Step | None:
    """Find an assignment: `+= 0.1`, `speed += 0.1`, `speed = 2` under the key `speed`."""
    match = re.match(
        r"\s*(?P<name>[A-Za-z_]\w*)?\s*(?P<sign>[-+*/%]=|\*\*=|//=|:=|=(?!=))\s*(?P<value>.*\S)", text
    )
    if match is None or not (match["name"] or key):
        return None
    sign, name, value = match["sign"], match["name"] or key, match["value"]
    if sign in ("=", ":="):
        if match["name"] and match["name"] != key:
            return None
        message = "nothing is assigned in an expression: the key's value is the value itself"
        return Step(match.start("sign"), len(sign), message, f"write {value}", value)
    operand = value if len(tokens(value)) == 1 or sign == "+=" else f"({value})"
    new = f"{name} {sign[:-1]} {operand}"
    message = f'there is no "{sign}": what is written is the new value itself'
    return Step(match.start("sign"), len(sign), message, f"write {new}", new, name == key or not key)


def foreign_sign(text: str, key: str) -> Step | None:
    """Find a sign or a word that is written in another way here."""
    found = tokens(text)
    for at, token in enumerate(found):
        if token.text in ("!", "~") and begins_operand(found, at) and at + 1 < len(found):
            return _not(text, found, at)
        if token.text in ("++", "--"):
            return Step(token.start, len(token.text), f'there is no "{token.text}"', "write x + 1", None)
        new = SIGNS.get(token.text) if token.kind == "sign" else WORDS.get(token.text)
        if new and not (token.text == "=" and _names_an_argument(found, at)):
            # `x = 3` as a whole value may set something, but for keys that hold a condition.
            sets = token.text in ("=", ":=") and at == 1 and key not in CONDITIONS
            return replace(_sign(text, token, new), is_certain=not sets)
    return None


def _sign(text: str, token: Token, new: str) -> Step:
    what = f'there is no "{token.text}" in expressions'
    advice = MEANINGS.get(new, f"write {new}")
    padded = text[token.start - 1 : token.start].strip() and new.isalpha()
    new_text = spliced(text, token.start, token.end, f" {new} " if padded else new)
    return Step(token.start, len(token.text), what, advice, new_text)


def _not(text: str, found: Sequence[Token], at: int) -> Step:
    """Replace `!x` by `not x`, in parentheses where it stands beside a comparison."""
    token = found[at]
    message = f'there is no "{token.text}" in expressions'
    end = operand_end(found, at + 1)
    new = f"not {text[found[at + 1].start : found[end - 1].end]}" if end else None
    stop = found[end - 1].end if end else token.end
    if new is None:
        return Step(token.start, 1, message, "write not", spliced(text, token.start, token.end, "not "))
    # C would take `!a > b` as (!a) > b, which nobody means.
    is_certain = end is None or end >= len(found) or found[end].text not in COMPARISONS
    if at and found[at - 1].text in COMPARISONS:
        new = f"({new})"
    return Step(token.start, 1, message, "write not", spliced(text, token.start, stop, new), is_certain)


def _names_an_argument(found: Sequence[Token], at: int) -> bool:
    """Return whether an equality sign follows a name that begins an argument: `normal(mean=0)`."""
    return (
        at > 1
        and found[at - 1].kind == "word"
        and found[at - 2].text in ("(", ",")
        and not (at > 2 and found[at - 2].text == "(" and begins_operand(found, at - 2))
    )


def named_argument(text: str, _key: str) -> Step | None:
    """Find an argument with a name: `normal(mean=0, sd=1)`."""
    found = tokens(text)
    for at, token in enumerate(found):
        if token.text == "=" and _names_an_argument(found, at):
            name = found[at - 1]
            message = "arguments have no names here; their order says which is which"
            new = spliced(text, name.start, token.end, "").replace("( ", "(").replace(",  ", ", ")
            return Step(name.start, token.end - name.start, message, "", new, is_certain=False)
    return None


def bars(text: str, _key: str) -> Step | None:
    """Find an absolute value between bars."""
    found = tokens(text)
    at = next((i for i, token in enumerate(found) if token.text == "|" and begins_operand(found, i)), None)
    if at is None:
        return None
    ends = [i for i in range(at + 2, len(found)) if found[i].text == "|"]
    for end in ends:
        inner = text[found[at].end : found[end].start].strip()
        if reads(inner):
            start, stop = found[at].start, found[end].end
            message = "an absolute value is not written between bars"
            return Step(
                start,
                stop - start,
                message,
                f"write abs({inner})",
                spliced(text, start, stop, f"abs({inner})"),
            )
    return None


QUOTES = {"“": "”", "„": "“", "”": "”", "«": "»", "‘": "’", "‚": "‘"}
"""Quotes as a word processor writes them, each with the one that closes it."""


def quotes(text: str, _key: str) -> Step | None:
    """Find typographic quotes around an expression."""
    inner, first = text.strip(), text[: len(text) - len(text.lstrip())]
    if len(inner) < 2 or not (inner[0] in QUOTES and inner[-1] in (QUOTES[inner[0]], "”", "’")):
        return None
    message = f"{inner[0]}...{inner[-1]} are no quotes in YAML"
    return Step(len(first), 1, message, 'leave them out, or write "..."', f"{first}{inner[1:-1]}")


IN_QUOTES = re.compile(r"""'(?P<a>[^']*)'|"(?P<b>[^"]*)"|[“„”«‘‚](?P<c>[^“”„«»‘’‚]*)[”“»’‘]""")
PLAIN = re.compile(r"[a-z]\w*\Z|-?\d+(?:\.\d+)?\Z")


def quoted(text: str, _key: str) -> Step | None:
    """Find a name or a number in quotes: `mode == 'clean'`."""
    match = IN_QUOTES.search(text)
    if match is None:
        return None
    inner = (match["a"] or match["b"] or match["c"] or "").strip()
    message = "there is no text in expressions: names of values stand without quotes"
    length = match.end() - match.start()
    if not PLAIN.match(inner):
        advice = "write a condition of the number itself, such as sonar < 0.2"
        return Step(match.start(), length, message, advice, None)
    new = spliced(text, match.start(), match.end(), inner)
    return Step(match.start(), length, message, f"write {inner}", new, is_certain=False)


def comment(text: str, _key: str) -> Step | None:
    """Find a comment of C, or one of MATLAB, behind an expression, or one without a blank before it."""
    for mark in ("#", "//", "/*", "--", "%", ";"):
        at = text.find(mark)
        before, after = text[:at].rstrip(), text[at + len(mark) :]
        if at <= 0 or not reads(before):
            continue
        if mark == "#":
            message = "a comment begins with a blank and #"
            return Step(
                at, len(text) - at, message, "put a blank before the #", f"{before} # {after.strip()}"
            )
        if mark == ";" and not after.strip():
            return Step(at, 1, 'no ";" ends an expression', "leave it out", before)
        if mark != ";" and (_is_prose(after) or mark == "/*"):
            words = after.replace("*/", "").strip()
            message = f'a comment begins with #, not with "{mark}"'
            # Of `distance // cell size`, a division is as likely; comments stand further away.
            is_certain = mark == "/*" or (mark == "//" and text[:at].endswith("  "))
            return Step(at, len(text) - at, message, "", f"{text[:at]}# {words}", is_certain)
    return None


def _is_prose(text: str) -> bool:
    """Return whether a text is no part of an expression: words stand beside each other, and no operator between."""
    if re.search(r"[&|=<>?*+!^]", text):
        return False
    words = re.findall(r"[A-Za-z_]\w*", text)
    pairs = re.findall(r"(?=\b([A-Za-z]\w*)\s+([A-Za-z]\w*))", text)
    if any(not {*pair} & KEYWORDS for pair in pairs):
        return True
    # "for safety" and "speed in meters" are none either, but a part of "sum(a // b for b in team)" is.
    begins = bool(words) and words[0] in KEYWORDS - {"not"} and text.strip().startswith(words[0])
    return begins or bool(pairs and {"in", "is"} & set(words) and "for" not in words)


def times(text: str, _key: str) -> Step | None:
    """Find a multiplication without a sign: `2x`, `2 (a + b)`, `(a) (b)`."""
    found = tokens(text)
    for at, (token, after) in enumerate(itertools.pairwise(found)):
        is_factor = after.text == "(" or (after.kind == "word" and after.text not in KEYWORDS)
        if token.kind == "number" and is_factor:
            end = operand_end(found, at + 1)
            stop = found[end - 1].end if end else after.end
            new = f"{token.text} * {text[after.start : stop]}"
            if not reads(spliced(text, token.start, stop, new)):
                continue
            message = "a multiplication needs its sign"
            return Step(
                token.start,
                stop - token.start,
                message,
                f"write {new}",
                spliced(text, token.start, stop, new),
                is_certain=False,
            )
    return None


def capitals(text: str, _key: str) -> Step | None:
    """Find a name with capitals."""
    for token in tokens(text):
        if token.kind == "word" and token.text != token.text.lower() and token.text not in {*WORDS, "None"}:
            new = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", token.text).lower()
            message = f'"{token.text}" cannot be a name; names are small letters, digits and _'
            changed = spliced(text, token.start, token.end, new)
            length = len(token.text)
            return Step(token.start, length, message, f"write {new}", changed, is_certain=False)
    return None


def power_of_square(text: str, _key: str) -> Step | None:
    """Find `²` or `³`."""
    for sign, power in (("²", 2), ("³", 3)):
        at = text.find(sign)
        if at > 0:
            return Step(
                at,
                1,
                f'there is no "{sign}" in expressions',
                "a power is written **",
                spliced(text, at, at + 1, f" ** {power}"),
            )
    return None


def has_operator_before(found: Sequence[Token], at: int) -> bool:
    """Return whether an operator, a comma or a bracket stands before an index, or nothing does."""
    return at == 0 or found[at - 1].text in OPERATOR_SIGNS or operand_start(found, at) is None
