"""Functions, modules and attributes of other languages, brackets without a partner, and lists of arguments."""

from __future__ import annotations

import itertools
import re

from bbsd.expression.foreign.functions import OTHER_NAMES, other_name
from bbsd.expression.foreign.tokens import (
    OPENING,
    Step,
    arguments,
    operand_start,
    reads,
    replacing,
    spliced,
    tokens,
)
from bbsd.expression.vocabulary import AGGREGATES, DRAWS, FUNCTIONS

MODULES = frozenset({"math", "np", "numpy", "Math", "cmath", "torch", "jnp", "random", "std", "m"})
OWNERS = frozenset({"self", "this", "state", "world", "env", "environment", "constants", "sensors", "me"})
TEAMS = frozenset({"robots", "robot", "agents", "agent", "team", "others", "other"})


def module(text: str, _key: str) -> Step | None:
    """Find a function or a number of a module: `math.sin(x)`, `np.random.uniform(0, 1)`, `math.pi`."""
    for match in re.finditer(r"(?<![\w.])((?:[A-Za-z_]\w*(?:\.|::))+)([A-Za-z_]\w*)", text):
        owners = re.split(r"\.|::", match[1])[:-1]
        if owners[0] not in MODULES:
            continue
        message = f'there are no modules: "{match[0]}"'
        new = f"{match[2]}"
        stop = match.end()
        called = _call_at(text, match.start(2))
        if called and (other := other_name(match[2], called[0])):
            new, stop = other[0], called[1]
        shown = f"{match[2]}(...)" if new == match[2] and called else new
        step_text = spliced(text, match.start(), stop, new)
        return Step(
            match.start(),
            match.end() - match.start(),
            message,
            f"write {shown}",
            step_text,
            new != match[2] or _is_known(new),
        )
    return None


def _is_known(name: str) -> bool:
    return name in FUNCTIONS or name in AGGREGATES or name in DRAWS or name == "pi"


def _call_at(text: str, start: int) -> tuple[list[str], int] | None:
    """Return the arguments of the call of the name that begins at a position, and where it ends."""
    found = tokens(text)
    at = next((i for i, token in enumerate(found) if token.start == start), None)
    if at is None or at + 1 >= len(found) or found[at + 1].text != "(":
        return None
    read = arguments(text, found, at + 1)
    return (read[0], found[read[1]].end) if read else None


def attribute(text: str, _key: str) -> Step | None:
    """Find the value of something: `robots[1].x`, `self.x`, `x.abs()`."""
    found = tokens(text)
    for at, dot in enumerate(found):
        if dot.text != "." or at == 0 or at + 1 >= len(found) or found[at + 1].kind != "word":
            continue
        name, begin = found[at + 1], operand_start(found, at)
        if begin is None:
            continue
        owner = found[begin]
        written = text[owner.start : name.end]
        if owner.text in OWNERS and begin == at - 1:
            message = f'nothing belongs to something by a point: "{written}"'
            new = spliced(text, owner.start, name.end, name.text)
            return Step(owner.start, name.end - owner.start, message, f"write {name.text}", new)
        if found[at - 1].text == "]" and owner.text in TEAMS:
            index = text[found[begin + 1].start : found[at - 1].end]
            new = f"{name.text}{index}"
            message = f'another robot\'s value is not written "{written}"'
            return replacing(text, owner.start, name.end, new, message, f"write {new}")
        called = _call_at(text, name.start)
        if called and (_is_known(name.text) or name.text in OTHER_NAMES):
            values = [text[owner.start : dot.start], *called[0]]
            new = (other_name(name.text, values) or (f"{name.text}({', '.join(values)})", True))[0]
            message = f'a function is called before its arguments: "{written}(...)"'
            return Step(
                owner.start,
                name.end - owner.start,
                message,
                f"write {new}",
                spliced(text, owner.start, called[1], new),
            )
        if re.search(rf"\bfor\s+{owner.text}\s+in\b", text) and begin == at - 1:
            new = f"{name.text}[{owner.text}]"
            message = f'another robot\'s value is not written "{written}"'
            changed = spliced(text, owner.start, name.end, new)
            return Step(owner.start, name.end - owner.start, message, f"write {new}", changed)
        if owner.text in TEAMS:
            message = f'another robot\'s value is not written "{written}"'
            return Step(
                owner.start,
                name.end - owner.start,
                message,
                f"write {name.text}[0] for the first robot's",
                None,
            )
    return None


def foreign_function(text: str, _key: str) -> Step | None:
    """Find a function that is called by another name here; only where something else is foreign too."""
    found = tokens(text)
    for at, (name, bracket) in enumerate(itertools.pairwise(found)):
        if name.kind == "word" and bracket.text == "(" and (read := arguments(text, found, at + 1)):
            other = other_name(name.text, read[0])
            if other:
                stop = found[read[1]].end
                new = spliced(text, name.start, stop, other[0])
                return Step(
                    name.start,
                    len(name.text),
                    f'unknown function "{name.text}"',
                    f"write {other[0]}",
                    new,
                    other[1],
                )
    return None


def listed_arguments(text: str, _key: str) -> Step | None:
    """Find arguments that stand in a list: `cut(x, [1, 2])`, `max([a, b])`."""
    found = tokens(text)
    for at, token in enumerate(found):
        if token.text not in ("[", "{") or at == 0 or found[at - 1].text not in ("(", ","):
            continue
        read = arguments(text, found, at)
        begin = next((i for i in range(at - 1, -1, -1) if found[i].text == "("), None)
        if read is None or begin is None or begin == 0 or found[begin - 1].kind != "word":
            continue
        function = found[begin - 1].text
        if (
            read[1] + 1 >= len(found)
            or found[read[1] + 1].text != ")"
            or " for " in text[token.end : found[read[1]].start]
        ):
            continue
        if function in AGGREGATES or function in FUNCTIONS or function in ("cut", "values"):
            inner = text[token.end : found[read[1]].start].strip()
            stop = found[read[1]].end
            what = "the bounds of cut" if function == "cut" else f"the arguments of {function}"
            message = f"{what} are no list: they stand one by one, without brackets"
            return replacing(text, token.start, stop, inner, message, "")
    return None


def open_bracket(text: str, _key: str) -> Step | None:
    """Find a bracket that is never closed, or one that closes nothing."""
    still_open: list[int] = []
    for position, sign in enumerate(text):
        if sign in OPENING:
            still_open.append(position)
        elif sign in OPENING.values():
            wanted = OPENING[text[still_open.pop()]] if still_open else ""
            if sign != wanted:
                advice = f"{wanted} is missing before it" if wanted else f"this {sign} closes nothing"
                without = spliced(text, position, position + 1, wanted)
                return Step(position, 1, "", advice, without if reads(without) else None, not wanted)
    if not still_open:
        return None
    sign = text[still_open[-1]]
    places = [token.end for token in tokens(text) if token.start >= still_open[-1]]
    closed = [new for place in places if reads(new := spliced(text, place, place, OPENING[sign]))]
    last = closed[-1] if closed else None
    behind = "what belongs into it"
    if last is not None:
        stop = max(place for place in places if reads(spliced(text, place, place, OPENING[sign])))
        behind = text[still_open[-1] + 1 : stop].strip()
    advice = f'write "{OPENING[sign]}" behind {behind}'
    return Step(still_open[-1], 1, f'this "{sign}" is never closed', advice, last, len(closed) == 1)
