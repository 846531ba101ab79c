"""Definitions, and which names of a spec exclude each other or need each other in a circle."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.scope import Definition, Findings, Path, Unusable
from bbsd.expression.syntax.mistakes import KEY, Mistake
from bbsd.expression.syntax.tree import functions_called, names_used, stack_depth
from bbsd.language.field_types import Expression, expressions_in, signature
from bbsd.language.meaning.naming.order import chain_weights, find_circles, uses_among
from bbsd.language.models import OTHERWISE, Spec
from bbsd.language.outside import EARNED, OUTSIDE_KINDS

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

    from bbsd.expression.syntax.tree import Expr
    from bbsd.language.models import Environment

FRAMES_OF_A_NAME = 8
"""Frames of Python's stack from a name to the expression behind it."""
MAX_FRAMES = 600
"""Frames for a chain of names, of the 1000 that Python has."""


def read_definitions(expressions: Mapping[str, Expression], findings: Findings) -> dict[str, Definition]:
    """Return each definition by its name; report a duplicate and keep the first."""
    definitions: dict[str, Definition] = {}
    for key, expression in expressions.items():
        path: Path = ("environment", "definitions", key)
        name, *parameters = signature(key)
        if name in definitions:
            _report_duplicate(name, path, definitions[name].path, findings)
        definitions.setdefault(name, Definition(tuple(parameters), expression.tree, path))
    return definitions


def shared_namespace(spec: Spec, definitions: Mapping[str, Definition]) -> list[tuple[str, Path]]:
    """Return every name of the shared namespace with the path that makes it."""
    environment = spec.environment
    return [
        *_namespace_outside(environment),
        *((name, ("constants", name)) for name in spec.constants),
        *((name, ("environment", "world", name)) for name in environment.world),
        *((name, ("environment", "state", name)) for name in environment.state),
        *((name, definition.path) for name, definition in definitions.items()),
        *((name, ("environment", "sensors", name)) for name in environment.sensors),
    ]


def _namespace_outside(environment: Environment) -> Iterator[tuple[str, Path]]:
    """Yield the names that an environment in Python sets, with the path of each."""
    if environment.outside:
        yield EARNED, ("environment", environment.outside.kind)
        is_list = isinstance(environment.observation, list)
        for index, field in enumerate(environment.outside.fields):
            if field.is_used:
                yield field.name, ("environment", "observation", index if is_list else field.name)


def report_duplicates(namespace: Iterable[tuple[str, Path]], findings: Findings) -> dict[str, Unusable]:
    """Return the names that stand for two things, and report the second path of each."""
    first: dict[str, Path] = {}
    duplicates: dict[str, Unusable] = {}
    for name, path in namespace:
        if name in first:
            _report_duplicate(name, path, first[name], findings)
            duplicates[name] = Unusable()
        first.setdefault(name, path)
    return duplicates


def _report_duplicate(name: str, path: Path, first: Path, findings: Findings) -> None:
    place = (
        "of what the environment rewards"
        if first[-1] in OUTSIDE_KINDS
        else f"of something in {'.'.join(map(str, first[:-1]))}"
    )
    message = f"{name} is already the name {place}"
    advice = f"a name stands for one thing only; give this one another, such as {name}_2"
    seen_at = () if first[-1] in OUTSIDE_KINDS else (first,)
    findings.add(path, Mistake("BB025", message, KEY, advice, seen_at=seen_at))


def report_unordered(
    spec: Spec,
    definitions: Mapping[str, Definition],
    findings: Findings,
    unusable: Collection[str] = (),
) -> dict[str, Unusable]:
    """Return and report the names whose values need themselves, or too long a chain of other values.

    Nothing is reported of `unusable` names, such as those of two things.
    """
    environment = spec.environment
    functions = frozenset(name for name, definition in definitions.items() if definition.parameters)
    derived = {
        name: Needs.of([definition.expression], functions, definition.parameters)
        for name, definition in definitions.items()
    }
    constants = {name: Needs.of(_trees(expressions_in(value))) for name, value in spec.constants.items()}
    starts = {
        name: Needs.of([start.tree], functions)
        for name, start in (*environment.world.items(), *environment.state.items())
    }
    sensors = {
        name: Needs.of(_trees(_conditions(sensor)), functions) for name, sensor in environment.sensors.items()
    }
    paths = dict(reversed(shared_namespace(spec, definitions)))
    unordered = _report_circles(constants, paths, findings)
    # At the start there are no sensors yet, and later world and state are stored.
    for each in (starts | derived, derived | sensors):
        group = {name: needs for name, needs in each.items() if name not in unusable}
        unordered |= _report_circles(group, paths, findings)
        ordered = {name: needs for name, needs in group.items() if name not in unordered}
        unordered |= _report_long_chains(ordered, paths, findings)
    return unordered


class Needs(NamedTuple):
    """What evaluating a value needs: other names, and frames of Python's stack."""

    names: frozenset[str]
    frames: int

    @classmethod
    def of(
        cls, trees: Sequence[Expr], functions: frozenset[str] = frozenset(), parameters: Sequence[str] = ()
    ) -> Needs:
        """Return what expressions need, in which the parameters are given, and functions are the spec's own."""
        used = frozenset[str]().union(*(names_used(tree, frozenset(parameters)) for tree in trees))
        used |= functions & frozenset[str]().union(*map(functions_called, trees))
        return cls(used, FRAMES_OF_A_NAME + max(map(stack_depth, trees), default=0))


def _trees(expressions: Iterable[Expression]) -> list[Expr]:
    return [expression.tree for expression in expressions]


def _conditions(sensor: Expression | Mapping[str, Expression]) -> list[Expression]:
    if isinstance(sensor, Expression):
        return [sensor]
    return [condition for condition in sensor.values() if condition.text != OTHERWISE]


def _report_circles(
    group: Mapping[str, Needs], paths: Mapping[str, Path], findings: Findings
) -> dict[str, Unusable]:
    circles, involved = find_circles(uses_among({name: needs.names for name, needs in group.items()}))
    for circle in circles:
        message = f"a circle: {' needs '.join(circle)}"
        advice = "keep one of the values as state, from step to step"
        findings.report(paths[circle[0]], "BB063", message, KEY, advice)
    return dict.fromkeys(involved, Unusable())


def _report_long_chains(
    group: Mapping[str, Needs], paths: Mapping[str, Path], findings: Findings
) -> dict[str, Unusable]:
    """Return the names at the end of too long a chain, and report where each such chain first is too long."""
    uses = uses_among({name: needs.names for name, needs in group.items()})
    weights = {name: needs.frames for name, needs in group.items()}
    too_long = {
        name: Unusable() for name, weight in chain_weights(uses, weights).items() if weight > MAX_FRAMES
    }
    for name in too_long:
        if too_long.keys().isdisjoint(
            uses[name]
        ):  # `uses[name].isdisjoint` would go through all of `too_long`
            message = f"{name} needs too long a chain of values, each computed from the next"
            findings.report(paths[name], "BB060", message, KEY, "keep one of them as state")
    return too_long
