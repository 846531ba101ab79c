"""All that a rollout computes, as one value."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.meaning.episode.picture import Picture
    from bbsd.language.meaning.tables.labels import Labels


@dataclass(frozen=True, slots=True)
class Episode:
    """All that a rollout computes, as nodes.

    `start` and `after` give every slot its first and its next value, `acted` state after the actions;
    `choices[robot]` is the leaf that stands for the controlling action's number (0: nobody's, else counted
    over all behaviors in order); `reward[term][robot]`; `definitions` as they are after the step;
    `expects[behavior][robot]` what should hold after a step in which it controls, where it expects anything.
    """

    modules: tuple[Module, ...]
    start: Mapping[Slot, Node]
    acted: Mapping[Slot, Node]
    after: Mapping[Slot, Node]
    definitions: Mapping[Slot, Node]
    choices: tuple[Node, ...]
    reward: Mapping[str, tuple[Node, ...]]
    ends: Node | None
    partitions: Mapping[str, Labels]
    """The cells of each sensor that is a partition."""
    expects: Mapping[str, tuple[Node, ...]]
    picture: Picture | None
    """What a view shows, in a graph of its own."""
    outside: tuple[Slot, ...] = ()
    """What an environment in Python gives at the start and at each step; none where the world is the spec's own."""
    sent: tuple[Slot, ...] = ()
    """What it is told at each step: the values that these slots have in `acted`."""
    fractions: frozenset[Slot] = frozenset()
    """What of `outside` need not be a whole number."""
    named: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """For world, state, sensors and definitions that are one of several names, these names; a value is their index."""

    def labels(self, name: str) -> Labels:
        """Return what the numbers 0, 1, ... of a value mean: cells, or names; nothing for other values."""
        return self.partitions.get(name) or self.named.get(name, ())

    @property
    def nodes(self) -> list[Node]:
        """The nodes of the start and of a step, without the values that actions assign, which `acted` contains."""
        nodes = [*self.start.values(), *self.acted.values(), *self.after.values(), *self.definitions.values()]
        nodes += [node for module in self.modules for node in module.nodes]
        for robots in (self.choices, *self.reward.values(), *self.expects.values()):
            nodes += robots
        return nodes if self.ends is None else [*nodes, self.ends]

    def with_nodes(self, new: Callable[[Node], Node]) -> Episode:
        """Return the same episode with every node of its step replaced, but for the values that actions assign."""
        return replace(
            self,
            modules=tuple(module.with_nodes(new) for module in self.modules),
            acted={slot: new(node) for slot, node in self.acted.items()},
            after={slot: new(node) for slot, node in self.after.items()},
            definitions={slot: new(node) for slot, node in self.definitions.items()},
            reward={term: tuple(map(new, nodes)) for term, nodes in self.reward.items()},
            ends=None if self.ends is None else new(self.ends),
            expects={name: tuple(map(new, nodes)) for name, nodes in self.expects.items()},
        )
