"""Conditions on inputs in words, such as `place is lowest and tilted`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.boxes import FREE, KEEP, cover
from bbsd.architecture.rules import cell_words, n_words_of, sizes_of
from bbsd.architecture.spec_changes import MOST_WORDS
from bbsd.explanation.words import Condition, PlaceInWords
from bbsd.language.meaning.partitions import TRUTH_CELLS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.architecture.boxes import Box
    from bbsd.language.meaning.tables.labels import Labels
    from bbsd.language.meaning.tables.table import Inputs


def condition_text(box: Box, inputs: Inputs) -> str:
    """Return the condition that holds in a box, such as `place is lowest and tilted`; '' if it always holds."""
    parts = [
        _input_text(name, chosen, cells)
        for (name, cells), chosen in zip(inputs.items(), box, strict=True)
        if len(chosen) < len(cells)
    ]
    return " and ".join(parts)


def conditions_of(box: Box, inputs: Inputs) -> tuple[Condition, ...]:
    """Return the condition that holds in a box for programs: of each input that it names, the cells."""
    return tuple(
        Condition(name, chosen, tuple(str(cells[cell]) for cell in chosen))
        for (name, cells), chosen in zip(inputs.items(), box, strict=True)
        if len(chosen) < len(cells)
    )


def places_in_words(
    cells: NDArray[np.bool_], allowed: NDArray[np.bool_], inputs: Inputs
) -> tuple[PlaceInWords, ...]:
    """Return places, one of which holds each cell of `cells`, and none a cell outside `cells` and `allowed`.

    Both are (n_cells,). The result is empty if the conditions would be too long to read.
    """
    values = np.where(cells, 0, np.where(allowed, FREE, KEEP))
    boxes = cover(values, sizes_of(inputs))
    return (
        ()
        if n_words_of(boxes, inputs) > MOST_WORDS
        else tuple(PlaceInWords(condition_text(box, inputs), conditions_of(box, inputs)) for box, _ in boxes)
    )


def join_words(words: Sequence[str], last: str) -> str:
    """Return words joined to `a, b or c`, where `last` is the word before the last one."""
    return f" {last} ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def _input_text(name: str, chosen: tuple[int, ...], cells: Labels) -> str:
    if cells == TRUTH_CELLS:
        return name if chosen == (1,) else f"not {name}"
    words = _words(chosen, cells)
    missing = (
        _words(sorted(set(range(len(cells))).difference(chosen)), cells) if _is_most(chosen, cells) else []
    )
    if not missing or len(missing) >= len(words):
        return f"{name} is {join_words(words, 'or')}"
    return (
        f"{name} is not {missing[0]}"
        if len(missing) == 1
        else f"{name} is neither {join_words(missing, 'nor')}"
    )


def _is_most(chosen: tuple[int, ...], cells: Labels) -> bool:
    """Return whether naming the other cells may be shorter: they are fewer, or lie between chosen ones."""
    return 2 * len(chosen) > len(cells) or (chosen[0] == 0 and chosen[-1] == len(cells) - 1)


def _words(chosen: Sequence[int], cells: Labels) -> list[str]:
    return [str(word) for word in cell_words(chosen, cells)]
