"""The joint input space: all that an agent's behaviors can tell apart, and what controls in each of its cells.

Behaviors that see through the same partition share a dimension. Every combination is counted, also one that cannot
occur because two partitions say something about the same thing, so "in no cell" is certain and "in some" is not.
"""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import blake2b
from math import prod
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.expression.graph import value_of

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    from bbsd.architecture.architecture import Architecture
    from bbsd.expression.graph import Node
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.meaning.tables.labels import Labels

MAX_JOINT_CELLS = 200_000
MOST_AT_ONCE = 2_000_000
"""Joint cells of all architectures whose policies are held at once."""

EXCITEMENT = ("not excited", "excited")

Key = tuple[tuple["Node", ...], int]
"""What makes a dimension: the value of every robot that tells its cell, and the number of cells."""


class Dimension(NamedTuple):
    """What a dimension is called, its cells, and the behavior that was the first to need it."""

    name: str
    cells: Labels
    owner: str


@dataclass(frozen=True, slots=True)
class Projection:
    """What one behavior sees of the joint space.

    `axes` are the dimensions of its inputs, `sizes` their numbers of cells. It is excited where the dimension
    `excitement` has the index `excited_at`; always where there is none, or never where `excited_at` is 0.
    """

    axes: tuple[int, ...]
    sizes: tuple[int, ...]
    excitement: int | None
    excited_at: int


@dataclass(frozen=True, slots=True)
class JointSpace:
    """The dimensions with their cells, and each behavior's view of them, in the spec's order.

    Actions are numbered over all behaviors from 1 on, 0 is nobody's; behavior b's begin after `first_actions[b]`.
    `effects` (n_actions + 1,) gives each action the lowest one that sets the same.
    """

    dimensions: Mapping[str, Labels]
    projections: tuple[Projection, ...]
    first_actions: tuple[int, ...]
    effects: NDArray[np.uint16]

    @property
    def sizes(self) -> tuple[int, ...]:
        """The number of cells of each dimension."""
        return tuple(len(cells) for cells in self.dimensions.values())

    @property
    def joint_size(self) -> int:
        """The number of joint cells."""
        return prod(self.sizes)

    @property
    def is_small(self) -> bool:
        """Whether the joint cells are few enough to go through them all."""
        return self.joint_size <= MAX_JOINT_CELLS


def joint_space(meaning: Meaning) -> JointSpace:
    """The joint input space of a spec's behaviors."""
    modules = meaning.episode.modules
    seen: dict[Key, Dimension] = {}
    for module in modules:
        for place, (name, cells) in enumerate(module.inputs.items()):
            seen.setdefault(_input(module, place), Dimension(name, cells, module.name))
    for module in modules:
        key, _ = _excitement(module, seen)
        if key is not None:
            seen.setdefault(key, Dimension(module.name, EXCITEMENT, module.name))
    projections = tuple(_view(module, [*seen]) for module in modules)
    return JointSpace(_named(seen.values()), projections, _first_actions(modules), _effects(modules))


def _named(dimensions: Iterable[Dimension]) -> dict[str, Labels]:
    """The cells of each dimension by its name, with the behavior's name where others are called the same."""
    named: dict[str, Labels] = {}
    for name, cells, owner in dimensions:
        named[name if name not in named else f"{name} of {owner}"] = cells
    return named


def _view(module: Module, keys: Sequence[Key]) -> Projection:
    axes = tuple(keys.index(_input(module, place)) for place in range(len(module.inputs)))
    sizes = tuple(len(cells) for cells in module.inputs.values())
    key, index = _excitement(module, keys)
    return Projection(axes, sizes, None if key is None else keys.index(key), index)


def _input(module: Module, place: int) -> Key:
    """What tells the cell of an input, for every robot; of a truth it is the truth itself."""
    nodes = tuple(cells[place] for cells in module.cells)
    size = len(module.inputs[[*module.inputs][place]])
    is_truth = all(node.operation == "cell_of" for node in nodes)
    return (tuple(node.operands[0] for node in nodes) if is_truth else nodes), size


def _excitement(module: Module, known: Collection[Key]) -> tuple[Key | None, int]:
    """The condition that excites a behavior and the index at which it holds; no condition where it never changes.

    The index is 0 where the condition's opposite is known already.
    """
    nodes = module.excited
    if nodes[0].literal and len(set(nodes)) == 1:
        return None, int(value_of(nodes[0]))
    opposite = tuple(node.operands[0] for node in nodes if node.operation == "not")
    if (nodes, 2) not in known and (opposite, 2) in known:
        return (opposite, 2), 0
    return (nodes, 2), 1


def _first_actions(modules: Sequence[Module]) -> tuple[int, ...]:
    counts = [len(module.actions) for module in modules]
    return tuple(sum(counts[:index]) for index in range(len(counts)))


def _effects(modules: Sequence[Module]) -> NDArray[np.uint16]:
    """For each action the lowest that sets the same; an action that sets nothing is as good as nobody's."""
    effects = [
        frozenset[object](),
        *(frozenset(sets.items()) for module in modules for sets in module.actions.values()),
    ]
    return np.array([effects.index(effect) for effect in effects], np.uint16)


def policy(space: JointSpace, architecture: Architecture) -> NDArray[np.uint16]:
    """The number of the controlling action in every joint cell, (n_joint,); 0 where nobody controls.

    The space should be small (`is_small`): the result has its size.
    """
    found: NDArray[np.uint16] = policies(space, [architecture])[0]
    return found


def policies(space: JointSpace, architectures: Sequence[Architecture]) -> NDArray[np.uint16]:
    """The policies of several architectures with equally many layers, (n_architectures, n_joint)."""
    control = np.zeros((len(architectures), *space.sizes), np.uint16)
    for layer in np.stack([each.structure for each in architectures]).T:
        # From the lowest layer up, so that the highest has its way.
        for behavior in np.unique(layer).tolist():
            which = np.flatnonzero(layer == behavior).tolist()
            tables = np.stack([architectures[index].tables[behavior] for index in which])
            decided = decisions(space, behavior, tables)
            numbers = (decided + np.uint16(space.first_actions[behavior])).astype(np.uint16)
            control[which] = np.where(decided > 0, numbers, control[which])
    return control.reshape(len(architectures), -1)


def controlling(space: JointSpace, architecture: Architecture) -> NDArray[np.int64]:
    """The controlling behavior in every joint cell of a small space, (n_joint,); -1 where nobody controls."""
    return np.searchsorted(space.first_actions, policy(space, architecture), side="left") - 1


def decisions(space: JointSpace, behavior: int, tables: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """A behavior's action in the joint space, 0 where it has none or is not excited.

    Tables (..., n_cells); what comes back broadcasts to (..., *sizes).
    """
    view, mesh = space.projections[behavior], np.ogrid[tuple(slice(size) for size in space.sizes)]
    is_excited = (
        mesh[view.excitement] == view.excited_at if view.excitement is not None else view.excited_at == 1
    )
    return np.where(is_excited, tables[..., own_cells(space, behavior)], np.uint8(0))


def own_cells(space: JointSpace, behavior: int) -> NDArray[np.int64]:
    """The cell of a behavior's own table for the joint space; it broadcasts to `sizes`."""
    view, mesh = space.projections[behavior], np.ogrid[tuple(slice(size) for size in space.sizes)]
    cells = np.zeros((1,) * len(space.sizes), np.int64)
    for axis, size in zip(view.axes, view.sizes, strict=True):
        cells = cells * size + mesh[axis]
    return cells


def behavior_keys(space: JointSpace, architectures: Sequence[Architecture]) -> list[bytes]:
    """A digest of each, the same for architectures that set the same values in every joint cell.

    In a space that is not small, where structure and the tables of its behaviors are the same.
    """
    if not space.is_small:
        return [
            _digest(each.structure, *(each.tables[behavior] for behavior in each.structure.tolist()))
            for each in architectures
        ]
    at_once = max(1, MOST_AT_ONCE // prod(space.sizes))
    return [
        _digest(effects)
        for first in range(0, len(architectures), at_once)
        for effects in space.effects[policies(space, architectures[first : first + at_once])]
    ]


def _digest(*arrays: NDArray[np.generic]) -> bytes:
    digest = blake2b(digest_size=32)
    for array in arrays:
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.digest()
