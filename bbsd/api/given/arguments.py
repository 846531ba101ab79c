"""What each argument of the verbs can be: it is honored, or refused in words before anything is done."""

from __future__ import annotations

import inspect
import json
import math
import os
from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import wraps
from numbers import Integral, Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from bbsd.errors import UsageError, did_you_mean

if TYPE_CHECKING:
    from collections.abc import Callable

    Rule = Callable[[str, Any], Any]
    """Given an argument's name and value, returns the value as it is used, or raises BadArgument."""

P = ParamSpec("P")
T = TypeVar("T")

Assignments = Sequence[str] | Mapping[str, Any]
"""Values of the spec to set: texts such as "design.budget=300_000", or a dict such as {"design.budget": 300_000}."""
MOST_SEED = 2**64 - 1


class BadArgument(UsageError):
    """An argument of a wrong type, out of its range, or one that has no effect beside another."""

    def __init__(self, message: str, advice: str = "") -> None:
        super().__init__(message)
        self.advice = advice


def assignments(given: Assignments) -> tuple[str, ...]:
    """Return values to set as texts PATH=VALUE. Raises BadArgument for anything else."""
    if isinstance(given, Mapping):
        return tuple(_assignment(path, value) for path, value in given.items())
    advice = 'write set=["design.budget=300_000"] or set={"design.budget": 300_000}'
    return _texts("set", given, advice)


def _assignment(path: object, value: object) -> str:
    if not isinstance(path, str):
        raise BadArgument(f"set: the path of a value is text, not {path!r:.60}")
    try:
        return f"{path}={json.dumps(value, ensure_ascii=False, allow_nan=False)}"
    except (TypeError, ValueError, RecursionError):
        raise BadArgument(f"set: {path} cannot be set to {value!r:.60}") from None


def _texts(name: str, value: object, advice: str = "") -> tuple[str, ...]:
    if isinstance(value, str):
        raise BadArgument(
            f"{name} is a list of texts, not one text", advice or f'write {name}=["{value:.60}"]'
        )
    if not isinstance(value, Iterable):
        raise BadArgument(f"{name} is a list of texts, not {value!r:.60}", advice)
    found = tuple(value)
    for each in found:
        if not isinstance(each, str):
            raise BadArgument(f"{name} is a list of texts, and {each!r:.60} is none", advice)
    return found


def texts(name: str, value: object) -> tuple[str, ...]:
    """Take a list of texts, never one text, whose letters it would be."""
    return _texts(name, value)


def paths(name: str, value: object) -> tuple[Path, ...]:
    """Take a list of paths."""
    if isinstance(value, str | os.PathLike) or not isinstance(value, Iterable):
        raise BadArgument(f"{name} is a list of paths, not {value!r:.60}", f'write {name}=["{value}"]')
    return tuple(path(name, each) for each in value)


def path(name: str, value: object) -> Path:
    """Take a path."""
    if not isinstance(value, str | os.PathLike) or not isinstance(os.fspath(value), str):
        raise BadArgument(f"{name} is a path, not {value!r:.60}")
    if not str(value) or "\0" in str(value):
        raise BadArgument(f"{name} is a path, and {str(value)!r:.60} is none")
    return Path(value)


def whole(least: int, most: int | None = None) -> Rule:
    """Return the rule of a whole number in a range."""
    bounds = f"of {least} or more" if most is None else f"from {least} to {most}"

    def rule(name: str, value: object) -> int:
        if not isinstance(value, Integral) or isinstance(value, bool):
            raise BadArgument(f"{name} is a whole number {bounds}, not {value!r:.60}")
        if int(value) < least or (most is not None and int(value) > most):
            raise BadArgument(f"{name} is a whole number {bounds}, not {int(value)}")
        return int(value)

    return rule


def number(*, above: float | None = None, least: float | None = None) -> Rule:
    """Return the rule of a finite number in a range."""
    bounds = (
        f" above {above:g}" if above is not None else f" of {least:g} or more" if least is not None else ""
    )

    def rule(name: str, value: object) -> float:
        if not isinstance(value, Real) or isinstance(value, bool) or not math.isfinite(value):
            raise BadArgument(f"{name} is a number{bounds}, not {value!r:.60}")
        if (above is not None and value <= above) or (least is not None and value < least):
            raise BadArgument(f"{name} is a number{bounds}, not {value!r:.60}")
        return float(value)

    return rule


def truth(name: str, value: object) -> bool:
    """Take True or False, and nothing that is only like one of them."""
    if type(value).__name__ not in ("bool", "bool_"):  # NumPy's own has either name
        raise BadArgument(f"{name} is True or False, not {value!r:.60}")
    return bool(value)


def one_of(*known: str) -> Rule:
    """Return the rule of one of some words."""

    def rule(name: str, value: object) -> str:
        if not isinstance(value, str) or value not in known:
            near = did_you_mean(value, known) if isinstance(value, str) else ""
            words = f"one of {', '.join(map(repr, known))}" if len(known) > 1 else repr(known[0])
            raise BadArgument(f"{name} is {words}, not {value!r:.60}{near}")
        return value

    return rule


def optional(rule: Rule) -> Rule:
    """Return the rule of an argument that may be None."""
    return lambda name, value: None if value is None else rule(name, value)


def either(first: type, rule: Rule, other: Rule) -> Rule:
    """Return a rule for values of a type, and another one for all others."""
    return lambda name, value: (rule if isinstance(value, first) else other)(name, value)


def function(name: str, value: object) -> object:
    """Take a function or a class."""
    if not callable(value):
        raise BadArgument(f"{name} is a function, not {value!r:.60}")
    return value


def text(name: str, value: object) -> str:
    """Take a text."""
    if not isinstance(value, str):
        raise BadArgument(f"{name} is a text, not {value!r:.60}")
    return value


def mapping(name: str, value: object) -> Mapping[str, Any]:
    """Take a dict whose keys are texts."""
    if not isinstance(value, Mapping) or not all(isinstance(key, str) for key in value):
        raise BadArgument(f"{name} is a dict of values by name, not {value!r:.60}")
    return value


def instance(kind: type) -> Rule:
    """Return the rule of what is of a class."""

    def rule(name: str, value: object) -> object:
        if not isinstance(value, kind):
            raise BadArgument(f"{name} is a {kind.__name__}, not {value!r:.60}")
        return value

    return rule


def anything(_name: str, value: object) -> object:
    """Take what is looked at where it is used: a spec, which `load` opens or refuses."""
    return value


def engine(name: str, value: object) -> object:
    """Take what can do units of work."""
    if not all(hasattr(value, needed) for needed in ("shares_machine", "capacity", "submit")):
        raise BadArgument(f"{name} is one of bbsd.engines, not {value!r:.60}")
    return value


RULES: Mapping[str, Rule] = {
    "agents": whole(1),
    "allow_import": texts,
    "announce": optional(function),
    "api": one_of("gymnasium", "vector", "pettingzoo"),
    "at": optional(mapping),
    "by_table": truth,
    "compiled": truth,
    "engine": optional(engine),
    "environment": optional(function),
    "episode": either(str, one_of("worst", "median", "best"), whole(0)),
    "episodes": whole(1),
    "exact": truth,
    "faults": texts,
    "fill": optional(one_of("random")),
    "finish": optional(function),
    "gymnasium": optional(text),
    "import_from": paths,
    "interval": number(above=0),
    "jobs": whole(1),
    "keep_each": truth,
    "lanes": whole(1),
    "leaves": one_of("script", "custom"),
    "measured": texts,
    "n": optional(whole(1)),
    "not_finite": one_of("refuse", "count"),
    "note": optional(function),
    "observe": one_of("sensors", "cells"),
    "out": optional(path),
    "overdue": optional(function),
    "pettingzoo": optional(text),
    "progress": optional(function),
    "python": optional(text),
    "relearn": truth,
    "remembered": texts,
    "resume": truth,
    "rivals": texts,
    "robot": whole(0),
    "runs": whole(1),
    "seed": whole(0, MOST_SEED),
    "sensing": truth,
    "set": lambda _name, value: assignments(value),
    "starting": number(least=0),
    "step": optional(whole(1)),
    "step_limit": number(above=0),
    "to": text,
    "unwanted": texts,
    "verify": truth,
    "wanted": texts,
    "within": optional(number(above=0)),
    "worth": truth,
}
"""What an argument of that name can be, in every verb that has no rule of its own."""
SPECS = ("spec", "design", "other", "a", "b")
"""Arguments that are specs or designs."""


def checked(**own: Rule) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Return what lets a function take only arguments that it honors; `own` are its own rules, by name.

    Raises KeyError at once where an argument has no rule.
    """

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        signature = inspect.signature(function)
        rules = {
            name: own[name] if name in own else anything if name in SPECS else RULES[name]
            for name in signature.parameters
            if name not in ("self", "cls")
        }

        @wraps(function)
        def call(*arguments: P.args, **options: P.kwargs) -> T:
            try:
                bound = signature.bind(*arguments, **options)
            except TypeError:
                return function(*arguments, **options)  # which says it with the function's name
            for name, value in bound.arguments.items():
                if name in rules:
                    bound.arguments[name] = rules[name](name, value)
            return function(*bound.args, **bound.kwargs)

        return call

    return decorate


def require_none(given: Collection[str], because: str) -> None:
    """Raise BadArgument where arguments are given that would have no effect."""
    if given:
        names = " and ".join(given)
        raise BadArgument(f"{names} {'has' if len(given) == 1 else 'have'} no effect {because}")
