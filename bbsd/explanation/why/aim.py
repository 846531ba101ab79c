"""What somebody asks about: an action by its name, all actions of a behavior, or that nobody controls."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.errors import UsageError, did_you_mean

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.language.meaning.behaviors import Module

NOBODY = "nobody"


class NoSuchAction(UsageError):
    """A name that is neither an action nor a behavior."""

    advice = "name an action, a behavior (any of its actions), behavior.action, or nobody"


@dataclass(frozen=True, slots=True)
class Act:
    """What can control a robot: an action of a behavior, or nobody."""

    behavior: int
    """-1 is nobody."""
    wish: int
    """The number of the action in the behavior's table, from 1; 0 of nobody."""


def acts_of(modules: Sequence[Module]) -> list[Act]:
    """Return nobody's, then every behavior's actions in the spec's order: an act's place is its number."""
    numbered = [
        Act(index, wish) for index, each in enumerate(modules) for wish in range(1, len(each.actions) + 1)
    ]
    return [Act(-1, 0), *numbered]


def act_name(act: Act, modules: Sequence[Module]) -> str:
    """Return an act as `behavior.action`, or `nobody`."""
    if act.behavior < 0:
        return NOBODY
    module = modules[act.behavior]
    return f"{module.name}.{[*module.actions][act.wish - 1]}"


def acts_named(name: str, modules: Sequence[Module]) -> frozenset[Act]:
    """Return the acts that a name stands for: `nobody`, `behavior.action`, a behavior, or an action of any behavior.

    Raises:
        NoSuchAction: the name stands for none.
    """
    acts = acts_of(modules)
    behaviors = [module.name for module in modules]
    by_name = {act_name(act, modules): act for act in acts}
    if name in by_name:
        return frozenset({by_name[name]})
    if name in behaviors:
        found = [act for act in acts if act.behavior == behaviors.index(name)]
    else:
        found = [act for full, act in by_name.items() if full.partition(".")[2] == name]
    if not found:
        actions = [action for module in modules for action in module.actions]
        known = did_you_mean(name, [*behaviors, *actions, NOBODY])
        raise NoSuchAction(f"there is no action or behavior {name}{known}")
    return frozenset(found)
