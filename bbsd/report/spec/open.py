"""What a spec leaves open to design, in words and as plain data."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, Any

from bbsd.errors import escape
from bbsd.language.meaning.holes import holes_of
from bbsd.language.meaning.size import size_of
from bbsd.report.wording.numbers import count

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.holes import Holes, OpenCells

MOST_NAMES = 8
"""Behaviors, and cells of an input, that a single line names."""
MOST_BLOCKS = 3
"""Blocks of open cells of one behavior that a single line names."""


def open_line(meaning: Meaning) -> str:
    """Return what is open in a line, such as `3 of 6 cells of stop (place middle); the structure (5 layers)`.

    '' where nothing is open. What would be long is cut, with `...`.
    """
    holes = holes_of(meaning)
    whole = [each.module.name for each in holes.cells if each.count == each.of]
    parts = [f"all cells of {_names(whole)}"] if whole else []
    parts += [_part(each) for each in _first([each for each in holes.cells if each.count < each.of])]
    partly = sum(each.count < each.of for each in holes.cells)
    parts += [f"cells of {partly - MOST_NAMES} more"] * (partly > MOST_NAMES)
    return "; ".join([*([", ".join(parts)] if parts else []), *_layers(holes)])


def _part(cells: OpenCells) -> str:
    blocks = [*islice(cells.where(), MOST_BLOCKS + 1)]
    shown = [_block(block) for block in blocks[:MOST_BLOCKS]] + ["..."] * (len(blocks) > MOST_BLOCKS)
    return f"{cells.count:,} of {cells.of:,} cells of {cells.module.name} ({'; '.join(shown)})"


def open_list(meaning: Meaning) -> str:
    """Return all that is open, a line for each block of cells, indented below the behavior; '' if nothing is."""
    holes = holes_of(meaning)
    lines = []
    for cells in holes.cells:
        lines.append(f"{cells.module.name}: {cells.count:,} of {count(cells.of, 'cell')} open")
        lines += [f"  {_block(block, shorten=False) or 'all'}" for block in cells.where()]
    return "\n".join([*lines, *_layers(holes)])


def _layers(holes: Holes) -> list[str]:
    if not holes.layers:
        return []
    if len(holes.layers) == holes.n_layers:
        rest = f" for {len(holes.candidates)} behaviors" * (len(holes.candidates) > holes.n_layers)
        return [f"the structure ({count(holes.n_layers, 'layer')}{rest})"]
    places = _names([str(layer) for layer in holes.layers])
    which = f"layer{'s' * (len(holes.layers) > 1)} {places} of {holes.n_layers} from the top"
    return [f"{which}, for {_names(holes.candidates, 'or')}"]


def _block(where: Mapping[str, Sequence[str]], *, shorten: bool = True) -> str:
    """Return a block of cells in words: `place lowest or middle, tilted true`."""
    words = (
        f"{name} {_names(cells, 'or') if shorten else ' or '.join(cells)}" for name, cells in where.items()
    )
    return escape(", ".join(words))


def _names(names: Sequence[str], word: str = "and") -> str:
    if len(names) > MOST_NAMES:
        return f"{', '.join(_first(names))}, ... ({len(names):,})"
    *most, last = names
    return f"{', '.join(most)} {word} {last}" if most else last


def _first(items: Sequence[Any]) -> Sequence[Any]:
    return items[:MOST_NAMES]


def open_plain(meaning: Meaning) -> dict[str, Any]:
    """Return what is open: blocks of each behavior's cells as under `when`, and layers from 1, the highest, on."""
    holes, size = holes_of(meaning), size_of(meaning.episode.modules, meaning.structure)
    return {
        "cells": [
            {"behavior": each.module.name, "open": each.count, "of": each.of, "where": [*each.where()]}
            for each in holes.cells
        ],
        "layers": [*holes.layers],
        "of_layers": holes.n_layers,
        "candidates": [*holes.candidates],
        "decades": round(size.decades, 3),
    }
