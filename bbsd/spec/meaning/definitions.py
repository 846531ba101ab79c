"""Definitions: names and parameters from their keys, and who shares a namespace with whom."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.mistakes import KEY
from bbsd.expression.scope import Definition, Findings, Path, Unusable
from bbsd.expression.tree import frames, names_used
from bbsd.spec.meaning.constants import expressions_in
from bbsd.spec.meaning.order import among_themselves, circles, heights, names_in
from bbsd.spec.models import OTHERWISE, Spec
from bbsd.spec.written import Expression, signature

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping

LINK = 8
"""Frames that Python needs to get from a name to the expression behind it."""
MAX_HEIGHT = 600
"""Frames for a chain of names; Python has 1000."""


def definitions(written: Mapping[str, Expression], findings: Findings) -> dict[str, Definition]:
    """Each definition by its name; of two by one name the second is told of and passed over."""
    found: dict[str, Definition] = {}
    for key, expression in written.items():
        path: Path = ("environment", "definitions", key)
        name, *parameters = signature(key)
        if name in found:
            _tell_twice(name, path, found[name].path, findings)
        found.setdefault(name, Definition(tuple(parameters), expression.tree, path))
    return found


def blocks(spec: Spec, defined: Mapping[str, Definition]) -> list[tuple[str, Path]]:
    """Every name of the shared namespace and the place that makes it."""
    environment = spec.environment
    return [
        *((name, ("constants", name)) for name in spec.constants),
        *((name, ("environment", "world", name)) for name in environment.world),
        *((name, ("environment", "state", name)) for name in environment.state),
        *((name, definition.path) for name, definition in defined.items()),
        *((name, ("environment", "sensors", name)) for name in environment.sensors),
    ]


def twice(named: Iterable[tuple[str, Path]], findings: Findings) -> dict[str, Unusable]:
    """Names that stand for two things; the second place is told of."""
    first: dict[str, Path] = {}
    found: dict[str, Unusable] = {}
    for name, path in named:
        if name in first:
            _tell_twice(name, path, first[name], findings)
            found[name] = Unusable()
        first.setdefault(name, path)
    return found


def _tell_twice(name: str, path: Path, first: Path, findings: Findings) -> None:
    message = f"{name} is already the name of something in {'.'.join(str(part) for part in first[:-1])}"
    advice = "constants, world, state, definitions and sensors share their names"
    findings.tell(path, "BB025", message, KEY, advice)


def unordered(spec: Spec, defined: Mapping[str, Definition], findings: Findings) -> dict[str, Unusable]:
    """Names whose values would need themselves, or too long a chain of other values; which is told."""
    places = dict(reversed(blocks(spec, defined)))
    found: dict[str, Unusable] = {}
    constants = {name: names_in(expressions_in(value)) for name, value in spec.constants.items()}
    for group in (constants, _episodes_uses(spec, defined)):
        uses = among_themselves(group)
        told, involved = circles(uses)
        for circle in told:
            message = f"a circle: {' needs '.join(circle)}"
            advice = "keep one of the values as state, from step to step"
            findings.tell(places[circle[0]], "BB063", message, KEY, advice)
        found |= dict.fromkeys(involved, Unusable())
    return found | _too_high(spec, defined, found.keys(), findings)


def _episodes_uses(spec: Spec, defined: Mapping[str, Definition]) -> dict[str, frozenset[str]]:
    uses = {name: names_in(written) for name, written in _written(spec).items()}
    for name, definition in defined.items():
        uses[name] = names_used(definition.expression, frozenset(definition.parameters))
    return uses


def _written(spec: Spec) -> dict[str, list[Expression]]:
    environment = spec.environment
    starts = {name: [start] for name, start in (*environment.world.items(), *environment.state.items())}
    return starts | {name: _conditions(written) for name, written in environment.sensors.items()}


def _conditions(written: Expression | Mapping[str, Expression]) -> list[Expression]:
    if isinstance(written, Expression):
        return [written]
    return [condition for condition in written.values() if condition.text != OTHERWISE]


def _too_high(
    spec: Spec, defined: Mapping[str, Definition], unordered: Collection[str], findings: Findings
) -> dict[str, Unusable]:
    """Names that build on a longer chain of others than can be followed."""
    trees = {name: [each.tree for each in written] for name, written in _written(spec).items()}
    trees |= {name: [definition.expression] for name, definition in defined.items()}
    weights = {name: LINK + max(map(frames, of), default=0) for name, of in trees.items()}
    ordered = {name: used for name, used in _episodes_uses(spec, defined).items() if name not in unordered}
    uses = among_themselves(ordered)
    found = {name: Unusable() for name, height in heights(uses, weights).items() if height > MAX_HEIGHT}
    places = dict(blocks(spec, defined))
    for name in found:
        if uses[name].isdisjoint(found):
            message = f"{name} needs too long a chain of values, each computed from the next"
            findings.tell(places[name], "BB060", message, KEY, "keep one of them as state")
    return found
