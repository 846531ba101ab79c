"""Definitions: names and parameters from their keys, and who shares a namespace with whom."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from bbsd.expression.mistakes import Mistake
from bbsd.expression.parsing import NAME
from bbsd.expression.scope import Definition, Findings, Path, Unusable
from bbsd.expression.tree import Span
from bbsd.expression.vocabulary import RESERVED
from bbsd.spec.meaning.constants import expressions_in
from bbsd.spec.meaning.order import circles, dependencies
from bbsd.spec.models import OTHERWISE, Spec
from bbsd.spec.written import Expression

KEY = re.compile(r"\s*(?P<name>\w+)\s*(?:\((?P<parameters>[^()]*)\))?\s*\Z")


def definitions(written: Mapping[str, Expression], findings: Findings) -> dict[str, Definition]:
    """Each definition by its name; a key that cannot be read is told of and passed over."""
    found: dict[str, Definition] = {}
    for key, expression in written.items():
        path: Path = ("environment", "definitions", key)
        match = KEY.match(key)
        names = _names(match) if match else []
        wrong = next((name for name in names if not NAME.match(name) or name in RESERVED), None)
        if not names or wrong is not None or len(set(names)) < len(names):
            message = f'"{key}" cannot be a definition\'s name'
            findings.mistakes[path, Mistake("BB024", message, Span(0, 0), "write name or name(a, b), in small letters")] = None
        else:
            found[names[0]] = Definition(tuple(names[1:]), expression.tree, path)
    return found


def _names(match: re.Match[str]) -> list[str]:
    parameters = match["parameters"]
    return [match["name"], *(name.strip() for name in parameters.split(","))] if parameters else [match["name"]]


def blocks(spec: Spec, defined: Mapping[str, Definition]) -> list[tuple[str, Path]]:
    """Every name of the shared namespace with the place that makes it, in the order of the language's reference."""
    environment = spec.environment
    return [
        *((name, ("constants", name)) for name in spec.constants),
        *((name, ("environment", "world", name)) for name in environment.world),
        *((name, ("environment", "state", name)) for name in environment.state),
        *((name, definition.path) for name, definition in defined.items()),
        *((name, ("environment", "sensors", name)) for name in environment.sensors),
    ]


def twice(named: Iterable[tuple[str, Path]], findings: Findings) -> set[str]:
    """Names that stand for two things; the second place is told of."""
    first: dict[str, Path] = {}
    found = set()
    for name, path in named:
        if name in first:
            message = f"{name} is already the name of something in {'.'.join(str(part) for part in first[name][:-1])}"
            advice = "constants, world, state, definitions and sensors share their names"
            findings.mistakes[path, Mistake("BB025", message, Span(0, 0), advice)] = None
            found.add(name)
        first.setdefault(name, path)
    return found


def cyclic(spec: Spec, defined: Mapping[str, Definition], findings: Findings) -> dict[str, Unusable]:
    """Names whose values would need themselves, each circle told of once."""
    environment = spec.environment
    constants = {name: expressions_in(value) for name, value in spec.constants.items()}
    starts = {name: [start] for name, start in (*environment.world.items(), *environment.state.items())}
    derived = {name: [Expression("", definition.expression)] for name, definition in defined.items()}
    derived |= {name: _conditions(written) for name, written in environment.sensors.items()}
    found: dict[str, Unusable] = {}
    places = dict(blocks(spec, defined))
    for group in (constants, starts | derived):
        for circle in circles(dependencies(group)):
            message = f"a circle: {' needs '.join(circle)}"
            mistake = Mistake("BB063", message, Span(0, 0), "keep one of the values as state, from step to step")
            findings.mistakes[places[circle[0]], mistake] = None
            found |= dict.fromkeys(circle, Unusable())
    return found


def _conditions(written: Expression | Mapping[str, Expression]) -> list[Expression]:
    if isinstance(written, Expression):
        return [written]
    return [condition for condition in written.values() if condition.text != OTHERWISE]
