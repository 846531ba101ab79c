"""Specs as nobody means them: damaged in their text, in their data and in their expressions, or made up whole."""

from __future__ import annotations

import re
from copy import deepcopy
from typing import TYPE_CHECKING, Any

import yaml

from bbsd.expression.vocabulary import RESERVED

if TYPE_CHECKING:
    import random
    from collections.abc import Callable

    Damage = Callable[[str, random.Random], str]

# fmt: off
SIGNS = [
    "1e308", "0", "-1", "NaN", ".inf", "null", "[", "{", "}", "]", "-", "&a", "*a", "<<", "!!x", "|", ">", "#", "'",
    '"', "é", "x-", "=", "==", "&&", "^", "...", "---", "? ", ": ", "%YAML 1.1", "@", "`", "\\", "\t", "\r", "\u2028",
    "(" * 30, "9" * 400,
]
NAMES = [
    "", " ", "\n", "__class__", "__import__('os')", "a.b", "../x", "A", "ü", "\u202eevil", "\U0001f600", "a\u0301", "1",
    "\x1b[31m", "${x}", "%s", "{0}", "true", "~", "otherwise", "open", "stands_for_a_mistake", "*", "<tag>", "x" * 5000,
]
NUMBERS = [
    0, -1, 1, 2, 64, 65, 256, 2**31, 2**64, 10**30, -(10**30), 1e-320, 1e308, 0.1, float("inf"), float("nan"),
]
EXPRESSIONS = [
    "1 / 0", "0 ** -1", "9 ** 9 ** 9", "2 ** 2 ** 2 ** 2 ** 2", "1e308 * 10", "sqrt(-1)", "before(before(x))",
    "robot[0]", "sum(r for r in team)", "list(x for x in range(10000))", "normal(0, 1)", "cut(x, 1)", "otherwise",
    "lambda: 0", "x.__class__", "list(list(1 for i in range(100)) for j in range(100))", "'a' * 10 ** 9",
]
# fmt: on
WORDS = [*sorted(RESERVED), *SIGNS]


def characters(text: str, dice: random.Random) -> str:
    """A character replaced, put in or taken out."""
    place = dice.randrange(len(text) + 1)
    other = chr(
        dice.choice((dice.randrange(32, 127), dice.randrange(1, 0x2FFF), dice.randrange(0x10000, 0x1FFFF)))
    )
    return text[:place] + other + text[place + dice.randint(0, 2) :]


def lines(text: str, dice: random.Random) -> str:
    """A line taken out, doubled, moved in or out, or put in the place of another."""
    parts = text.split("\n")
    place, other = dice.randrange(len(parts)), dice.randrange(len(parts))
    parts[place] = dice.choice(
        ("", parts[other], "  " * dice.randint(0, 5) + parts[place].strip(), parts[place] * 2)
    )
    return "\n".join(parts)


def words(text: str, dice: random.Random) -> str:
    """A word or sign in the place of another."""
    parts = re.split(r"(\W)", text)
    parts[dice.randrange(len(parts))] = dice.choice((*WORDS, *NAMES, *EXPRESSIONS, *parts))
    return "".join(parts)


def splices(text: str, dice: random.Random) -> str:
    """A part of the text once more, somewhere else."""
    first, last = sorted((dice.randrange(len(text) + 1), dice.randrange(len(text) + 1)))
    part = text[first : min(last, first + 200)]
    place = dice.randrange(len(text) + 1)
    return text[:place] + part + text[place:]


def leaf(dice: random.Random) -> Any:  # noqa: ANN401 - any plain value
    """A value that has no business where it will stand."""
    return dice.choice(
        (None, True, dice.choice(NUMBERS), dice.choice(NAMES), dice.choice(EXPRESSIONS), [], {})
    )


def anything(dice: random.Random, depth: int = 4) -> Any:  # noqa: ANN401 - any plain value
    """Random data."""
    if depth == 0 or dice.random() < 0.3:
        return leaf(dice)
    if dice.random() < 0.5:
        return [anything(dice, depth - 1) for _ in range(dice.randint(0, 4))]
    return {_key(dice): anything(dice, depth - 1) for _ in range(dice.randint(0, 4))}


def _key(dice: random.Random) -> str:
    return dice.choice((dice.choice(NAMES), dice.choice(sorted(RESERVED)), f"n{dice.randrange(30)}"))


def structure(text: str, dice: random.Random) -> str:
    """The data of a spec with one to four places changed, written as YAML again."""
    try:
        data = yaml.safe_load(text)
        for _ in range(dice.randint(1, 4)):
            places = list(_places(data))
            if not places:
                return text
            _change(*dice.choice(places), dice)
        return dumped(data, dice)
    except (yaml.YAMLError, ValueError, RecursionError):  # what was put into itself, say, has no end
        return text


def dumped(data: Any, dice: random.Random) -> str:  # noqa: ANN401 - any plain value
    """Plain data as YAML, in one of its styles."""
    style, width = dice.choice((None, True, False)), dice.choice((20, 80, 100_000))
    return yaml.safe_dump(data, default_flow_style=style, width=width, allow_unicode=True, sort_keys=False)


def _places(data: Any) -> Any:  # noqa: ANN401 - any plain value
    """Every key of a mapping and every item of a list, with what it is in."""
    keys = list(data) if isinstance(data, dict) else range(len(data)) if isinstance(data, list) else ()
    for key in keys:
        yield data, key
        yield from _places(data[key])


def _change(within: Any, key: Any, dice: random.Random) -> None:  # noqa: ANN401 - any plain value
    value = within[key]
    match dice.randrange(7):
        case 0:
            within[key] = leaf(dice)
        case 1:
            within[key] = anything(dice)
        case 2:
            del within[key]
        case 3:
            within[key] = dice.choice(
                ([value], {"value": value}, [value] * dice.choice((2, 300)), nested(value, dice))
            )
        case 4 if isinstance(within, dict):
            within[_key(dice)] = within.pop(key) if dice.random() < 0.5 else deepcopy(value)
        case 5 if isinstance(value, str):
            within[key] = expression(value, dice)
        case _:
            other, place = dice.choice(list(_places(within)))
            within[key] = deepcopy(other[place])


def nested(value: Any, dice: random.Random) -> Any:  # noqa: ANN401 - any plain value
    """A value in so many lists or mappings."""
    for _ in range(dice.choice((3, 38, 60))):
        value = [value] if dice.random() < 0.5 else {"a": value}
    return value


def expression(text: str, dice: random.Random) -> str:
    """An expression with a part changed, wrapped or repeated."""
    parts = re.split(r"(\W)", text)
    match dice.randrange(5):
        case 0:
            parts[dice.randrange(len(parts))] = dice.choice((*WORDS, *parts))
        case 1:
            parts[dice.randrange(len(parts))] = f"({dice.choice(EXPRESSIONS)})"
        case 2:
            name = dice.choice(("abs", "sum", "list", "not ", "-", "before", "max", "cut", "values", "floor"))
            depth = dice.choice((1, 5, 45, 500))
            return f"{name}(" * depth + text + ")" * depth
        case 3:
            return f"({text})" + f" {dice.choice('+*/%<&')} ({text})" * dice.choice((1, 5, 50))
        case _:
            over = dice.choice((1, 64, 9999, 10**9))
            return f"{dice.choice(('sum', 'list', 'max', 'any'))}({text} for i in range({over}))"
    return "".join(parts)


DAMAGES: tuple[Damage, ...] = (characters, lines, words, splices, structure)


def damaged(text: str, dice: random.Random) -> str:
    """The text with one to six things done to it."""
    for _ in range(dice.randint(1, 6)):
        text = dice.choice(DAMAGES)(text, dice)
        if len(text) > 1_000_000:
            return text[:1_000_000]
    return text
