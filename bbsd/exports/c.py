"""A design as one C99 header: whole numbers only, no memory of its own, tables that can stay in flash."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, NamedTuple

from bbsd.explanation.lines import wrapped
from bbsd.exports.described import cells_text, example_cells, has_named_cells, head_lines, layer_head
from bbsd.exports.names import Names, words_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.architecture.controller import Controller, Layer
    from bbsd.exports.exported import Exported, Files, Options

RESERVED_TEXT = (
    "alignas alignof and and_eq asm atomic auto bitand bitor bool break case catch char class compl complex "
    "concept const const_cast consteval constexpr constinit continue decltype default delete do double "
    "dynamic_cast else enum errno explicit export extern false final float for friend fortran goto i386 if "
    "imaginary import inline int int16_t int32_t int64_t int8_t linux long main module mutable namespace new "
    "noexcept noreturn not not_eq nullptr operator or or_eq override private protected public register "
    "reinterpret_cast requires restrict return short signed sizeof static static_assert static_cast struct "
    "switch template this thread_local throw true try typedef typeid typename typeof uint16_t uint32_t "
    "uint64_t uint8_t union unix unsigned using virtual void volatile wchar_t while xor xor_eq "
)
"""Words of C and C++, names of stdint.h, and macros of compilers in small letters."""
RESERVED = frozenset({*RESERVED_TEXT.split(), "choice"})
MOST_IN_A_WORD = 65_536
"""Cells that an index of 16 bits, the smallest that `unsigned` has, can tell apart."""
BYTES_IN_A_LINE = 24


class Writing(NamedTuple):
    """A controller with the identifiers of its parts: parameters by dimension, constants of cells, of actions."""

    controller: Controller
    prefix: str
    parameters: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]
    """Of each dimension; empty where its cells have no names."""
    actions: tuple[str, ...]
    """By number; 0 is nobody's."""

    @property
    def upper(self) -> str:
        """What constants begin with."""
        return self.prefix.upper()


def write(exported: Exported, options: Options) -> Files:  # noqa: ARG001 - all targets are written alike
    """Return the header's text by its file's name."""
    writing = named(exported.controller)
    upper = writing.upper
    lines = [
        *_head(writing),
        f"#ifndef {upper}_H",
        f"#define {upper}_H",
        "",
        "#include <stdint.h>",
        "",
        f'#define {upper}_DIGEST "{exported.controller.digest}"',
        "",
        *_cells(writing),
        *_actions(writing),
        *_tables(writing),
        *_command(writing, exported),
        "",
        f"#endif /* {upper}_H */",
    ]
    return {f"{writing.prefix}.h": "\n".join(lines) + "\n"}


def named(controller: Controller) -> Writing:
    """Return a controller with the identifiers that its header has."""
    prefix = words_of(controller.name).lower()
    prefix = prefix if prefix and not prefix[0].isdigit() else f"design_{prefix}".rstrip("_")
    parameters, upper = Names(RESERVED), f"{prefix}_".upper()
    constants = Names({f"{upper}{word}" for word in ("H", "DIGEST", "TABLE", "READ", "NOBODY")}, upper)
    named = tuple(
        tuple(constants.new(f"{each.name} {label}", upper=True) for label in each.cells)
        if has_named_cells(each)
        else ()
        for each in controller.dimensions
    )
    return Writing(
        controller,
        prefix,
        tuple(
            parameters.new(f"{each.name} excited" if each.is_condition else each.name, lower=True)
            for each in controller.dimensions
        ),
        named,
        (
            f"{upper}NOBODY",
            *(constants.new(f"{each.behavior} {each.name}", upper=True) for each in controller.actions),
        ),
    )


def comment(*paragraphs: str, indent: str = "") -> list[str]:
    """Return paragraphs as a comment that nothing in them can end."""
    lines = [line for text in paragraphs for line in (wrapped(_safe(text), f"{indent} * ", f"{indent} * "))]
    lines[0] = f"{indent}/*{lines[0][len(indent) + 2 :]}"
    lines[-1] += " */"
    return lines


def _safe(text: str) -> str:
    """Return a text without what ends a comment, begins another one, joins lines or is a trigraph."""
    return text.replace("??", "? ?").replace("*/", "* /").replace("/*", "/ *").replace("\\", "/")


def _head(writing: Writing) -> Iterator[str]:
    cells = example_cells(writing.controller)
    example = [names[cell] if names else str(cell) for names, cell in zip(writing.cells, cells, strict=True)]
    first, *rest = comment(*head_lines(writing.controller))
    yield first
    yield from (line.removesuffix(" */") for line in rest)
    yield " *"
    (first, *rest) = comment(
        f"Give {writing.prefix}_command() the cell of each input, as a number from 0 or by its name below. It returns "
        f"the action of the highest layer that has one, or {writing.actions[0]}, by which commands stay as they are:"
    )
    yield f" * {first[3:]}"
    yield from (line.removesuffix(" */") for line in rest)
    yield " *"
    yield f" *     enum {writing.prefix}_action action = {writing.prefix}_command({'' if example else ');'}"
    for place, argument in enumerate(example):
        yield f" *         {argument}{');' if place == len(example) - 1 else ','}"
    yield " *"
    yield " * It uses no floating point, no heap and no state: the same cells always give"
    yield " * the same action. */"


def _cells(writing: Writing) -> Iterator[str]:
    for dimension, parameter, names in zip(
        writing.controller.dimensions, writing.parameters, writing.cells, strict=True
    ):
        if names:
            yield from comment(f"{parameter}: {cells_text(dimension)}")
            yield from _enum(f"{writing.prefix}_{parameter}", names, [""] * len(names))
            yield ""


def _actions(writing: Writing) -> Iterator[str]:
    sets = [
        "; ".join(f"{name} = {value}" for name, value in action.sets.items()) or "sets nothing"
        for action in writing.controller.actions
    ]
    yield from comment("What is done: a behavior's action, and what it sets in the words of the design.")
    yield from _enum(f"{writing.prefix}_action", writing.actions, ["", *sets])
    yield ""


def _enum(tag: str, names: Sequence[str], remarks: Sequence[str]) -> Iterator[str]:
    yield f"enum {tag} {{"
    for number, (name, remark) in enumerate(zip(names, remarks, strict=True)):
        if remark:
            yield from comment(remark, indent="    ")
        yield f"    {name} = {number}{',' if number < len(names) - 1 else ''}"
    yield "};"


def _has_table(layer: Layer) -> bool:
    """Return whether a layer's decision depends on its cell."""
    return len(set(layer.table)) > 1


def _table(writing: Writing, layer: Layer) -> str:
    return f"{writing.prefix}_layer_{layer.number}"


def _tables(writing: Writing) -> Iterator[str]:
    layers = [layer for layer in writing.controller.layers if _has_table(layer)]
    if not layers:
        return
    yield from (
        "#if defined(__AVR__) /* tables stay in flash */",
        "#include <avr/pgmspace.h>",
        f"#define {writing.upper}_TABLE PROGMEM",
        f"#define {writing.upper}_READ(place) pgm_read_byte(place)",
        "#else",
        f"#define {writing.upper}_TABLE",
        f"#define {writing.upper}_READ(place) (*(place))",
        "#endif",
        "",
    )
    yield from comment("For each cell of a layer's behavior: 0 is no action, k the behavior's k-th action.")
    for layer in layers:
        name, cells = _table(writing, layer), layer.table
        yield f"static const uint8_t {name}[{len(cells)}] {writing.upper}_TABLE = {{"
        for first in range(0, len(cells), BYTES_IN_A_LINE):
            last = first + BYTES_IN_A_LINE >= len(cells)
            yield f"    {', '.join(map(str, cells[first : first + BYTES_IN_A_LINE]))}{'' if last else ','}"
        yield "};"
    yield ""


def _command(writing: Writing, exported: Exported) -> Iterator[str]:
    controller = writing.controller
    told = [
        f"  {parameter}: {f'enum {writing.prefix}_{parameter}' if names else cells_text(dimension)}"
        for parameter, names, dimension in zip(
            writing.parameters, writing.cells, controller.dimensions, strict=True
        )
    ]
    none = f"; {writing.actions[0]} also where there is no such cell." if told else "."
    yield from comment(f"Return the controlling action{none}", *told)
    yield f"static inline enum {writing.prefix}_action {writing.prefix}_command("
    yield from _parameters(writing)
    yield "{"
    if any(map(_has_table, controller.layers)):
        yield "    unsigned choice;"
    if checks := [
        f"{parameter} >= {size}U"
        for parameter, size in zip(writing.parameters, controller.sizes, strict=True)
    ]:
        yield "    if (" + "\n        || ".join(checks) + ") {"
        yield f"        return {writing.actions[0]};"
        yield "    }"
    for layer in controller.layers:
        yield ""
        yield from _layer(writing, layer, exported.sentences[layer.number])
    if not _always_acts(controller):
        yield f"    return {writing.actions[0]};"
    yield "}"


def _parameters(writing: Writing) -> Iterator[str]:
    types = ["unsigned" if size <= MOST_IN_A_WORD else "uint32_t" for size in writing.controller.sizes]
    pairs = [f"{kind} {name}" for kind, name in zip(types, writing.parameters, strict=True)]
    yield "    " + (",\n    ".join(pairs) or "void") + ")"


def _always_acts(controller: Controller) -> bool:
    """Return whether the lowest layer has the same action in all its cells, and is always excited."""
    return any(
        layer.excitement is None and not _has_table(layer) and layer.table[0]
        for layer in controller.layers[-1:]
    )


def _layer(writing: Writing, layer: Layer, sentences: Sequence[str]) -> Iterator[str]:
    yield from comment(layer_head(layer), *(f"  {each}" for each in sentences), indent="    ")
    indent = "    "
    if layer.excitement is not None:
        yield f"    if ({writing.parameters[layer.excitement]} == {layer.excited_at}U) {{"
        indent = "        "
    if _has_table(layer):
        number = f"{layer.first_action}U + choice" if layer.first_action else "choice"
        yield f"{indent}choice = {writing.upper}_READ("
        yield f"{indent}    &{_table(writing, layer)}[{_place(writing, layer)}]);"
        yield f"{indent}if (choice != 0U) {{"
        yield f"{indent}    return (enum {writing.prefix}_action)({number});"
        yield f"{indent}}}"
    elif layer.table[0]:
        yield f"{indent}return {writing.actions[layer.first_action + layer.table[0]]};"
    if layer.excitement is not None:
        yield "    }"


def _place(writing: Writing, layer: Layer) -> str:
    """Return the expression of a layer's place in its table: row-major, by Horner's scheme."""
    first, *rest = layer.axes
    place = writing.parameters[first]
    if prod(layer.sizes) > MOST_IN_A_WORD and writing.controller.sizes[first] <= MOST_IN_A_WORD:
        place = f"(uint32_t){place}"
    for axis, size in zip(rest, layer.sizes[1:], strict=True):
        left = f"({place})" if " + " in place else place
        place = f"{left} * {size}U + {writing.parameters[axis]}"
    return place
