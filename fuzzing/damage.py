"""Random damage to specs: to their text, their data and their expressions."""

from __future__ import annotations

import re
from copy import deepcopy
from typing import TYPE_CHECKING, Any

import yaml

from bbsd.expression.vocabulary import WORDS

if TYPE_CHECKING:
    import random
    from collections.abc import Callable, Iterator

    Damage = Callable[[str, random.Random], str]
    """Maps a text and a random generator to a damaged text."""

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
WORDS_AND_SIGNS = [*sorted(WORDS), *SIGNS]


def change_character(text: str, dice: random.Random) -> str:
    """Replace, insert or delete a character."""
    index = dice.randrange(len(text) + 1)
    other = chr(
        dice.choice((dice.randrange(32, 127), dice.randrange(1, 0x2FFF), dice.randrange(0x10000, 0x1FFFF)))
    )
    return text[:index] + other + text[index + dice.randint(0, 2) :]


def change_line(text: str, dice: random.Random) -> str:
    """Delete, double, indent or replace a line."""
    parts = text.split("\n")
    index, other = dice.randrange(len(parts)), dice.randrange(len(parts))
    parts[index] = dice.choice(
        ("", parts[other], "  " * dice.randint(0, 5) + parts[index].strip(), parts[index] * 2)
    )
    return "\n".join(parts)


def replace_word(text: str, dice: random.Random) -> str:
    """Replace a word or sign by another."""
    parts = re.split(r"(\W)", text)
    parts[dice.randrange(len(parts))] = dice.choice((*WORDS_AND_SIGNS, *NAMES, *EXPRESSIONS, *parts))
    return "".join(parts)


def repeat_part(text: str, dice: random.Random) -> str:
    """Repeat a part of the text somewhere else."""
    first, last = sorted((dice.randrange(len(text) + 1), dice.randrange(len(text) + 1)))
    part = text[first : min(last, first + 200)]
    index = dice.randrange(len(text) + 1)
    return text[:index] + part + text[index:]


def wrong_value(dice: random.Random) -> Any:  # noqa: ANN401 - any plain value
    """Return a plain value that is wrong almost everywhere."""
    return dice.choice(
        (None, True, dice.choice(NUMBERS), dice.choice(NAMES), dice.choice(EXPRESSIONS), [], {})
    )


def random_data(dice: random.Random, depth: int = 4) -> Any:  # noqa: ANN401 - any plain value
    """Return random data."""
    if depth == 0 or dice.random() < 0.3:
        return wrong_value(dice)
    if dice.random() < 0.5:
        return [random_data(dice, depth - 1) for _ in range(dice.randint(0, 4))]
    return {_key(dice): random_data(dice, depth - 1) for _ in range(dice.randint(0, 4))}


def _key(dice: random.Random) -> str:
    return dice.choice((dice.choice(NAMES), dice.choice(sorted(WORDS)), f"n{dice.randrange(30)}"))


def change_data(text: str, dice: random.Random) -> str:
    """Change the data of a spec in one to four places, and write it as YAML again."""
    try:
        data = yaml.safe_load(text)
        for _ in range(dice.randint(1, 4)):
            places = list(_places(data))
            if not places:
                return text
            _change_value(*dice.choice(places), dice)
        return yaml_text(data, dice)
    except (yaml.YAMLError, ValueError, RecursionError):  # raised, for example, for data that contains itself
        return text


def yaml_text(data: Any, dice: random.Random) -> str:  # noqa: ANN401 - any plain value
    """Return plain data as YAML, in a random one of its styles."""
    style, width = dice.choice((None, True, False)), dice.choice((20, 80, 100_000))
    return yaml.safe_dump(data, default_flow_style=style, width=width, allow_unicode=True, sort_keys=False)


def _places(data: Any) -> Iterator[tuple[Any, Any]]:  # noqa: ANN401 - any plain value
    """Yield every key of every mapping and every index of every list, each after its container."""
    keys = list(data) if isinstance(data, dict) else range(len(data)) if isinstance(data, list) else ()
    for key in keys:
        yield data, key
        yield from _places(data[key])


def _change_value(within: Any, key: Any, dice: random.Random) -> None:  # noqa: ANN401 - any plain value
    value = within[key]
    match dice.randrange(7):
        case 0:
            within[key] = wrong_value(dice)
        case 1:
            within[key] = random_data(dice)
        case 2:
            del within[key]
        case 3:
            within[key] = dice.choice(
                ([value], {"value": value}, [value] * dice.choice((2, 300)), wrap(value, dice))
            )
        case 4 if isinstance(within, dict):
            within[_key(dice)] = within.pop(key) if dice.random() < 0.5 else deepcopy(value)
        case 5 if isinstance(value, str):
            within[key] = change_expression(value, dice)
        case _:
            other, other_key = dice.choice(list(_places(within)))
            within[key] = deepcopy(other[other_key])


def wrap(value: Any, dice: random.Random) -> Any:  # noqa: ANN401 - any plain value
    """Wrap a value in many lists or mappings."""
    for _ in range(dice.choice((3, 38, 60))):
        value = [value] if dice.random() < 0.5 else {"a": value}
    return value


def change_expression(text: str, dice: random.Random) -> str:
    """Replace, wrap or repeat a part of an expression."""
    parts = re.split(r"(\W)", text)
    match dice.randrange(5):
        case 0:
            parts[dice.randrange(len(parts))] = dice.choice((*WORDS_AND_SIGNS, *parts))
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


DAMAGES: tuple[Damage, ...] = (change_character, change_line, replace_word, repeat_part, change_data)


def damaged(text: str, dice: random.Random) -> str:
    """Damage a text one to six times."""
    for _ in range(dice.randint(1, 6)):
        text = dice.choice(DAMAGES)(text, dice)
        if len(text) > 1_000_000:
            return text[:1_000_000]
    return text
