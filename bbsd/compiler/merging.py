"""Slots that always hold the same value are stored once: three robots that sense one tilt sense it once.

The largest groups of slots that start with the same value and, if that was so far true of all groups, keep
the same value in every step. Found by splitting groups until nothing splits.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, cast

from bbsd.expression.graph import LEAVES, Graph, Node, needed

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from bbsd.spec.meaning import Meaning
    from bbsd.spec.meaning.behaviors import Module
    from bbsd.spec.meaning.episode import Episode
    from bbsd.spec.meaning.names import Slot

Renamed = dict[int, Node]
"""Nodes by the number of the node they stand for."""


def merged(meaning: Meaning) -> Meaning:
    """The same meaning, every group of equal slots read from its first one."""
    episode, graph = meaning.episode, replace(meaning.graph, bounded=False)
    groups = _groups(episode, graph)
    if all(slot == first for slot, first in groups.items()):
        return meaning
    every = [*episode.after.values(), *episode.acted.values(), *episode.definitions.values()]
    every += [node for module in episode.modules for node in _nodes_of(module)]
    every += [node for nodes in episode.reward.values() for node in nodes]
    every += [episode.ends] if episode.ends is not None else []
    every += [node for nodes in episode.expects.values() for node in nodes]
    found = _read_from(groups, every, graph)
    changed = replace(
        episode,
        modules=tuple(_renamed(module, found) for module in episode.modules),
        acted={slot: found[node.number] for slot, node in episode.acted.items()},
        after={slot: found[node.number] for slot, node in episode.after.items()},
        definitions={slot: found[node.number] for slot, node in episode.definitions.items()},
        reward={term: tuple(found[node.number] for node in nodes) for term, nodes in episode.reward.items()},
        ends=None if episode.ends is None else found[episode.ends.number],
        expects={
            name: tuple(found[node.number] for node in nodes) for name, nodes in episode.expects.items()
        },
    )
    return replace(meaning, episode=changed)


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
            slot = groups.get(cast("Slot", node.data), node.data)
            found[node.number] = graph.leaf("slot", slot, node.kind, node.level)
        elif node.operation == "gather":
            base, strides, lengths = cast("tuple[int, tuple[int, ...], tuple[int, ...]]", node.data)
            found[node.number] = graph.gather(base, strides, lengths, operands)
        elif node.operation == "draw":
            distribution, word = cast("tuple[str, int]", node.data)
            found[node.number] = graph.draw(distribution, word, operands)
        elif node.literal or node.operation in LEAVES:
            found[node.number] = node
        else:
            found[node.number] = graph.apply(node.operation, *operands, data=node.data)
    return found


def _nodes_of(module: Module) -> list[Node]:
    cells = [node for robot in module.cells for node in robot]
    return [*cells, *module.excited]


def _renamed(module: Module, found: Renamed) -> Module:
    """The module with its cells and excitation read anew; what its actions set stands in the acted state already."""
    return replace(
        module,
        cells=tuple(tuple(found[node.number] for node in robot) for robot in module.cells),
        excited=tuple(found[node.number] for node in module.excited),
    )
