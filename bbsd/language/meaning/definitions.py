"""Definitions: names and parameters from their keys, and who shares a namespace with whom."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.mistakes import KEY
from bbsd.expression.scope import Definition, Findings, Path, Unusable
from bbsd.expression.tree import frames, names_used
from bbsd.language.field_types import Expression, expressions_in, signature
from bbsd.language.meaning.order import chain_weights, find_circles, uses_among
from bbsd.language.models import OTHERWISE, Spec

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from bbsd.expression.tree import Expr

LINK = 8
"""Frames that Python needs to get from a name to the expression behind it."""
MAX_HEIGHT = 600
"""Frames for a chain of names; Python has 1000."""


def read_definitions(written: Mapping[str, Expression], findings: Findings) -> dict[str, Definition]:
    """Each definition by its name; of two by one name the second is told of and passed over."""
    found: dict[str, Definition] = {}
    for key, expression in written.items():
        path: Path = ("environment", "definitions", key)
        name, *parameters = signature(key)
        if name in found:
            _tell_twice(name, path, found[name].path, findings)
        found.setdefault(name, Definition(tuple(parameters), expression.tree, path))
    return found


def shared_namespace(spec: Spec, defined: Mapping[str, Definition]) -> list[tuple[str, Path]]:
    """Every name of the shared namespace and the place that makes it."""
    environment = spec.environment
    return [
        *((name, ("constants", name)) for name in spec.constants),
        *((name, ("environment", "world", name)) for name in environment.world),
        *((name, ("environment", "state", name)) for name in environment.state),
        *((name, definition.path) for name, definition in defined.items()),
        *((name, ("environment", "sensors", name)) for name in environment.sensors),
    ]


def report_duplicates(named: Iterable[tuple[str, Path]], findings: Findings) -> dict[str, Unusable]:
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


def report_unordered(
    spec: Spec, defined: Mapping[str, Definition], findings: Findings
) -> dict[str, Unusable]:
    """Names whose values would need themselves, or too long a chain of other values; which is told."""
    environment = spec.environment
    derived = {
        name: Needs.of([definition.expression], definition.parameters) for name, definition in defined.items()
    }
    constants = {name: Needs.of(_trees(expressions_in(value))) for name, value in spec.constants.items()}
    starts = {
        name: Needs.of([each.tree]) for name, each in (*environment.world.items(), *environment.state.items())
    }
    sensors = {name: Needs.of(_trees(_conditions(each))) for name, each in environment.sensors.items()}
    places = dict(reversed(shared_namespace(spec, defined)))
    found = _circular(constants, places, findings)
    # At the start there are no sensors yet, and later world and state are stored.
    for group in (starts | derived, derived | sensors):
        found |= _circular(group, places, findings)
        found |= _too_high(
            {name: needs for name, needs in group.items() if name not in found}, places, findings
        )
    return found


class Needs(NamedTuple):
    """What a value is computed from: names, and frames of Python's stack."""

    names: frozenset[str]
    frames: int

    @classmethod
    def of(cls, trees: Sequence[Expr], parameters: Sequence[str] = ()) -> Needs:
        """What expressions need, of which those with these names are given."""
        used = frozenset[str]().union(*(names_used(tree, frozenset(parameters)) for tree in trees))
        return cls(used, LINK + max(map(frames, trees), default=0))


def _trees(written: Iterable[Expression]) -> list[Expr]:
    return [each.tree for each in written]


def _conditions(written: Expression | Mapping[str, Expression]) -> list[Expression]:
    if isinstance(written, Expression):
        return [written]
    return [condition for condition in written.values() if condition.text != OTHERWISE]


def _circular(
    group: Mapping[str, Needs], places: Mapping[str, Path], findings: Findings
) -> dict[str, Unusable]:
    told, involved = find_circles(uses_among({name: needs.names for name, needs in group.items()}))
    for circle in told:
        message = f"a circle: {' needs '.join(circle)}"
        advice = "keep one of the values as state, from step to step"
        findings.tell(places[circle[0]], "BB063", message, KEY, advice)
    return dict.fromkeys(involved, Unusable())


def _too_high(
    group: Mapping[str, Needs], places: Mapping[str, Path], findings: Findings
) -> dict[str, Unusable]:
    uses = uses_among({name: needs.names for name, needs in group.items()})
    weights = {name: needs.frames for name, needs in group.items()}
    found = {name: Unusable() for name, height in chain_weights(uses, weights).items() if height > MAX_HEIGHT}
    for name in found:
        if found.keys().isdisjoint(uses[name]):  # the other way round would go through all that was found
            message = f"{name} needs too long a chain of values, each computed from the next"
            findings.tell(places[name], "BB060", message, KEY, "keep one of them as state")
    return found
