"""Lists as in Python and MATLAB: slices, comprehensions, filters, `[0] * n`, `a[y, x]`, and what is `in` a list."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.foreign.tokens import (
    Step,
    arguments,
    begins_operand,
    closing,
    operand_end,
    operand_start,
    reads,
    replacing,
    spliced,
    tokens,
)
from bbsd.expression.vocabulary import AGGREGATES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.foreign.tokens import Token

MAX_LISTED = 4
"""Elements of a slice that are listed one by one."""
SIMPLE = re.compile(r"(?:(?!\b(?:and|or|not|if|for)\b).)*")
"""A condition that needs no parentheses beside `and`."""
FAR = "1e9"
"""A number that is larger than all that is compared with it."""


def slice_of_list(text: str, _key: str) -> Step | None:
    """Find `x[1:4]`."""
    found = tokens(text)
    for at, token in enumerate(found):
        end = closing(found, at) if token.text == "[" and not begins_operand(found, at) else None
        begin = operand_start(found, at) if end is not None else None
        if end is None or begin is None or not any(part.text == ":" for part in found[at + 1 : end]):
            continue
        name, bounds = text[found[begin].start : token.start], text[token.end : found[end].start]
        span = token.start, found[end].end
        new = _elements(name, bounds)
        message = "a part of a list is not written with a colon"
        if new is None:
            advice = f"write its elements: list({name}[k + first] for k in range(how_many))"
            return Step(span[0], span[1] - span[0], message, advice, None)
        around = found[begin - 1 : begin], found[end + 1 : end + 2]
        function = found[begin - 2].text if begin > 1 else ""
        is_alone = [*map(_text_of, around)] == ["(", ")"] and function in AGGREGATES and function != "list"
        new = new if is_alone else f"list({new})"
        return Step(
            span[0],
            span[1] - span[0],
            message,
            f"write {new}",
            spliced(text, found[begin].start, span[1], new),
        )
    return None


def _text_of(found: Sequence[Token]) -> str:
    return found[0].text if found else ""


def _elements(name: str, bounds: str) -> str | None:
    """Return the elements that a slice with written bounds has, as arguments; None for other slices."""
    match = re.fullmatch(r"\s*(\d*)\s*:\s*(\d+)\s*", bounds)
    if match is None:
        return None
    first, stop = int(match[1] or 0), int(match[2])
    if not first < stop:
        return None
    if stop - first <= MAX_LISTED:
        return ", ".join(f"{name}[{index}]" for index in range(first, stop))
    return f"{name}[{f'k + {first}' if first else 'k'}] for k in range({stop - first})"


def two_indices(text: str, _key: str) -> Step | None:
    """Find `grid[y, x]`."""
    found = tokens(text)
    for at, token in enumerate(found):
        if token.text != "[" or begins_operand(found, at):
            continue
        read = arguments(text, found, at)
        if read is None or len(read[0]) < 2 or not all(map(reads, read[0])):
            continue
        new, end = "".join(f"[{index}]" for index in read[0]), found[read[1]].end
        if found[at - 1].text == "list":
            new = f"list({', '.join(read[0])})"
            message = "list is called with parentheses"
            return replacing(text, found[at - 1].start, end, new, message, f"write {new}")
        message = "each index of a list of lists has brackets of its own"
        return replacing(text, token.start, end, new, message, f"write {new}")
    return None


def comprehension(text: str, _key: str) -> Step | None:
    """Find `[e for v in S]`."""
    found = tokens(text)
    for at, token in enumerate(found):
        end = closing(found, at) if token.text == "[" and begins_operand(found, at) else None
        if end is None or not any(
            found[index].text == "for" and _is_outer(found, at, index) for index in range(at, end)
        ):
            continue
        inner, stop = text[token.end : found[end].start].strip(), found[end].end
        around = _text_of(found[at - 1 : at] if at else ()), _text_of(found[end + 1 : end + 2])
        function = found[at - 2].text if at > 1 else ""
        is_alone = around == ("(", ")") and function in AGGREGATES
        new = inner if is_alone else f"list({inner})"
        message = "a generator stands without brackets" if is_alone else "a list is written list(...)"
        shown = f"{function}({inner})" if is_alone else new
        return replacing(text, token.start, stop, new, message, f"write {shown}")
    return None


def filtered(text: str, _key: str) -> Step | None:
    """Find `sum(e for v in S if c)`."""
    found = tokens(text)
    for at, token in enumerate(found):
        end = closing(found, at) if token.text == "(" and at else None
        if end is None or found[at - 1].text not in AGGREGATES:
            continue
        words = [(index, found[index].text) for index in range(at + 1, end) if _is_outer(found, at, index)]
        loop = next((index for index, word in words if word == "for"), None)
        condition_at = next((index for index, word in words if word == "if" and loop and index > loop), None)
        if loop is None or condition_at is None:
            continue
        element = text[token.end : found[loop].start].strip()
        source = text[found[loop].start : found[condition_at].start].strip()
        condition = " and ".join(
            part.strip() for part in re.split(r"\bif\b", text[found[condition_at].end : found[end].start])
        )
        function, begin = found[at - 1].text, found[at - 1].start
        new = _with_condition(function, element, source, condition)
        message = "a generator has no if: a conditional says what the others count"
        start = found[condition_at].start
        changed = None if new is None else spliced(text, begin, found[end].end, new[0])
        advice = "use a conditional: x if ... else ..." if new is None else f"write {new[0]}"
        return Step(start, found[end].start - start, message, advice, changed, new is not None and new[1])
    return None


def _is_outer(found: Sequence[Token], begin: int, at: int) -> bool:
    """Return whether a token stands between the brackets that open at `begin`, and in no inner ones."""
    depth = sum((part.text in ("(", "[")) - (part.text in (")", "]")) for part in found[begin:at])
    return depth == 1


def _with_condition(function: str, element: str, source: str, condition: str) -> tuple[str, bool] | None:
    """Return an aggregate of those elements for which a condition holds, and whether it is the same in all cases."""
    part = f"({element})" if " if " in element else element
    if re.fullmatch(r"for (\w+) in team", source) and condition in (
        f"{source.split()[1]} != robot",
        f"robot != {source.split()[1]}",
    ):
        return f"{function}({element} {source.removesuffix('team')}others)", True
    whole = condition if re.fullmatch(SIMPLE, condition) else f"({condition})"
    own = element if re.fullmatch(SIMPLE, element) else f"({element})"
    match function:
        case "sum":
            return f"sum({part} if {condition} else 0 {source})", True
        case "any":
            return f"any({whole} and {own} {source})", True
        case "all":
            return f"all(not {whole} or {own} {source})", True
        case "min":
            return f"min({part} if {condition} else {FAR} {source})", False
        case "max":
            return f"max({part} if {condition} else -{FAR} {source})", False
        case "mean":
            number = f"max(sum(1 if {condition} else 0 {source}), 1)"
            return f"sum({part} if {condition} else 0 {source}) / {number}", False
    return None


def repeated(text: str, _key: str) -> Step | None:
    """Find `[0] * n`."""
    found = tokens(text)
    for at, token in enumerate(found):
        read = arguments(text, found, at) if token.text == "[" and begins_operand(found, at) else None
        if read is None or len(read[0]) != 1 or _text_of(found[read[1] + 1 : read[1] + 2]) != "*":
            continue
        behind = operand_end(found, read[1] + 2)
        if behind is None or not reads(read[0][0]):
            continue
        number, stop = text[found[read[1] + 2].start : found[behind - 1].end], found[behind - 1].end
        name = "j" if " for k in " in read[0][0] else "k"
        new = f"list({read[0][0]} for {name} in range({number}))"
        message = "a list is not repeated by *"
        return replacing(text, token.start, stop, new, message, f"write {new}")
    return None


def membership(text: str, _key: str) -> Step | None:
    """Find `x in [a, b]`, `x not in (a, b)`, `x is a`."""
    found = tokens(text)
    for at, token in enumerate(found):
        is_not = at > 0 and found[at - 1].text == "not" and token.text == "in"
        begin = operand_start(found, at - is_not) if token.text in ("in", "is") and at else None
        if begin is None or _is_of_generator(found, begin):
            continue
        if token.text == "is":
            negated = _text_of(found[at + 1 : at + 2]) == "not"
            stop = found[at + 1].end if negated else token.end
            sign = "!=" if negated else "=="
            message = 'there is no "is" in expressions'
            return replacing(text, token.start, stop, sign, message, f"write {sign}")
        read = arguments(text, found, at + 1) if _text_of(found[at + 1 : at + 2]) in ("[", "(", "{") else None
        if read is None or not read[0] or not all(map(reads, read[0])):
            continue
        value, (sign, word) = (
            text[found[begin].start : found[at - is_not].start].strip(),
            _signs(is_not=is_not),
        )
        new = f" {word} ".join(f"{value} {sign} {item}" for item in read[0])
        stop = found[read[1]].end
        is_whole = begin == 0 and read[1] == len(found) - 1
        shown = new if is_whole or len(read[0]) == 1 else f"({new})"
        message = 'there is no "in" in expressions but after for'
        start = found[begin].start
        return replacing(text, start, stop, shown, message, f"write {new}")
    return None


def _signs(*, is_not: bool) -> tuple[str, str]:
    return ("!=", "and") if is_not else ("==", "or")


def _is_of_generator(found: Sequence[Token], at: int) -> bool:
    """Return whether a name stands behind `for`, perhaps after others: `for x, y in`."""
    while at > 0 and (found[at].text == "," or found[at].kind == "word"):
        if found[at].text == "for":
            return True
        at -= 1
    return found[at].text == "for"


def list_in_brackets(text: str, _key: str) -> Step | None:
    """Find `[a, b]` where a value stands."""
    found = tokens(text)
    for at, token in enumerate(found):
        read = arguments(text, found, at) if token.text == "[" and begins_operand(found, at) else None
        if read is None or not read[0] or not all(map(reads, read[0])):
            continue
        new, stop = f"list({', '.join(read[0])})", found[read[1]].end
        message = "a list is not written in brackets alone"
        return replacing(text, token.start, stop, new, message, f"write {new}")
    return None


def tuple_of_values(text: str, _key: str) -> Step | None:
    """Find `(8, 8)`, and `8, 8` as a whole text."""
    found = tokens(text)
    is_bare = bool(found) and (found[0].text != "(" or closing(found, 0) != len(found) - 1)
    inner = f"({text})" if is_bare else text
    read = arguments(inner, tokens(inner), 0) if found else None
    if read is None or len(read[0]) < 2 or not all(map(reads, read[0])):
        return None
    new = f"list({', '.join(read[0])})"
    return Step(
        0, len(text), "a list is not written with commas alone", f"write {new}", new, is_certain=False
    )


def braces(text: str, _key: str) -> Step | None:
    """Find `lamp{1}`, an element of a cell array of MATLAB, which counts from 1."""
    found = tokens(text)
    for at, token in enumerate(found):
        read = arguments(text, found, at) if token.text == "{" and not begins_operand(found, at) else None
        if read is None or not read[0] or not all(map(reads, read[0])):
            continue
        indices = [str(int(each) - 1) if re.fullmatch(r"[1-9]\d*", each) else each for each in read[0]]
        new, end = "".join(f"[{index}]" for index in indices), found[read[1]].end
        message = "an element stands in [...], and elements count from 0"
        return replacing(text, token.start, end, new, message, f"write {new}", is_certain=False)
    return None
