"""What is left of a spec without its mistakes of form, so that the mistakes of meaning in the rest can be told too."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, cast

from bbsd.language.validation import child, names_lost, path_of, validate

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pydantic_core import ErrorDetails

    from bbsd.expression.scope import Path
    from bbsd.language.models import Spec
    from bbsd.text import Data

UNKNOWN: Final = "stands_for_a_mistake"
"""An expression, or a name, about which nothing is said."""
ANY: Final = "*"
ROUNDS = 4


class _HopelessError(Exception):
    """So much is missing that whatever would be said of the rest would only follow from it."""


class _Mark:
    pass


DELETE: Final = _Mark()
HOPELESS: Final = _Mark()
WRONG_KEYS: Final = ("extra_forbidden", "bad_name")

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
"""What is put in the place of a wrong value, by its path; what is not listed is deleted."""


@dataclass(frozen=True, slots=True)
class Recovered:
    """A spec with stand-ins, names about which nothing is to be said, and codes of what may only follow."""

    spec: Spec
    broken: frozenset[str]
    dependent: frozenset[str]


def recover(data: Data, errors: Sequence[ErrorDetails]) -> Recovered | None:
    """What is left of a spec without what is wrong with it; None where that says nothing."""
    broken, dependent = {UNKNOWN}, set[str]()
    for _ in range(ROUNDS):
        mended = deepcopy(data)
        for error in errors:
            path = _blamed(error, data)
            broken |= names_lost(error) | _names_below(error)
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


def _blamed(error: ErrorDetails, data: Data) -> Path:
    path = path_of(error, data)
    return (*path, error["loc"][-1]) if error["type"] == "missing" else path


def _names_below(error: ErrorDetails) -> set[str]:
    """The names that stood below a key that was not expected."""
    below = error["input"] if error["type"] == "extra_forbidden" else ()
    return {str(name) for name in below} if isinstance(below, dict | list) else set()


def _dependent(path: Path) -> set[str]:
    """Mistakes that may only follow from what is wrong at a path."""
    match path:
        case ("environment", "robots"):
            return {"BB057", "BB059"}
        case ("behaviors",):
            return {"BB042"}
        case ("behaviors", _, "inputs"):
            return {"BB034", "BB046"}
        case ("behaviors", _, "inputs" | "actions", *_):
            return {"BB046"}
        case ("design", *_):
            return {"BB042", "BB043"}
    return set()


def _mend(data: Data, path: Path, error: str) -> None:
    """Put into `data` what stands for a wrong value, or take a wrong key away."""
    place, value = _replacement(path)
    if value is HOPELESS and error not in WRONG_KEYS:
        raise _HopelessError
    if error in WRONG_KEYS and path[2:3] != ("rules",):
        place, value = path, DELETE
    parent = _child(data, place[:-1])
    if isinstance(parent, dict) and isinstance(value, _Mark):
        parent.pop(str(place[-1]), None)
    elif isinstance(parent, dict):
        parent[str(place[-1])] = deepcopy(cast("Data", value))
    elif isinstance(parent, list):
        parent[int(place[-1])] = deepcopy(cast("Data", value))


def _child(data: Data, path: Path) -> Data:
    return _child(child(data, path[0]), path[1:]) if path else data


def _replacement(path: Path) -> tuple[Path, Data | _Mark]:
    """The longest listed start of a path, and what is put there."""
    for length in range(len(path), 0, -1):
        start = path[:length]
        for pattern, value in STAND_INS.items():
            if len(pattern) == length and all(map(_fits, pattern, start)):
                return start, value
    return path, DELETE


def _fits(wanted: str, segment: str | int) -> bool:
    return wanted in (ANY, segment)
