"""What actions set without changing anything, and actions that do the same."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import needed
from bbsd.expression.node_data import Slot
from bbsd.expression.syntax.mistakes import KEY, WHOLE, Mistake
from bbsd.language.meaning.setting.targets import Target, read_target

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Variable
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.validation import LocatedMistake


def useless_actions(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield warnings for actions that change nothing, and for actions that do what another one does."""
    modules = meaning.episode.modules
    for module in modules:
        written = meaning.spec.behaviors[module.name].actions
        yield from _idle(module, written) if len(modules) > 1 else _like_no_action(module)
        yield from _alike(module)
    yield from _overruled(meaning)


def _idle(module: Module, written: Mapping[str, Mapping[str, object]]) -> Iterator[LocatedMistake]:
    """Yield state that is only set to itself; beside actions that change it, that is how one says that it stays."""
    changed = {name for sets in module.actions.values() for (name, _), _ in _changes(sets)}
    for action, keys in written.items():
        for key in keys:
            target = read_target(key)
            if isinstance(target, Target) and target.name not in changed:
                message = f"this sets {target.name} to the value that it has, which changes nothing"
                rest = f"; an action that sets nothing is written {action}: {{}}" if len(keys) == 1 else ""
                path = ("behaviors", module.name, "actions", action, key)
                yield path, Mistake("BB203", message, KEY, f"leave it out{rest}")


def _like_no_action(module: Module) -> Iterator[LocatedMistake]:
    """Yield the actions of a behavior, the only one, that change nothing: there is no layer below for them to stop."""
    for action, sets in module.actions.items():
        if not _changes(sets):
            message = f"the action {action} changes nothing, as no action does"
            yield (
                ("behaviors", module.name, "actions", action),
                Mistake("BB203", message, KEY, "leave it out"),
            )


def _alike(module: Module) -> Iterator[LocatedMistake]:
    first: dict[frozenset[tuple[Variable, tuple[Node, ...]]], str] = {}
    for action, sets in module.actions.items():
        effect = _changes(sets)
        if effect in first:
            message = f"the action {action} does the same as {first[effect]}"
            advice = "leave one of them out, or let them differ"
            yield ("behaviors", module.name, "actions", action), Mistake("BB204", message, KEY, advice)
        first.setdefault(effect, action)


def _changes(sets: Mapping[Variable, tuple[Node, ...]]) -> frozenset[tuple[Variable, tuple[Node, ...]]]:
    """Return what an action sets, without what it sets to the value that it has, for every robot."""
    return frozenset(
        (variable, values) for variable, values in sets.items() if not _is_kept(variable, values)
    )


def _is_kept(variable: Variable, values: tuple[Node, ...]) -> bool:
    name, place = variable
    return all(
        node.operation == "slot" and node.slot == Slot(name, robot, place)
        for robot, node in enumerate(values)
    )


def _overruled(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield state that actions set, and whose dynamics and all else leave that out of account."""
    episode, dynamics = meaning.episode, meaning.spec.environment.dynamics
    set_by_actions = {
        name for module in episode.modules for sets in module.actions.values() for name, _ in sets
    }
    if not set_by_actions & dynamics.keys():
        return
    sent = [episode.acted[slot] for slot in episode.sent]
    heeded = {node.number for node in needed([*episode.after.values(), *sent])}
    used = {slot.name for slot, node in episode.acted.items() if node.number in heeded}
    for name in dynamics:
        if name in set_by_actions - used:
            message = f"what actions set {name} to has no effect: its dynamics do not use {name}"
            advice = f"use {name} in its dynamics, which are computed from what actions set, or leave the dynamics out"
            yield ("environment", "dynamics", name), Mistake("BB203", message, WHOLE, advice)
