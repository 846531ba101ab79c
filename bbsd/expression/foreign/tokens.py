"""The words and signs of a text that need not be an expression, with their places."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import ExpressionError
from bbsd.expression.syntax.parsing import parse

if TYPE_CHECKING:
    from collections.abc import Sequence

TOKEN = re.compile(
    r"(?P<number>(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?)"
    r"|(?P<word>[A-Za-z_]\w*)"
    r"|(?P<text>'[^']*'|\"[^\"]*\")"
    r"|(?P<sign>===|!==|\*\*=?|//=?|&&|\|\||==|!=|<=|>=|=<|=>|~=|<>|=!|\+=|-=|\*=|/=|\+\+|:=|\S)"
)
OPENING = {"(": ")", "[": "]", "{": "}"}
KEYWORDS = frozenset({"and", "or", "not", "if", "else", "for", "in", "is"})
OPERATOR_SIGNS = frozenset(
    {
        "+",
        "-",
        "*",
        "/",
        "//",
        "%",
        "**",
        "<",
        ">",
        "<=",
        ">=",
        "==",
        "!=",
        "&&",
        "||",
        "&",
        "|",
        "^",
        "~",
        "!",
        "=",
    }
    | {"?", ":", ";", "(", "[", "{", ","}
)


@dataclass(frozen=True, slots=True)
class Token:
    """A number, word, text or sign, and where it stands."""

    kind: str
    text: str
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class Step:
    """One foreign thing in a text: its place, what to say of it, and the text without it.

    The text is None where it is not known how to write it.
    """

    start: int
    length: int
    message: str
    advice: str
    text: str | None
    is_certain: bool = True


def tokens(text: str) -> list[Token]:
    """Return the tokens of a text, in order."""
    return [
        Token(match.lastgroup or "", match[0], match.start(), match.end()) for match in TOKEN.finditer(text)
    ]


def spliced(text: str, start: int, end: int, new: str) -> str:
    """Return a text with another one for the characters from start up to end."""
    return text[:start] + new + text[end:]


def replacing(
    text: str, start: int, end: int, new: str, message: str, advice: str, is_certain: bool = True
) -> Step:
    """Return the step that writes another text for the characters from start up to end."""
    return Step(start, end - start, message, advice, spliced(text, start, end, new), is_certain)


def closing(found: Sequence[Token], at: int) -> int | None:
    """Return the index of the bracket that closes the one at an index, None if there is none."""
    depth = 0
    for index in range(at, len(found)):
        depth += (found[index].text in OPENING) - (found[index].text in OPENING.values())
        if depth == 0:
            return index
    return None


def opening(found: Sequence[Token], at: int) -> int | None:
    """Return the index of the bracket that is closed by the one at an index, None if there is none."""
    depth = 0
    for index in range(at, -1, -1):
        depth += (found[index].text in OPENING.values()) - (found[index].text in OPENING)
        if depth == 0:
            return index
    return None


def begins_operand(found: Sequence[Token], at: int) -> bool:
    """Return whether an operand, not an operator, is expected at an index."""
    if at == 0:
        return True
    before = found[at - 1]
    return before.text in KEYWORDS or before.text in OPERATOR_SIGNS


def operand_end(found: Sequence[Token], at: int) -> int | None:
    """Return the index behind the operand at an index: a number, a name with what is in brackets, or brackets."""
    if at >= len(found):
        return None
    if found[at].text in OPENING:
        end = closing(found, at)
        if end is None:
            return None
        at = end + 1
    elif found[at].kind in ("number", "word", "text"):
        at += 1
    else:
        return None
    while at < len(found) and found[at].text in ("(", "["):
        end = closing(found, at)
        if end is None:
            return None
        at = end + 1
    return at


def operand_start(found: Sequence[Token], end: int) -> int | None:
    """Return the index where the operand begins that ends before an index."""
    at = end - 1
    while at >= 0 and found[at].text in OPENING.values():
        begin = opening(found, at)
        if begin is None:
            return None
        if begin == 0 or found[begin - 1].kind != "word" or found[begin - 1].text in KEYWORDS:
            return begin
        at = begin - 1
    return at if at >= 0 and found[at].kind in ("number", "word", "text") else None


def arguments(text: str, found: Sequence[Token], at: int) -> tuple[list[str], int] | None:
    """Return the texts of the arguments in the brackets at an index, and the index of the closing one."""
    end = closing(found, at)
    if end is None:
        return None
    if end == at + 1:
        return [], end
    depth, begin, parts = 0, found[at].end, []
    for token in found[at + 1 : end]:
        depth += (token.text in OPENING) - (token.text in OPENING.values())
        if token.text == "," and depth == 0:
            parts.append(text[begin : token.start].strip())
            begin = token.end
    return [*parts, text[begin : found[end].start].strip()], end


def reads(text: str) -> bool:
    """Return whether a text is an expression."""
    try:
        parse(text)
    except ExpressionError:
        return False
    return True


def split_in_two(text: str, found: Sequence[Token]) -> tuple[str, str] | None:
    """Return the two expressions that stand beside each other in a text, None if there is not just one such pair."""
    pairs = []
    for token in found[1:]:
        left, right = text[found[0].start : token.start].strip(), text[token.start : found[-1].end].strip()
        if reads(left) and reads(right):
            pairs.append((left, right))
    return pairs[0] if len(pairs) == 1 else None
