"""Which names of a spec come to matter: what the reward, behaviors, ends, the view or the design use."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.expression.syntax.tree import names_used
from bbsd.language.base import Part
from bbsd.language.field_types import Expression, signature

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from bbsd.expression.scope import Path
    from bbsd.language.models import Spec

OWNED_BLOCKS = ("world", "state", "definitions", "dynamics", "sensors")
"""The blocks of an environment whose expressions matter only where the name that they give a value matters."""


@dataclass(frozen=True, slots=True)
class Uses:
    """Names by where they are made, what each one's value uses, and the names that come to matter."""

    made: Mapping[str, Path]
    needs: Mapping[str, frozenset[str]]
    live: frozenset[str]

    def users(self, name: str) -> list[str]:
        """Return the other names whose values use a name, in the order of the spec."""
        return [user for user in self.made if user != name and name in self.needs.get(user, ())]


def uses_of(spec: Spec) -> Uses:
    """Return which names of a spec come to matter."""
    owned: defaultdict[str, set[str]] = defaultdict(set)
    for owner, names in _owned(spec):
        owned[owner] |= names
    needs = {owner: frozenset(names) for owner, names in owned.items()}
    return Uses(_made(spec), needs, _reached(_roots(spec), needs))


def _made(spec: Spec) -> dict[str, Path]:
    environment = spec.environment
    made: dict[str, Path] = {name: ("constants", name) for name in spec.constants}
    for block in ("world", "state"):
        made |= {name: ("environment", block, name) for name in getattr(environment, block)}
    made |= {signature(key)[0]: ("environment", "definitions", key) for key in environment.definitions}
    return made | {name: ("environment", "sensors", name) for name in environment.sensors}


def _owned(spec: Spec) -> Iterator[tuple[str, frozenset[str]]]:
    """Yield the names that the value of a name uses: once for each expression that sets it."""
    environment = spec.environment
    for name, value in spec.constants.items():
        yield name, _names_in(value)
    for block in OWNED_BLOCKS:
        for key, value in getattr(environment, block).items():
            name, *parameters = signature(key)
            yield name, _names_in(value, frozenset(parameters))
    for behavior in spec.behaviors.values():
        for sets in behavior.actions.values():
            yield from ((target, _names_in(value)) for target, value in sets.items())


def _roots(spec: Spec) -> frozenset[str]:
    """Return the names that matter by themselves: wherever expressions stand that give no name its value."""
    environment = spec.environment
    found = _names_in({key: value for key, value in spec.values_by_key().items() if key not in NOT_ROOTS})
    found |= _names_in(
        [value for key, value in environment.values_by_key().items() if key not in OWNED_BLOCKS]
    )
    for behavior in spec.behaviors.values():
        found |= _names_in([value for key, value in behavior.values_by_key().items() if key != "actions"])
        found |= frozenset(behavior.inputs)
    return found if environment.outside is None else found | frozenset(environment.outside.actions)


NOT_ROOTS = ("constants", "environment", "behaviors")


def _reached(roots: frozenset[str], needs: Mapping[str, frozenset[str]]) -> frozenset[str]:
    reached, waiting = set[str](), [*roots]
    while waiting:
        name = waiting.pop()
        if name not in reached:
            reached.add(name)
            waiting.extend(needs.get(name, ()))
    return frozenset(reached)


def _names_in(value: object, hidden: frozenset[str] = frozenset()) -> frozenset[str]:
    return frozenset().union(*(names_used(each.tree, hidden) for each in expressions_below(value)))


def expressions_below(value: object) -> Iterator[Expression]:
    """Yield all expressions in a part of a spec, in order."""
    match value:
        case Expression():
            yield value
        case Part():
            yield from _all_below(value.values_by_key().values())
        case dict():
            yield from _all_below(value.values())
        case list() | tuple():
            yield from _all_below(value)


def _all_below(values: Iterable[object]) -> Iterator[Expression]:
    for value in values:
        yield from expressions_below(value)
