"""A design as a Python module that needs nothing, not even a complete Python: it also runs on MicroPython."""

from __future__ import annotations

import builtins
import keyword
from typing import TYPE_CHECKING

from bbsd.explanation.lines import wrapped
from bbsd.exports.described import (
    cells_text,
    example_cells,
    has_named_cells,
    head_lines,
    layer_head,
)
from bbsd.exports.names import Names, words_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.architecture.controller import Controller, Layer
    from bbsd.exports.exported import Exported, Files, Options

RESERVED = frozenset({*keyword.kwlist, *keyword.softkwlist, *dir(builtins), "command", "choice"})
BYTES_IN_A_LINE = 24


def write(exported: Exported, options: Options) -> Files:  # noqa: ARG001 - all targets are written alike
    """Return the module's text by its file's name."""
    controller = exported.controller
    arguments = _arguments(controller)
    constants, example = _constants(controller, arguments)
    lines = [
        *_comment(*head_lines(controller)),
        "#",
        *_comment(
            "Give command() the cell of each input; it returns the number of the controlling action, 0 for nobody's, "
            "by which commands stay as they are. ACTIONS[number] has its behavior, its name and what it sets."
        ),
        "#",
        f"#     number = command({', '.join(example)})",
        "",
        f"DESIGN = {controller.name!a}",
        f"DIGEST = {controller.digest!a}",
        "",
        *constants,
        *_actions(controller),
        "",
        *_tables(controller),
        "",
        "",
        *_command(exported, arguments),
    ]
    return {f"{words_of(controller.name).lower() or 'design'}.py": "\n".join(lines) + "\n"}


def _comment(*paragraphs: str) -> list[str]:
    return [line for text in paragraphs for line in wrapped(text, "# ", "# ")]


def _arguments(controller: Controller) -> list[str]:
    names = Names(RESERVED)
    return [
        names.new(f"{each.name} excited" if each.is_condition else each.name, lower=True)
        for each in controller.dimensions
    ]


def _constants(controller: Controller, arguments: Sequence[str]) -> tuple[list[str], list[str]]:
    """Return the constants that name cells, with comments, and arguments of an example by them."""
    names = Names({"DESIGN", "DIGEST", "ACTIONS", "SIZES"})
    lines, example = list[str](), list[str]()
    cells = example_cells(controller)
    for dimension, argument, cell in zip(controller.dimensions, arguments, cells, strict=True):
        lines += _comment(f"{argument}: {cells_text(dimension)}")
        value = str(cell)
        if has_named_cells(dimension):
            constants = [names.new(f"{argument} {label}", upper=True) for label in dimension.cells]
            lines += [f"{name} = {index}" for index, name in enumerate(constants)]
            value = constants[cell]
        lines.append("")
        example.append(f"{argument}={value}")
    return lines, example


def _actions(controller: Controller) -> list[str]:
    rows = [f"    ({each.behavior!a}, {each.name!a}, {dict(each.sets)!a})," for each in controller.actions]
    return [
        "# By number: behavior, action, and what it sets in the words of the design.",
        "ACTIONS = (",
        "    (None, None, {}),",
        *rows,
        ")",
    ]


def _table(layer: Layer) -> str:
    return f"_TABLE_{layer.number}"


def _tables(controller: Controller) -> list[str]:
    sizes = "".join(f"{size}, " for size in controller.sizes)
    lines = [f"_SIZES = ({sizes.strip()})"]
    for layer in controller.layers:
        parts = [
            layer.table[first : first + BYTES_IN_A_LINE]
            for first in range(0, len(layer.table), BYTES_IN_A_LINE)
        ]
        if len(parts) == 1:
            lines.append(f"{_table(layer)} = {parts[0]!r}")
        else:
            lines += [f"{_table(layer)} = (", *(f"    {part!r}" for part in parts), ")"]
    return lines


def _command(exported: Exported, arguments: Sequence[str]) -> Iterator[str]:
    controller = exported.controller
    yield f"def command({', '.join(arguments)}):"
    yield '    """Return the number of the controlling action, 0 for nobody. ValueError: there is no such cell."""'
    if arguments:
        listed = "".join(f"{each}, " for each in arguments).strip()
        yield f"    for cell, size in zip(({listed}), _SIZES):"
        yield "        if not 0 <= cell < size:"
        yield '            raise ValueError("there is no cell %r of %d" % (cell, size))'
    for layer in controller.layers:
        for text in (layer_head(layer), *exported.sentences[layer.number]):
            yield from wrapped(text, "    # ", "    #   ")
        indent = "    "
        if layer.excitement is not None:
            yield f"    if {arguments[layer.excitement]} == {layer.excited_at}:"
            indent = "        "
        yield f"{indent}choice = {_table(layer)}[{_place(layer, arguments)}]"
        yield f"{indent}if choice:"
        yield f"{indent}    return {_number(layer)}"
    yield "    return 0"


def _number(layer: Layer) -> str:
    return f"{layer.first_action} + choice" if layer.first_action else "choice"


def _place(layer: Layer, arguments: Sequence[str]) -> str:
    """Return the expression of a layer's place in its table: row-major, by Horner's scheme."""
    if not layer.axes:
        return "0"
    first, *rest = layer.axes
    place = arguments[first]
    for axis, size in zip(rest, layer.sizes[1:], strict=True):
        left = f"({place})" if " + " in place else place
        place = f"{left} * {size} + {arguments[axis]}"
    return place
