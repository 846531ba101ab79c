"""State and world that never change."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import LEAVES, needed
from bbsd.expression.kinds import Kind
from bbsd.expression.syntax.mistakes import KEY, Mistake
from bbsd.language.warnings.unused import WORDS

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning
    from bbsd.language.validation import LocatedMistake
    from bbsd.language.warnings.uses import Uses

FIXED = ("constant", "gather")
"""Leaves that have the same value in every episode."""


def unset_values(meaning: Meaning, uses: Uses) -> Iterator[LocatedMistake]:
    """Yield a warning for each value that matters, that nothing sets, and that is the same at each start.

    What is drawn at the start, or differs from robot to robot, is no constant; nor is what an environment in Python is
    told, which must be state.
    """
    environment = meaning.spec.environment
    modules = meaning.episode.modules
    targets = {name for module in modules for sets in module.actions.values() for name, _ in sets}
    targets |= {slot.name for slot in meaning.episode.sent}
    starts: dict[str, dict[Slot, Node]] = {}
    for slot, node in meaning.episode.start.items():
        starts.setdefault(slot.name, {})[slot] = node
    for block in ("world", "state"):
        for name in getattr(environment, block):
            if name in uses.live and name not in targets | environment.dynamics.keys():
                nodes = [*starts[name].values()]
                if _are_alike(starts[name]) and all(map(_is_fixed, nodes)):
                    yield ("environment", block, name), _mistake(WORDS[block], name, nodes[0])


def _mistake(word: str, name: str, start: Node) -> Mistake:
    message = f"the {word} {name} never changes: neither dynamics nor an action sets it"
    advice = "set it, or write it under constants" if start.kind is Kind.NUMBER else "set it, or leave it out"
    return Mistake("BB202", message, KEY, advice)


def _are_alike(starts: Mapping[Slot, Node]) -> bool:
    """Return whether all robots have the same value at the start."""
    rows: dict[tuple[int, ...], set[int]] = {}
    for slot, node in starts.items():
        rows.setdefault(slot.place, set()).add(node.number)
    return all(len(numbers) == 1 for numbers in rows.values())


def _is_fixed(node: Node) -> bool:
    return all(each.operation in FIXED for each in needed([node]) if each.operation in LEAVES)
