"""The whole architecture as one table: which command in which situation, by which module."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.boxes import FREE, KEEP, first_match
from bbsd.architecture.rules import n_words_of, sizes_of
from bbsd.architecture.sayings import one_line
from bbsd.architecture.shortest import unordered_cover
from bbsd.architecture.spec_changes import MOST_WORDS
from bbsd.explanation.conditions import condition_text, conditions_of
from bbsd.explanation.words import Row

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.architecture import Architecture
    from bbsd.architecture.visits import Visits
    from bbsd.explanation.cells import Cares
    from bbsd.language.meaning import Meaning


def rows_of(
    meaning: Meaning, architecture: Architecture, cares: Sequence[Cares], visits: Visits | None
) -> tuple[Row, ...]:
    """Return a row for each situation that a behavior acts in: those most often in control first, else the highest.

    Cells with the same action of a behavior are merged into as few rows as can be. What was never asked counts here
    too, so the rows are the whole policy. None are returned where they would be too many to read.
    """
    rows: list[Row] = []
    for layer in reversed(range(len(architecture.structure))):
        of_layer = _rows_of_layer(meaning, architecture, layer, cares, visits)
        if of_layer is None:
            return ()
        rows += of_layer
    if sum(1 + sum(len(condition.cells) for condition in row.when) for row in rows) > MOST_WORDS:
        return ()
    return tuple(sorted(rows, key=lambda row: -(row.controlled or 0)))


def _rows_of_layer(
    meaning: Meaning, architecture: Architecture, layer: int, cares: Sequence[Cares], visits: Visits | None
) -> list[Row] | None:
    """Return the rows of one layer; None where they would be too many to read."""
    behavior = int(architecture.structure[layer])
    module, table = meaning.episode.modules[behavior], architecture.tables[behavior]
    matters = cares[behavior].by_tables
    excited = meaning.spec.behaviors[module.name].excited
    values = np.where(matters, np.where(table > 0, table.astype(np.int64), KEEP), FREE)
    boxes = unordered_cover(values, sizes_of(module.inputs))
    if n_words_of(boxes, module.inputs) > MOST_WORDS:
        return None
    first = first_match([box for box, _ in boxes], sizes_of(module.inputs))
    return [
        Row(
            layer + 1,
            module.name,
            list(module.actions)[decision - 1],
            condition_text(box, module.inputs),
            conditions_of(box, module.inputs),
            None if excited is None else one_line(excited),
            None if visits is None else int(visits.controlled[behavior][first == index].sum()),
        )
        for index, (box, decision) in enumerate(boxes)
    ]
