"""Slots that always hold the same value are stored once: three robots that sense one tilt sense it once.

The largest groups of slots that start with the same value and, if that was so far true of all groups, keep
the same value in every step. Found by splitting groups until nothing splits.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, Node, needed

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.episode import Episode

Renamed = dict[int, Node]
"""Nodes by the number of the node they stand for."""


def share_slots(meaning: Meaning) -> Meaning:
    """The same meaning, every group of equal slots read from its first one."""
    episode, graph = meaning.episode, replace(meaning.graph, bounded=False)
    groups = _groups(episode, graph)
    if all(slot == first for slot, first in groups.items()):
        return meaning
    found = _read_from(groups, episode.nodes, graph)
    return replace(meaning, episode=episode.with_nodes(lambda node: found[node.number]))


def _groups(episode: Episode, graph: Graph) -> dict[Slot, Slot]:
    """For every slot, the first of the slots that always equal it."""
    keys: Mapping[Slot, tuple[object, ...]] = {
        slot: (node.number, node.kind) for slot, node in episode.start.items()
    }
    while True:
        groups = _first_of_each(keys)
        found = _read_from(groups, episode.after.values(), graph)
        keys = {slot: (groups[slot], found[node.number].number) for slot, node in episode.after.items()}
        if _first_of_each(keys) == groups:
            return groups


def _first_of_each(keys: Mapping[Slot, tuple[object, ...]]) -> dict[Slot, Slot]:
    first: dict[tuple[object, ...], Slot] = {}
    return {slot: first.setdefault(key, slot) for slot, key in keys.items()}


def _read_from(groups: Mapping[Slot, Slot], outputs: Iterable[Node], graph: Graph) -> Renamed:
    """All nodes that the outputs need, made anew with every slot read from the first of its group."""
    found: Renamed = {}
    for node in needed(outputs):
        operands = tuple(found[operand.number] for operand in node.operands)
        if node.operation == "slot":
            slot = groups.get(node.slot, node.slot)
            found[node.number] = graph.leaf("slot", slot, node.kind, node.level)
        else:
            found[node.number] = graph.copy(node, operands) if operands else node
    return found
