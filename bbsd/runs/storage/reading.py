"""Records as they are read again: whatever somebody made of a file, what comes out has the types that are expected."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

NUMBER = (int, float)
LINE: dict[str, tuple[type, ...]] = {
    "run": (int,),
    "generation": (int,),
    "episodes": (int,),
    "measured": (int,),
    "mean": NUMBER,
    "best": NUMBER,
    "sd": NUMBER,
    "lifetime": NUMBER,
    "method": (str,),
    "stage": (str,),
    "ended_by": (str,),
    "diversity": (dict,),
    "structure": (list,),
}
"""The types of what a line of metrics has."""
NEEDED = ("run", "mean", "structure")
"""Keys without which a line of metrics is none."""
FORMS = (
    (*NEEDED, "generation", "best", "sd", "lifetime", "diversity"),
    (*NEEDED, "method", "stage", "episodes", "measured"),
)
"""What all lines of a file have: those of generations, or those of a search."""
RUN: dict[str, tuple[type, ...]] = {
    "bbsd": (str,),
    "revision": (int,),
    "spec": (dict,),
    "seed": (int,),
    "runs": (int,),
    "environment": (dict,),
    "set": (list,),
    "start": (str,),
    "starts": (list,),
    "versions": (dict,),
    "machine": (dict,),
    "reproducible": (bool,),
    "not_reproducible": (str,),
    "result": (dict,),
}
"""The types of what `run.json` has; its budgets are looked at where they are used."""
MOST = 2**53
"""Whole numbers beyond it are none that bbsd writes."""


def plain_data(content: str | bytes) -> Any:  # noqa: ANN401 - any plain value
    """Return what a text of JSON holds. Raises ValueError where it holds nothing, or is nested without end."""
    try:
        return json.loads(content)
    except RecursionError:
        raise ValueError("it is nested too deep") from None


def run_record(content: str | bytes) -> dict[str, Any]:
    """Return what a text of `run.json` says, without what has another type than bbsd writes."""
    value = plain_data(content)
    if not isinstance(value, dict):
        return {}
    return {key: item for key, item in value.items() if key not in RUN or _is_a(item, RUN[key])}


def is_line(value: object) -> bool:
    """Return whether a value is a line of metrics."""
    return (
        isinstance(value, dict)
        and all(key in value for key in NEEDED)
        and all(_is_a(value[key], types) for key, types in LINE.items() if key in value)
        and all(isinstance(name, str) for name in value["structure"])
        and all(_is_a(each, NUMBER) for each in value.get("diversity", {}).values())
    )


def are_metrics(values: Sequence[object]) -> bool:
    """Return whether values are the metrics of a run: lines of generations, or lines of a search."""
    lines = [value for value in values if isinstance(value, dict) and is_line(value)]
    return len(lines) == len(values) and (
        any(all(key in line for line in lines for key in form) for form in FORMS)
    )


def is_whole(value: object) -> bool:
    """Return whether a value is a whole number that bbsd could have written; a truth value is none."""
    return type(value) is int and abs(value) <= MOST


def _is_a(value: object, types: tuple[type, ...]) -> bool:
    return type(value) in types and (type(value) is not int or is_whole(value))
