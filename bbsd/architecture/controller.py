"""A design as a controller: the one form from which other languages are written, plain data without nodes or arrays.

It is an architecture on the joint space of its spec (`bbsd.architecture.policy`), which explanations use as well.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from hashlib import blake2b
from math import prod
from typing import TYPE_CHECKING, Any

from bbsd.architecture.policy import joint_space
from bbsd.architecture.sayings import input_texts, one_line
from bbsd.language.meaning.tables.labels import Numbers

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.architecture.architecture import Architecture
    from bbsd.architecture.policy import JointSpace
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.tables.labels import Labels
    from bbsd.language.models import Spec

WORLD = ("definitions", "world", "state", "dynamics", "sensors")
"""The blocks of an environment in which names have their meaning."""


@dataclass(frozen=True, slots=True)
class Dimension:
    """One thing that the behaviors tell apart, and its cells by name; names of dimensions are unique.

    `text` says how its cells follow from sensors and state, as the spec writes it. A dimension that only says whether a
    behavior is excited has that behavior's name, `is_condition` and the cells `not excited`, `excited`.
    """

    name: str
    cells: Labels
    text: str
    is_condition: bool

    @property
    def size(self) -> int:
        """The number of cells."""
        return len(self.cells)


@dataclass(frozen=True, slots=True)
class Action:
    """An action of a behavior, and what it sets: the expression, as written, of each name of state."""

    name: str
    behavior: str
    sets: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Layer:
    """A layer, its behavior, and the behavior's table.

    The behavior perceives the dimensions `axes`, its inputs; `sizes` are their numbers of cells, and its table is
    row-major over them. It is excited where the dimension `excitement` has the cell `excited_at`; always where that is
    None. The table holds 0 for No Action, k for the k-th action, whose number is `first_action + k`.
    """

    number: int
    """Counted from 1, the lowest."""
    behavior: str
    excited: str | None
    """When it is excited, as written; None: always."""
    axes: tuple[int, ...]
    sizes: tuple[int, ...]
    excitement: int | None
    excited_at: int
    table: bytes
    first_action: int
    n_actions: int

    def cell(self, cells: Sequence[int]) -> int:
        """Return the place in the table for a joint cell."""
        place = 0
        for axis, size in zip(self.axes, self.sizes, strict=True):
            place = place * size + cells[axis]
        return place


@dataclass(frozen=True, slots=True)
class Controller:
    """A design without holes: what it tells apart, its layers from the highest down, and its actions.

    Action k is `actions[k - 1]`, counted over all behaviors of the spec as kernels do, whether they have a layer or
    not. Layers whose behavior is never excited are left out. `digest` is of all this but the name, and of the
    world that gives it its meaning.
    """

    name: str
    digest: str
    dimensions: tuple[Dimension, ...]
    layers: tuple[Layer, ...]
    actions: tuple[Action, ...]

    @property
    def sizes(self) -> tuple[int, ...]:
        """The number of cells of each dimension."""
        return tuple(dimension.size for dimension in self.dimensions)

    @property
    def joint_size(self) -> int:
        """The number of joint cells."""
        return prod(self.sizes)


def controller_of(meaning: Meaning, architecture: Architecture) -> Controller:
    """Return the controller that a design is."""
    space = joint_space(meaning)
    dimensions, actions = _dimensions(meaning, space), _actions(meaning)
    layers = tuple(
        _layer(meaning, architecture, space, number)
        for number in range(len(architecture.structure), 0, -1)
        if _may_be_excited(space, int(architecture.structure[number - 1]))
    )
    return Controller(
        meaning.spec.name, _digest(meaning.spec, dimensions, layers, actions), dimensions, layers, actions
    )


def command(controller: Controller, cells: Sequence[int]) -> int:
    """Return the number of the controlling action in a joint cell, an index for each dimension; 0 is nobody's."""
    for layer in controller.layers:
        if layer.excitement is None or cells[layer.excitement] == layer.excited_at:
            choice = layer.table[layer.cell(cells)]
            if choice:
                return layer.first_action + choice
    return 0


def _may_be_excited(space: JointSpace, behavior: int) -> bool:
    projection = space.projections[behavior]
    return projection.excitement is not None or projection.excited_at == 1


def _dimensions(meaning: Meaning, space: JointSpace) -> tuple[Dimension, ...]:
    """Return the dimensions of a joint space, each with what the first behavior that has it says of it."""
    texts, conditions = dict[int, str](), set[int]()
    behaviors = meaning.spec.behaviors
    for module, projection in zip(meaning.episode.modules, space.projections, strict=True):
        of_inputs = input_texts(meaning.spec, behaviors[module.name])
        for name, axis in zip(module.inputs, projection.axes, strict=True):
            texts.setdefault(axis, of_inputs[name])
    for module, projection in zip(meaning.episode.modules, space.projections, strict=True):
        condition, excitement = behaviors[module.name].excited, projection.excitement
        if excitement is not None and condition is not None and excitement not in texts:
            texts[excitement] = one_line(condition)
            conditions.add(excitement)
    return tuple(
        Dimension(name, cells, texts[axis], axis in conditions)
        for axis, (name, cells) in enumerate(space.dimensions.items())
    )


def _actions(meaning: Meaning) -> tuple[Action, ...]:
    return tuple(
        Action(name, behavior, {target: one_line(value) for target, value in sets.items()})
        for behavior, written in meaning.spec.behaviors.items()
        for name, sets in written.actions.items()
    )


def _layer(meaning: Meaning, architecture: Architecture, space: JointSpace, number: int) -> Layer:
    behavior = int(architecture.structure[number - 1])
    module, projection = meaning.episode.modules[behavior], space.projections[behavior]
    condition = meaning.spec.behaviors[module.name].excited
    return Layer(
        number,
        module.name,
        None if condition is None else one_line(condition),
        projection.axes,
        projection.sizes,
        projection.excitement,
        projection.excited_at,
        architecture.tables[behavior].tobytes(),
        space.first_actions[behavior],
        len(module.actions),
    )


def _digest(
    spec: Spec, dimensions: Sequence[Dimension], layers: Sequence[Layer], actions: Sequence[Action]
) -> str:
    """Return 32 hexadecimal digits that are equal for designs of equal content in the same world.

    What cells and actions mean depends on the constants, sensors and state that their expressions read.
    """
    content: dict[str, Any] = {
        "constants": _in_order(spec.constants),
        "environment": [_in_order(getattr(spec.environment, block)) for block in WORLD],
        "dimensions": [[each.name, _cells(each.cells), each.text] for each in dimensions],
        "layers": [
            [each.behavior, each.excited, each.axes, each.excitement, each.excited_at, each.table.hex()]
            for each in layers
        ],
        "actions": [[each.name, each.behavior, dict(each.sets)] for each in actions],
    }
    text = json.dumps(content, ensure_ascii=True, separators=(",", ":"))
    return blake2b(text.encode(), digest_size=16).hexdigest()


def _in_order(entries: Mapping[str, Any]) -> list[Any]:
    """Return entries by name, in the order of their names, with expressions as text."""
    return [[name, _plain(entries[name])] for name in sorted(entries)]


def _plain(written: Any) -> Any:  # noqa: ANN401 - expressions, nested in lists and mappings
    match written:
        case dict():
            return [[name, _plain(each)] for name, each in written.items()]
        case list() | tuple():
            return [_plain(each) for each in written]
    return one_line(written)


def _cells(cells: Labels) -> list[str] | list[int]:
    """Return labels as JSON writes them; of consecutive numbers only the first and the last one, not a text."""
    return [cells.first, cells.last] if isinstance(cells, Numbers) else list(cells)
