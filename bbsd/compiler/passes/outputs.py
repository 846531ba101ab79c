"""What the outputs of a step need: the nodes that a rollout computes, and the slots that they read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import Level, needed
from bbsd.expression.node_data import Elements, Slot

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.expression.graph import Node
    from bbsd.language.meaning.episode.episode import Episode


def credit_outputs(episode: Episode) -> list[Node]:
    """Return the nodes of a step that returns and credit depend on."""
    decided = [node for module in episode.modules for node in module.nodes]
    earned = [node for nodes in episode.reward.values() for node in nodes]
    sent = [episode.acted[slot] for slot in episode.sent]
    return [*decided, *sent, *earned, *([] if episode.ends is None else [episode.ends])]


def with_slots_read(outputs: Iterable[Node], episode: Episode) -> list[Node]:
    """Return nodes of a step, and the next values of all slots that they read, of the slots these read, and so on."""
    outputs, slots = list(outputs), set[Slot]()
    while True:
        nodes = [*outputs, *(node for slot, node in episode.after.items() if slot in slots)]
        read = slots_read(nodes).keys()
        if read == slots:
            return nodes
        slots = set(read)


def slots_read(outputs: Iterable[Node]) -> dict[Slot, Level]:
    """Return the slots that nodes and what they depend on read, with the level of each."""
    read: dict[Slot, Level] = {}
    for node in needed(outputs):
        match node.data:
            case Slot() if node.operation == "slot":
                read[node.data] = node.level
            case Elements(slot, own):
                read[slot] = Level.EACH if own else Level.LANE
    return read
