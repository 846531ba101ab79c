"""What every exported file says of its design in comments, and which of its cells have names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.architecture.controller import command
from bbsd.language.meaning.partitions import TRUTH_CELLS
from bbsd.language.meaning.tables.labels import Numbers
from bbsd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.architecture.controller import Action, Controller, Dimension, Layer
    from bbsd.exports.names import Names

WHOLE = 1e15
"""Whole numbers below this are written without a decimal point."""


def head_lines(controller: Controller) -> tuple[str, ...]:
    """Return what a file says first: which design it is, and what wrote it."""
    return (
        f"{controller.name}",
        f"Written by bbsd {__version__} from the design with the digest {controller.digest}.",
    )


def layer_head(layer: Layer) -> str:
    """Return the heading of a layer."""
    return f"Layer {layer.number}, {layer.behavior}:"


def cells_text(dimension: Dimension) -> str:
    """Return which cells a dimension has, by number, and how they follow from sensors and state."""
    if is_truth(dimension):
        return f"1 where {dimension.text}, 0 elsewhere"
    if isinstance(dimension.cells, Numbers):
        first, last = dimension.cells.first, dimension.cells.last
        number = "the number" if not first else f"the number less {first}"
        return f"{number} of {dimension.text}; what is not in {first} to {last} counts as the nearest"
    if dimension.text.startswith("cut("):
        return f"the cell of {dimension.text}"
    if ": " in dimension.text:
        return f"the first that holds of {dimension.text}"
    return f"the value of {dimension.text}"


def has_named_cells(dimension: Dimension) -> bool:
    """Return whether the cells have names of their own: not truths, nor numbers."""
    return not (is_truth(dimension) or isinstance(dimension.cells, Numbers))


def is_truth(dimension: Dimension) -> bool:
    """Return whether its cells are false and true, or not excited and excited."""
    return dimension.is_condition or (dimension.size == 2 and tuple(dimension.cells) == TRUTH_CELLS)


def example_cells(controller: Controller) -> tuple[int, ...]:
    """Return a joint cell for an example: one in which the highest layer that can act does, if it is soon found."""
    for layer in controller.layers:
        choice = next((place for place, choice in enumerate(layer.table) if choice), None)
        if choice is None:
            continue
        cells = [0] * len(controller.dimensions)
        for axis, size in zip(reversed(layer.axes), reversed(layer.sizes), strict=True):
            choice, cells[axis] = divmod(choice, size)
        if layer.excitement is not None:
            cells[layer.excitement] = layer.excited_at
        if command(controller, cells):
            return tuple(cells)
    return (0,) * len(controller.dimensions)


def input_names(controller: Controller, names: Names) -> tuple[str, ...]:
    """Return identifiers of the dimensions, in small letters."""
    return tuple(names.new(input_text(each), lower=True) for each in controller.dimensions)


def input_text(dimension: Dimension) -> str:
    """Return what an identifier of a dimension is made of."""
    return f"{dimension.name} excited" if dimension.is_condition else dimension.name


def inputs_said(controller: Controller, names: Sequence[str]) -> Iterator[str]:
    """Yield a line for each input: its identifier, its cells by number, with their names where they have some."""
    for dimension, name in zip(controller.dimensions, names, strict=True):
        yield f"  {name}: {numbered_cells(dimension)}"


def numbered_cells(dimension: Dimension) -> str:
    """Return the cells of a dimension by number, each with its name where they have names, and how they follow."""
    if not has_named_cells(dimension):
        return cells_text(dimension)
    named = ", ".join(f"{index} {label}" for index, label in enumerate(dimension.cells))
    return f"{named}; {cells_text(dimension)}"


def actions_said(controller: Controller) -> Iterator[str]:
    """Yield a line for each number of an action: its name, its behavior and what it sets."""
    yield "action:"
    yield "  0: nobody controls, commands stay as they are"
    for number, action in enumerate(controller.actions, 1):
        yield f"  {number}: {action.name} of {action.behavior}, sets {sets_text(action)}"


def sets_text(action: Action) -> str:
    """Return what an action sets, as the design writes it."""
    return "; ".join(f"{name}: {value}" for name, value in action.sets.items()) or "nothing"


def number_text(value: float | bool) -> str:
    """Return a number or a truth as targets read it: `0.5`, `-1`, `true`."""
    if isinstance(value, bool):
        return str(value).lower()
    return repr(int(value)) if value.is_integer() and abs(value) < WHOLE else repr(value)
