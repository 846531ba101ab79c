"""From plain data to a spec, or to its mistakes of form in a designer's words."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Literal, cast, get_args, get_origin

from annotated_types import Ge, Le
from pydantic import ValidationError

from bbsd.errors import did_you_mean
from bbsd.expression.syntax.mistakes import KEY, WHOLE, Addition, Mistake, Rewriting
from bbsd.expression.vocabulary import WORDS
from bbsd.language.field_types import is_value_name, kind_of, scalar_text
from bbsd.language.goals import goal_mistake, is_block_of_costs, is_goal
from bbsd.language.keys import blocks_with, field_at, fields_at
from bbsd.language.models import Spec

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pydantic.fields import FieldInfo
    from pydantic_core import ErrorDetails

    from bbsd.expression.scope import Path
    from bbsd.text import Data

MAX_ERRORS = 1000
MAX_NAMES = 12
"""Names that an advice repeats."""
MAX_QUOTED, MOST_ITEMS = 40, 4
"""Characters of a wrong text that a message quotes, and equal items that it repeats."""

LocatedMistake = tuple["Path", Mistake]
"""A mistake and its path in the spec."""


def validate(data: Data) -> tuple[Spec | None, list[ErrorDetails]]:
    """Return the spec that plain data are, or pydantic's errors."""
    try:
        return Spec.model_validate(data), []
    except ValidationError as error:
        return None, error.errors(include_url=False)[:MAX_ERRORS]


def form_mistakes(errors: Sequence[ErrorDetails], data: Data) -> list[LocatedMistake]:
    """Return the mistakes behind pydantic's errors, without those that only follow from another."""
    misspelled = {_misspelled(error, errors) for error in errors if error["type"] == "extra_forbidden"}
    unreadable = frozenset().union(*map(names_lost, errors)) - WORDS
    return [
        (path_of(error, data), _mistake(error, data))
        for error in errors
        if not (error["type"] == "missing" and error["loc"] in misspelled) and not _uses(error, unreadable)
    ]


def path_of(error: ErrorDetails, data: Data) -> Path:
    """Return the path of the value or key that an error is about, or of the mapping that lacks a key."""
    location = error["loc"][:-1] if error["type"] == "missing" else error["loc"]
    return existing(location, data)


def existing(location: Path, data: Data) -> Path:
    """Return the location without the segments that lead nowhere: tags of unions, items of what is no list."""
    path: list[str | int] = []
    for segment in location:
        if has(data, segment):
            data = child(data, segment)
            path.append(segment)
    return tuple(path)


def has(data: Data, segment: str | int) -> bool:
    """Return whether there is a value under a key of a mapping, or at an index of a list."""
    if isinstance(segment, int):
        return isinstance(data, list) and 0 <= segment < len(data)
    return isinstance(data, dict) and segment in data


def child(data: Data, segment: str | int) -> Data:
    """Return the value under a key of a mapping, or at an index of a list; None if there is none."""
    if isinstance(data, dict):
        return data.get(str(segment))
    if isinstance(data, list) and isinstance(segment, int) and segment < len(data):
        return data[segment]
    return None


def names_lost(error: ErrorDetails) -> frozenset[str]:
    """Return the names that a wrong key would have made, as they may be used elsewhere."""
    words = re.findall(r"\w+", str(error["input"])) if error["type"] == "bad_name" else ()
    return frozenset(words) | {word.lower() for word in words}


def _misspelled(error: ErrorDetails, errors: Sequence[ErrorDetails]) -> Path | None:
    """Return the path of the missing key that an unexpected one probably misspells."""
    *parent, key = error["loc"]
    if is_goal(error["loc"]):
        return ("reward",)
    missing = [
        other["loc"] for other in errors if other["type"] == "missing" and [*other["loc"][:-1]] == parent
    ]
    hint = did_you_mean(str(key), [str(location[-1]) for location in missing])
    return next((location for location in missing if f'"{location[-1]}"' in hint), None)


def _uses(error: ErrorDetails, names: frozenset[str]) -> bool:
    """Return whether an expression is wrong only because of a name that is reported at its key."""
    words = re.findall(r"\w+", str(error["input"]))
    return error["type"] == "expression" and not names.isdisjoint(words)


def _mistake(error: ErrorDetails, data: Data) -> Mistake:
    path = path_of(error, data)
    match error["type"]:
        case "expression":
            mistake = cast("Mistake", error["ctx"]["mistake"])
            from bbsd.expression.foreign.translating import translated

            return translated(scalar_text(error["input"]) or "", mistake, key_of(path))
        case "mistake":
            return cast("Mistake", error["ctx"]["mistake"])
        case "bad_name":
            return Mistake(error["ctx"]["code"], error["msg"], KEY, error["ctx"]["advice"])
        case "extra_forbidden" if is_goal(path):
            return goal_mistake(path, error["input"])
        case "extra_forbidden":
            return _unexpected(path)
        case "not_an_expression" if is_block_of_costs(path):
            return goal_mistake(path, error["input"])
        case "missing":
            return _missing(path, str(error["loc"][-1]))
        case "too_short" | "string_too_short":
            return Mistake("BB027", f"{named(path)} is empty; it needs at least one {_item(path)}", KEY)
        case "literal_error" if path == ("bbsd",):
            message = (
                f"this is a spec in version {show_value(error['input'])} of the language; only 1 is known"
            )
            return Mistake("BB026", message)
        case "greater_than_equal" | "less_than_equal" | "string_too_long":
            return _not_allowed("BB023", path, error)
        case "literal_error" if isinstance(error["input"], str):
            return _not_allowed("BB023", path, error)
    return _not_allowed("BB022", path, error)


def key_of(path: Path) -> str:
    """Return the key that a value's path ends with, "" for an item of a list."""
    return path[-1] if path and isinstance(path[-1], str) else ""


def _unexpected(path: Path) -> Mistake:
    keys, key = list(fields_at(path[:-1]) or ()), str(path[-1])
    if blocks := blocks_with(key):
        advice = f"it belongs into {' or '.join(blocks)}"
        return Mistake("BB020", f'unexpected key "{key}" here', KEY, advice)
    hint = did_you_mean(key, keys)
    advice = "" if hint else f"the keys here: {', '.join(keys)}"
    return Mistake("BB020", f'unexpected key "{key}"{hint}', KEY, advice)


def _missing(path: Path, key: str) -> Mistake:
    field = field_at((*path, key))
    meaning = field.description.rstrip(".") if field and field.description else ""
    message = f'{named(path)} needs the key "{key}": {meaning[:1].lower()}{meaning[1:]}'
    added = Addition(ADDED[key], path) if key in ADDED else None
    return Mistake("BB021", message, KEY, ADVICE.get(key, ""), added)


ADDED = {"steps": "steps: 100"}
"""Entries that a spec without them may begin with."""
ADVICE = {"bbsd": "write bbsd: 1", "when": "a rule has when and do, or otherwise alone"}


def _not_allowed(code: str, path: Path, error: ErrorDetails) -> Mistake:
    needed = _needed(path, error)
    if error["input"] is None and error["type"] == "not_a_decision":
        message = f"{named(path)} has no value; it must be {needed}"
        advice, correction = "write no action where nothing is done", Rewriting("no action", is_certain=False)
        return Mistake(code, message, WHOLE, advice, correction)
    if error["input"] is None:
        return Mistake(code, f"{named(path)} has no value; it must be {needed}")
    hint = advice = ""
    if error["type"] == "literal_error":
        hint = did_you_mean(str(error["input"]), needed.split(" or "))
    elif error["type"] == "string_type" and isinstance(error["input"], int | float):
        advice = "put it in quotes"
    elif path[:2] in STORED and (names := names_in(error["input"])):
        advice = f"for a value that is one of several names, write one of [{', '.join(names)}]"
    elif error["type"] == "not_an_expression" and (written := list_text(error["input"])):
        advice = f"a list is written {written}"
        if path[:2] in STORED and written.startswith("list(") and len(error["input"]) == len(("low", "high")):
            advice += f", a number drawn between the two {written.replace('list(', 'uniform(', 1)}"
    elif isinstance(error["input"], str) and needed.startswith("a list"):
        advice = "a list is written in brackets: [one, another]"
    return Mistake(
        code, f"{named(path)} must be {needed}, not {show_value(error['input'])}{hint}", WHOLE, advice
    )


def list_text(value: object) -> str:
    """Return how an expression writes a nested list of scalars; nothing for other values, and for long lists."""
    if not isinstance(value, list):
        return scalar_text(value) or ""
    items = [list_text(item) for item in value]
    if not all(items):
        return ""
    is_long = len(items) > MOST_ITEMS and len(set(items)) == 1
    text = f"list({items[0]} for k in range({len(items)}))" if is_long else f"list({', '.join(items)})"
    return text if len(text) <= 2 * MAX_QUOTED else ""


STORED = (("environment", "state"), ("environment", "world"))


def names_in(value: object) -> list[str]:
    """Return the items of a short list that could all be names of values, else none."""
    items = value if isinstance(value, list) and 1 < len(value) <= MAX_NAMES else []
    return items if all(isinstance(item, str) and is_value_name(item) for item in items) else []


NEEDED_BY_KEY = {
    "inputs": "a list of sensors or a mapping of partitions",
    "rules": "a list of rules",
    "structure": "a list of behaviors",
    "with": "a mapping of arguments",
    "observation": "a list of names, or a mapping of names to sizes or paths",
    "action": "the name of a state, or a list of them",
    "culture": "a mapping or none",
    "budget": "a whole number of episodes from 5 000 on, or auto",
    "record": "a whole number from 1 on, a list of them, or none",
}
NEEDED_BY_ITEM = {"record": "a whole number from 1 on"}
NEEDED_BY_ERROR = {
    "not_an_expression": "an expression",
    "not_a_decision": "an action, no action or open",
    "not_a_cell": "the name of a cell",
    "string_type": "text",
    "string_too_long": "text of at most 100 characters",
    "dict_type": "a mapping",
    "model_type": "a mapping",
    "list_type": "a list",
}


def _needed(path: Path, error: ErrorDetails) -> str:
    field = field_at(path)
    if field and get_origin(field.annotation) is Literal:
        return " or ".join(map(str, get_args(field.annotation)))
    if path[:1] == ("view",) and error["type"] == "not_an_expression":
        return "an expression or a list of them"
    if len(path) > 1 and path[-2] in NEEDED_BY_ITEM:
        return NEEDED_BY_ITEM[str(path[-2])]
    is_behavior = len(path) == 2 and path[0] == "behaviors"
    if path and path[-1] in NEEDED_BY_KEY and not is_behavior and error["type"] != "string_type":
        return NEEDED_BY_KEY[str(path[-1])]
    return NEEDED_BY_ERROR.get(error["type"]) or _number_needed(field)


def _number_needed(field: FieldInfo | None) -> str:
    what = "a number" if field and field.annotation is float else "a whole number"
    bounds = field.metadata if field else []
    low = next((bound.ge for bound in bounds if isinstance(bound, Ge)), None)
    high = next((bound.le for bound in bounds if isinstance(bound, Le)), None)
    return f"{what} from {low} on" if high is None else f"{what} from {low} to {_digits(high)}"


def _digits(number: object) -> str:
    return f"{number:,}".replace(",", " ")


ITEMS = {"behaviors": "behavior", "reward": "term", "name": "character"}


def _item(path: Path) -> str:
    return ITEMS.get(str(path[-1]), "cell")


def named(path: Path) -> str:
    """Return what a message calls the value at a path."""
    numbers = [str(segment + 1) for segment in path if isinstance(segment, int)]
    keys = [segment for segment in path if isinstance(segment, str)]
    if not keys:
        return "a spec"
    return keys[-1] if isinstance(path[-1], str) else f"item {'.'.join(numbers)} of {keys[-1]}"


def show_value(value: object) -> str:
    """Return how a message shows a plain value."""
    match value:
        case str():
            return f'text "{value if len(value) <= MAX_QUOTED else value[:MAX_QUOTED] + "..."}"'
        case bool():
            return f"the truth {str(value).lower()}"
        case int() | float():
            return f"{value:g}" if isinstance(value, float) else str(value)
    return kind_of(value)
