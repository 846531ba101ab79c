"""Stores slots once that always hold the same value: three robots that sense one tilt sense it once.

Slots that start with the same value form a group. Groups are split until the slots of each have the same next value,
given that those of all groups have the same present value.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, Node, needed

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.episode.episode import Episode

Replaced = dict[int, Node]
"""New nodes by the numbers of the old nodes that they replace."""


def share_slots(meaning: Meaning) -> Meaning:
    """Return the same meaning, with every group of equal slots read from its first one."""
    episode, graph = meaning.episode, replace(meaning.graph, bounded=False)
    groups = _groups(episode, graph)
    if all(slot == first for slot, first in groups.items()):
        return meaning
    new = _read_from(groups, episode.nodes, graph)
    return replace(meaning, episode=episode.with_nodes(lambda node: new[node.number]))


def _groups(episode: Episode, graph: Graph) -> dict[Slot, Slot]:
    """Return for every slot the first of the slots that always equal it."""
    keys: Mapping[Slot, tuple[object, ...]] = {
        slot: (node.number, node.kind) for slot, node in episode.start.items()
    }
    while True:
        groups = _first_of_each(keys)
        new = _read_from(groups, episode.after.values(), graph)
        keys = {slot: (groups[slot], new[node.number].number) for slot, node in episode.after.items()}
        if _first_of_each(keys) == groups:
            return groups


def _first_of_each(keys: Mapping[Slot, tuple[object, ...]]) -> dict[Slot, Slot]:
    first: dict[tuple[object, ...], Slot] = {}
    return {slot: first.setdefault(key, slot) for slot, key in keys.items()}


def _read_from(groups: Mapping[Slot, Slot], outputs: Iterable[Node], graph: Graph) -> Replaced:
    """Return new nodes for all that the outputs need, with every slot read from the first of its group."""
    new: Replaced = {}
    for node in needed(outputs):
        operands = tuple(new[operand.number] for operand in node.operands)
        if node.operation == "slot":
            slot = groups.get(node.slot, node.slot)
            new[node.number] = graph.leaf("slot", slot, node.kind, node.level)
        else:
            new[node.number] = graph.copy(node, operands) if operands else node
    return new
