"""The joint input space: all that an agent's behaviors can tell apart, and the controlling action in each cell.

Behaviors with the same partition as an input share a dimension. Every combination of cells counts, also one that
cannot occur because two partitions are of the same value: so "in no cell" is certain, and "in some cell" is not.
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
"""Cells of a joint space that is small enough to go through."""
MOST_AT_ONCE = 2_000_000
"""Joint cells of all architectures whose policies are in memory at once."""

EXCITEMENT = ("not excited", "excited")

Key = tuple[tuple["Node", ...], int]
"""The identity of a dimension: for every robot the node that gives its cell, and the number of cells."""


class Dimension(NamedTuple):
    """A dimension's name and cells, and the first behavior that has it as an input."""

    name: str
    cells: Labels
    owner: str


@dataclass(frozen=True, slots=True)
class Projection:
    """What one behavior perceives of the joint space, the projection in (1).

    `axes` are the dimensions of its inputs, `sizes` their numbers of cells. It is excited where the dimension
    `excitement` has the index `excited_at`; always where there is none, or never where `excited_at` is 0.
    """

    axes: tuple[int, ...]
    sizes: tuple[int, ...]
    excitement: int | None
    excited_at: int


@dataclass(frozen=True, slots=True)
class JointSpace:
    """The dimensions with their cells, and each behavior's projection, in the spec's order.

    `nodes[dimension][robot]` gives the index of the present cell, or a truth where the dimension is one.
    Actions are numbered over all behaviors from 1 on, 0 is nobody's; behavior b's begin after `first_actions[b]`.
    `effects` (n_actions + 1,) maps each action to the lowest one that sets the same values.
    """

    dimensions: Mapping[str, Labels]
    nodes: tuple[tuple[Node, ...], ...]
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
    """Return the joint input space of a spec's behaviors."""
    modules = meaning.episode.modules
    dimensions: dict[Key, Dimension] = {}
    for module in modules:
        for index, (name, cells) in enumerate(module.inputs.items()):
            dimensions.setdefault(_input_key(module, index), Dimension(name, cells, module.name))
    for module in modules:
        key, _ = _excitement(module, dimensions)
        if key is not None:
            dimensions.setdefault(key, Dimension(module.name, EXCITEMENT, module.name))
    projections = tuple(_projection(module, [*dimensions]) for module in modules)
    return JointSpace(
        _by_name(dimensions.values()),
        tuple(nodes for nodes, _ in dimensions),
        projections,
        _first_actions(modules),
        _effects(modules),
    )


def _by_name(dimensions: Iterable[Dimension]) -> dict[str, Labels]:
    """Return the cells of each dimension by its name; a repeated name is followed by the behavior's.

    A behavior may have both an input and a condition of that name.
    """
    cells_by_name: dict[str, Labels] = {}
    for name, cells, owner in dimensions:
        names = (name, f"{name} of {owner}", f"{name} of {owner}, excited")
        cells_by_name[next(each for each in names if each not in cells_by_name)] = cells
    return cells_by_name


def _projection(module: Module, keys: Sequence[Key]) -> Projection:
    axes = tuple(keys.index(_input_key(module, index)) for index in range(len(module.inputs)))
    sizes = tuple(len(cells) for cells in module.inputs.values())
    key, excited_at = _excitement(module, keys)
    return Projection(axes, sizes, None if key is None else keys.index(key), excited_at)


def _input_key(module: Module, index: int) -> Key:
    """Return the nodes that give the cell of an input, for every robot; of a truth the truth itself."""
    nodes = tuple(cells[index] for cells in module.cells)
    size = len(module.inputs[[*module.inputs][index]])
    is_truth = all(node.operation == "cell_of" for node in nodes)
    return (tuple(node.operands[0] for node in nodes) if is_truth else nodes), size


def _excitement(module: Module, keys: Collection[Key]) -> tuple[Key | None, int]:
    """Return the condition that excites a behavior and the index at which it holds; None where it is constant.

    The index is 0 where the condition's opposite is a dimension already.
    """
    nodes = module.excited
    if nodes[0].literal and len(set(nodes)) == 1:
        return None, int(value_of(nodes[0]))
    opposite = tuple(node.operands[0] for node in nodes if node.operation == "not")
    if (nodes, 2) not in keys and (opposite, 2) in keys:
        return (opposite, 2), 0
    return (nodes, 2), 1


def _first_actions(modules: Sequence[Module]) -> tuple[int, ...]:
    counts = [len(module.actions) for module in modules]
    return tuple(sum(counts[:index]) for index in range(len(counts)))


def _effects(modules: Sequence[Module]) -> NDArray[np.uint16]:
    """Return for each action the lowest one that sets the same values; to set nothing is as good as nobody's action."""
    effects = [
        frozenset[object](),
        *(frozenset(sets.items()) for module in modules for sets in module.actions.values()),
    ]
    return np.array([effects.index(effect) for effect in effects], np.uint16)


def policy(space: JointSpace, architecture: Architecture) -> NDArray[np.uint16]:
    """Return the number of the controlling action in every joint cell, (n_joint,); 0 where nobody controls.

    The space should be small (`is_small`): the result has its size.
    """
    numbers: NDArray[np.uint16] = policies(space, [architecture])[0]
    return numbers


def policies(space: JointSpace, architectures: Sequence[Architecture]) -> NDArray[np.uint16]:
    """Return the policies of several architectures with equally many layers, (n_architectures, n_joint)."""
    control = np.zeros((len(architectures), *space.sizes), np.uint16)
    for layer in np.stack([architecture.structure for architecture in architectures]).T:
        # From the lowest layer up, so that the highest one that decides controls.
        for behavior in np.unique(layer).tolist():
            indices = np.flatnonzero(layer == behavior).tolist()
            tables = np.stack([architectures[index].tables[behavior] for index in indices])
            actions = decisions(space, behavior, tables)
            numbers = (actions + np.uint16(space.first_actions[behavior])).astype(np.uint16)
            control[indices] = np.where(actions > 0, numbers, control[indices])
    return control.reshape(len(architectures), -1)


def controlling(space: JointSpace, architecture: Architecture) -> NDArray[np.int64]:
    """Return the controlling behavior in every joint cell of a small space, (n_joint,); -1 where nobody controls."""
    return np.searchsorted(space.first_actions, policy(space, architecture), side="left") - 1


def decisions(space: JointSpace, behavior: int, tables: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return a behavior's action in the joint space, 0 where it has none or is not excited.

    Tables are (..., n_cells); the result broadcasts to (..., *sizes).
    """
    projection, mesh = space.projections[behavior], np.ogrid[tuple(slice(size) for size in space.sizes)]
    is_excited = (
        mesh[projection.excitement] == projection.excited_at
        if projection.excitement is not None
        else projection.excited_at == 1
    )
    return np.where(is_excited, tables[..., own_cells(space, behavior)], np.uint8(0))


def own_cells(space: JointSpace, behavior: int) -> NDArray[np.int64]:
    """Return the cell of a behavior's own table in each joint cell; the result broadcasts to `sizes`."""
    projection, mesh = space.projections[behavior], np.ogrid[tuple(slice(size) for size in space.sizes)]
    cells = np.zeros((1,) * len(space.sizes), np.int64)
    for axis, size in zip(projection.axes, projection.sizes, strict=True):
        cells = cells * size + mesh[axis]
    return cells


def behavior_keys(space: JointSpace, architectures: Sequence[Architecture]) -> list[bytes]:
    """Return a digest of each architecture, equal for those that set the same values in every joint cell.

    In a space that is not small, it is equal for those with the same structure and tables of its behaviors.
    """
    if not space.is_small:
        return [
            _digest(
                architecture.structure,
                *(architecture.tables[behavior] for behavior in architecture.structure.tolist()),
            )
            for architecture in architectures
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
