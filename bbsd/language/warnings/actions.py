"""What actions set without changing anything, and actions that do the same."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import needed
from bbsd.expression.node_data import Slot
from bbsd.expression.syntax.mistakes import KEY, WHOLE, Mistake

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from bbsd.expression.graph import Node
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.validation import LocatedMistake


def useless_actions(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield warnings for actions that change nothing, and for actions that do what another one does."""
    modules = meaning.episode.modules
    for module in modules:
        yield from _idle(module) if len(modules) > 1 else _like_no_action(module)
        yield from _alike(module)
    yield from _overruled(meaning)


def _idle(module: Module) -> Iterator[LocatedMistake]:
    """Yield state that is only set to itself; beside actions that change it, that is how one says that it stays."""
    changed = {
        target
        for sets in module.actions.values()
        for target, values in sets.items()
        if not _is_kept(target, values)
    }
    for action, sets in module.actions.items():
        for target in sets.keys() - changed:
            path = ("behaviors", module.name, "actions", action, target)
            message = f"this sets {target} to the value that it has, which changes nothing"
            rest = f"; an action that sets nothing is written {action}: {{}}" if len(sets) == 1 else ""
            yield path, Mistake("BB203", message, KEY, f"leave it out{rest}")


def _like_no_action(module: Module) -> Iterator[LocatedMistake]:
    """Yield the actions of a behavior, the only one, that change nothing: there is no layer below for them to stop."""
    for action, sets in module.actions.items():
        if all(_is_kept(target, values) for target, values in sets.items()):
            message = f"the action {action} changes nothing, as no action does"
            yield (
                ("behaviors", module.name, "actions", action),
                Mistake("BB203", message, KEY, "leave it out"),
            )


def _alike(module: Module) -> Iterator[LocatedMistake]:
    first: dict[frozenset[tuple[str, tuple[Node, ...]]], str] = {}
    for action, sets in module.actions.items():
        effect = frozenset(
            (target, values) for target, values in sets.items() if not _is_kept(target, values)
        )
        if effect in first:
            message = f"the action {action} does the same as {first[effect]}"
            advice = "leave one of them out, or let them differ"
            yield ("behaviors", module.name, "actions", action), Mistake("BB204", message, KEY, advice)
        first.setdefault(effect, action)


def _is_kept(target: str, values: tuple[Node, ...]) -> bool:
    """Return whether a state is set to what it holds, for every robot."""
    return all(
        node.operation == "slot" and node.slot == Slot(target, robot) for robot, node in enumerate(values)
    )


def _overruled(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield state that actions set, and whose dynamics and all else leave that out of account."""
    episode = meaning.episode
    set_by = _set_by_actions(episode.modules)
    dynamics = meaning.spec.environment.dynamics
    if not set_by & dynamics.keys():
        return
    sent = [episode.acted[slot] for slot in episode.sent]
    heeded = {node.number for node in needed([*episode.after.values(), *sent])}
    for name in dynamics:
        slots = [slot for slot in episode.acted if slot.name == name] if name in set_by else []
        if slots and not any(episode.acted[slot].number in heeded for slot in slots):
            message = f"what actions set {name} to has no effect: its dynamics do not use {name}"
            advice = f"use {name} in its dynamics, which are computed from what actions set, or leave the dynamics out"
            yield ("environment", "dynamics", name), Mistake("BB203", message, WHOLE, advice)


def _set_by_actions(modules: tuple[Module, ...]) -> set[str]:
    all_sets: list[Mapping[str, object]] = [sets for module in modules for sets in module.actions.values()]
    return {target for sets in all_sets for target in sets}
