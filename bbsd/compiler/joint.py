"""The joint partition: a cell of all behaviors' inputs together, and of who is excited."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.graph import Node
    from bbsd.language.meaning.behaviors import Module

HASH_BITS = 16
MOST_JOINT_CELLS = 1 << HASH_BITS
"""Joint cells that are told apart; of a finer partition several share a number, found by hashing."""


class JointDigit(NamedTuple):
    """One of the values that make up a joint cell: an input of a behavior, or whether it is excited."""

    behavior: int
    place: int | None
    """Which of its inputs; None: whether it is excited."""
    size: int
    """How many cells the value has."""

    def node(self, modules: Sequence[Module], robot: int) -> Node:
        """Return the node of the value for one robot."""
        module = modules[self.behavior]
        return module.excited[robot] if self.place is None else module.cells[robot][self.place]


@dataclass(frozen=True, slots=True)
class JointPartition:
    """What makes up a joint cell; values that several behaviors share count once."""

    digits: tuple[JointDigit, ...]

    @property
    def is_exact(self) -> bool:
        """Whether every joint cell has a number of its own."""
        return prod(digit.size for digit in self.digits) <= MOST_JOINT_CELLS

    @property
    def n_cells(self) -> int:
        """How many numbers joint cells have."""
        return min(prod(digit.size for digit in self.digits), MOST_JOINT_CELLS)


def joint_partition(modules: Sequence[Module]) -> JointPartition:
    """Return the joint partition of behaviors, as they stand before any pass."""
    digits: dict[tuple[int, ...], JointDigit] = {}
    for behavior, module in enumerate(modules):
        sizes = [*(len(labels) for labels in module.inputs.values()), 2]
        for place, size in enumerate(sizes):
            digit = JointDigit(behavior, place if place < len(module.inputs) else None, size)
            nodes = [digit.node(modules, robot) for robot in range(len(module.cells))]
            if not nodes[0].literal or len(set(nodes)) > 1:
                digits.setdefault(tuple(node.number for node in nodes), digit)
    return JointPartition(tuple(digits.values()))
