"""A spec without its mistakes of form, so that mistakes of meaning elsewhere in it can be reported too."""

from __future__ import annotations

import re
from copy import deepcopy
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, cast

from bbsd.expression.syntax.one_of import is_one_of
from bbsd.expression.vocabulary import WORDS
from bbsd.language.outside import UNUSED
from bbsd.language.validation import child, names_in, names_lost, path_of, validate

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pydantic_core import ErrorDetails

    from bbsd.expression.scope import Path
    from bbsd.language.models import Spec
    from bbsd.text import Data

UNKNOWN: Final = "stands_for_a_mistake"
"""An expression, or a name, in whose use no mistake is reported."""
ANY: Final = "*"
MAX_MENDINGS = 4
"""Times that a spec is mended and validated again: mending one mistake of form may uncover another."""


class _HopelessError(Exception):
    """So much is missing that mistakes elsewhere would only follow from it."""


class _Mark:
    pass


DELETE: Final = _Mark()
HOPELESS: Final = _Mark()
WRONG_KEYS: Final = ("extra_forbidden", "bad_name")

STAND_IN_TARGETS: Final = {
    "gymnasium": "Unknown-v0",
    "pettingzoo": "unknown.unknown_v0",
    "python": "unknown:Unknown",
}

STAND_INS: dict[tuple[str, ...], Data | _Mark] = {
    ("bbsd",): 1,
    ("name",): "unnamed",
    ("constants",): HOPELESS,
    ("constants", ANY): UNKNOWN,
    ("environment",): HOPELESS,
    ("environment", "robots"): 2,
    ("environment", "steps"): 1,
    **{("environment", block): HOPELESS for block in ("world", "state", "definitions", "sensors")},
    **{("environment", block, ANY): UNKNOWN for block in ("world", "state", "definitions", "sensors")},
    **{("environment", kind): target for kind, target in STAND_IN_TARGETS.items()},
    ("environment", "with"): DELETE,
    ("environment", "observation"): HOPELESS,
    ("environment", "observation", ANY): UNUSED,  # in a list a number without a name, in a mapping a path
    ("environment", "action"): HOPELESS,
    ("behaviors",): {UNKNOWN: {"actions": {UNKNOWN: {}}}},
    ("behaviors", ANY): {"actions": {UNKNOWN: {}}},
    ("behaviors", ANY, "excited"): DELETE,
    ("behaviors", ANY, "expects"): DELETE,
    ("behaviors", ANY, "inputs"): {UNKNOWN: UNKNOWN},
    ("behaviors", ANY, "inputs", ANY): UNKNOWN,
    ("behaviors", ANY, "actions"): {UNKNOWN: {}},
    ("behaviors", ANY, "actions", ANY): {},
    ("behaviors", ANY, "rules"): DELETE,
    ("behaviors", ANY, "table"): DELETE,
    ("behaviors", ANY, "rules", ANY): {"when": {UNKNOWN: UNKNOWN}, "do": "open"},
    ("structure", ANY): "open",
    ("view",): DELETE,
    ("reward",): {UNKNOWN: 0},
}
"""What replaces a wrong value, by its path; values at other paths are deleted."""


@dataclass(frozen=True, slots=True)
class Recovered:
    """A spec with stand-ins, names whose use is not reported, and codes of mistakes that may only follow."""

    spec: Spec
    broken: frozenset[str]
    dependent: frozenset[str]


def recover(data: Data, errors: Sequence[ErrorDetails]) -> Recovered | None:
    """Return a spec with stand-ins for its mistakes of form; None where too much is missing."""
    broken, dependent = {UNKNOWN}, set[str]()
    for _ in range(MAX_MENDINGS):
        mended = deepcopy(data)
        for error in errors:
            path = _path_blamed(error, data)
            broken |= names_lost(error) | _names_below(error) | _values_lost(error)
            dependent |= _dependent(path)
            try:
                _mend(mended, path, error["type"])
            except _HopelessError:
                return None
        data = mended
        spec, errors = validate(data)
        if spec:
            return Recovered(spec, frozenset(broken), frozenset(dependent))
    return None


def _path_blamed(error: ErrorDetails, data: Data) -> Path:
    path = path_of(error, data)
    return (*path, error["loc"][-1]) if error["type"] == "missing" else path


def _names_below(error: ErrorDetails) -> set[str]:
    """Return the names below a key that was not expected."""
    names = error["input"] if error["type"] == "extra_forbidden" else ()
    return {str(name) for name in names} if isinstance(names, dict | list) else set()


def _values_lost(error: ErrorDetails) -> set[str]:
    """Return the names of a state's values that could not be read."""
    text = error["input"]
    if error["type"] == "expression" and isinstance(text, str) and is_one_of(text):
        return {*re.findall(r"\w+", text)} - WORDS
    return {*names_in(text)} if error["type"] == "not_an_expression" else set()


def _dependent(path: Path) -> set[str]:
    """Return the codes of mistakes that may only follow from one at a path."""
    match path:
        case ("environment", "robots"):
            return {"BB057", "BB059"}
        case ("environment", "observation", *_):
            return {"BB109"}
        case ("behaviors",):
            return {"BB042"}
        case ("behaviors", _, "inputs"):
            return {"BB034", "BB046"}
        case ("behaviors", _, "inputs" | "actions", *_):
            return {"BB046"}
        case ("design", *_):
            return {"BB042", "BB043", "BB070", "BB071"}
    return set()


def _mend(data: Data, path: Path, error: str) -> None:
    """Put a stand-in for a wrong value into `data`, or take a wrong key away."""
    target, value = _replacement(path)
    if value is HOPELESS and error not in WRONG_KEYS:
        raise _HopelessError
    if error in WRONG_KEYS and path[2:3] != ("rules",) and isinstance(path[-1], str):
        target, value = path, DELETE
    parent = _value_at(data, target[:-1])
    if isinstance(parent, dict) and isinstance(value, _Mark):
        parent.pop(str(target[-1]), None)
    elif isinstance(parent, dict):
        parent[str(target[-1])] = deepcopy(cast("Data", value))
    elif isinstance(parent, list):
        parent[int(target[-1])] = deepcopy(cast("Data", value))


def _value_at(data: Data, path: Path) -> Data:
    return _value_at(child(data, path[0]), path[1:]) if path else data


def _replacement(path: Path) -> tuple[Path, Data | _Mark]:
    """Return the longest start of a path that has a stand-in, and the stand-in."""
    for length in range(len(path), 0, -1):
        start = path[:length]
        for pattern, value in STAND_INS.items():
            if len(pattern) == length and all(map(_matches, pattern, start)):
                return start, value
    return path, DELETE


def _matches(pattern: str, segment: str | int) -> bool:
    return pattern in (ANY, segment)
