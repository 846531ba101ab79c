"""Which names of a spec come to matter: what the reward, behaviors, ends, the view or the design use."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from bbsd.expression.syntax.tree import Expr, functions_called, names_used
from bbsd.language.base import Part
from bbsd.language.field_types import Expression, signature
from bbsd.language.meaning.setting.targets import Target, read_target

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from bbsd.expression.scope import Path
    from bbsd.language.models import Spec

OWNED_BLOCKS = ("world", "state", "definitions", "dynamics", "sensors")
"""The blocks of an environment whose expressions matter only where the name that they give a value matters."""


@dataclass(frozen=True)
class Uses:
    """Names by where they are made, what each one's value uses, and the names that come to matter."""

    made: Mapping[str, Path]
    needs: Mapping[str, frozenset[str]]
    live: frozenset[str]

    @cached_property
    def users(self) -> Mapping[str, list[str]]:
        """For each name that is used, the other names whose values use it, in the order of the spec."""
        users: dict[str, list[str]] = {}
        for user in self.made:
            for name in self.needs.get(user, frozenset()) - {user}:
                users.setdefault(name, []).append(user)
        return users


def uses_of(spec: Spec) -> Uses:
    """Return which names of a spec come to matter."""
    functions = frozenset(name for name, *rest in map(signature, spec.environment.definitions) if rest)
    owned: defaultdict[str, set[str]] = defaultdict(set)
    for owner, value, hidden in _owned(spec):
        owned[owner] |= _names_in(value, functions, hidden)
    needs = {owner: frozenset(names) for owner, names in owned.items()}
    return Uses(_made(spec), needs, _reached(_roots(spec, functions), needs))


def _made(spec: Spec) -> dict[str, Path]:
    environment = spec.environment
    made: dict[str, Path] = {name: ("constants", name) for name in spec.constants}
    for block in ("world", "state"):
        made |= {name: ("environment", block, name) for name in getattr(environment, block)}
    made |= {signature(key)[0]: ("environment", "definitions", key) for key in environment.definitions}
    return made | {name: ("environment", "sensors", name) for name in environment.sensors}


def _owned(spec: Spec) -> Iterator[tuple[str, object, frozenset[str]]]:
    """Yield what gives a name its value, and the parameters in it."""
    environment = spec.environment
    for name, value in spec.constants.items():
        yield name, value, frozenset()
    for block in OWNED_BLOCKS:
        for key, value in getattr(environment, block).items():
            name, *parameters = signature(key)
            yield name, value, frozenset(parameters)
    for behavior in spec.behaviors.values():
        for sets in behavior.actions.values():
            for key, value in sets.items():
                target = read_target(key)
                if isinstance(target, Target):
                    yield target.name, (value, *target.indices), frozenset()


def _roots(spec: Spec, functions: frozenset[str]) -> frozenset[str]:
    """Return the names that matter by themselves: wherever expressions stand that give no name its value."""
    environment = spec.environment
    behaviors = spec.behaviors.values()
    roots: list[object] = [value for key, value in spec.values_by_key().items() if key not in NOT_ROOTS]
    roots += [value for key, value in environment.values_by_key().items() if key not in OWNED_BLOCKS]
    roots += [value for each in behaviors for key, value in each.values_by_key().items() if key != "actions"]
    found = _names_in(roots, functions).union(*(each.inputs for each in behaviors))
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


def _names_in(
    value: object, functions: frozenset[str], hidden: frozenset[str] = frozenset()
) -> frozenset[str]:
    """Return the names that the expressions in a part of a spec use, and which of its functions they call."""
    trees = [*trees_below(value)]
    names = frozenset[str]().union(*(names_used(tree, hidden) for tree in trees))
    return names | functions.intersection(frozenset[str]().union(*map(functions_called, trees)))


def trees_below(value: object) -> Iterator[Expr]:
    """Yield all expressions in a part of a spec, in order."""
    match value:
        case Expression():
            yield value.tree
        case Part():
            yield from _all_below(value.values_by_key().values())
        case dict():
            yield from _all_below(value.values())
        case list() | tuple():
            yield from _all_below(value)
        case _ if isinstance(value, Expr):
            yield value


def _all_below(values: Iterable[object]) -> Iterator[Expr]:
    for value in values:
        yield from trees_below(value)
