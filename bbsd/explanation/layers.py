"""The explanation of an architecture, layer by layer: rules in words, and what higher layers always prevent."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.boxes import FREE, KEEP, first_match
from bbsd.architecture.policy import controlling, joint_space
from bbsd.architecture.possible import possible_cells
from bbsd.architecture.rules import n_words_of, sizes_of
from bbsd.architecture.sayings import one_line
from bbsd.architecture.shortest import rule_list, unordered_cover
from bbsd.architecture.spec_changes import MOST_WORDS
from bbsd.explanation.cells import cares_of, in_order
from bbsd.explanation.conditions import condition_text, conditions_of, places_in_words
from bbsd.explanation.useless import depends_on, useless_of
from bbsd.explanation.vocabulary import actions_of, inputs_of
from bbsd.explanation.whole import rows_of
from bbsd.explanation.words import (
    CellsInWords,
    Explanation,
    InputInWords,
    LayerInWords,
    NeverAsked,
    PlaceInWords,
    RuleInWords,
    Watched,
)
from bbsd.language.models import NO_ACTION_TEXT

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.architecture.boxes import Box
    from bbsd.architecture.visits import Visits
    from bbsd.explanation.cells import Cares
    from bbsd.language.field_types import Expression
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.meaning.tables.table import Inputs

NOBODY, IMPOSSIBLE = -1, -2
"""Who controls in a joint cell where no behavior does, and in one that cannot occur."""
MOST_TABLE = 4096
"""Cells of a table that an explanation lists one by one."""


def explain_architecture(
    meaning: Meaning, architecture: Architecture, visits: Visits | None = None
) -> Explanation:
    """Explain an architecture of a spec; numbers of cells count joint cells, not time spent in them.

    With `visits`, cells that were never asked do not matter to the rules; what the table says there is listed apart.
    """
    space = joint_space(meaning)
    order = architecture.structure.tolist()
    possible = possible_cells(meaning, space) if space.is_small else None
    control = None if possible is None else controlling(space, architecture)
    if possible is not None and control is not None:
        control = np.where(possible.ravel(), control, IMPOSSIBLE)
    nobody = np.zeros(0, bool) if control is None else control == NOBODY
    never = np.zeros(0, bool) if control is None else control == IMPOSSIBLE
    behaviors = list(meaning.spec.behaviors)
    highest_first = [behaviors[behavior] for behavior in reversed(order)]
    cares = cares_of(space, architecture, possible, control, visits)
    layers = tuple(
        _layer(meaning, architecture, layer, cares[order[layer]], control, visits)
        for layer in reversed(range(len(order)))
    )
    return Explanation(
        name=meaning.spec.name,
        layers=layers,
        left_out=tuple(name for index, name in enumerate(behaviors) if index not in order),
        joint_size=space.joint_size,
        possible_cells=None if possible is None else int(np.count_nonzero(possible)),
        nobody=places_in_words(nobody, never, space.dimensions) if nobody.any() else (),
        nobody_cells=None if control is None else int(nobody.sum()),
        rows=rows_of(meaning, architecture, cares, visits),
        useless=tuple(useless_of(meaning, architecture, cares, layers, visits)),
        watched=None if visits is None else Watched(visits.episodes, visits.robot_steps, visits.nobody),
        inputs=inputs_of(meaning.spec, highest_first),
        actions=actions_of(meaning.spec, highest_first),
    )


def _layer(
    meaning: Meaning,
    architecture: Architecture,
    layer: int,
    cares: Cares,
    controls: NDArray[np.int64] | None,
    visits: Visits | None,
) -> LayerInWords:
    behavior = int(architecture.structure[layer])
    module, table = meaning.episode.modules[behavior], architecture.tables[behavior].astype(np.int64)
    written, names = meaning.spec.behaviors[module.name], list(meaning.spec.behaviors)
    sizes, words = sizes_of(module.inputs), (NO_ACTION_TEXT, *module.actions)
    boxes, is_shortest = rule_list(np.where(cares.counts, table, FREE), sizes)
    n_words = n_words_of(boxes, module.inputs)
    is_readable = n_words <= MOST_WORDS
    n_cells = None if controls is None else int(np.count_nonzero(controls == behavior))
    first = first_match([box for box, _ in boxes], sizes)
    said = np.array([decision for _, decision in boxes])[first]
    covered, effective = ((), ()) if n_cells == 0 else _overruled(cares, said, module.inputs)
    above = in_order(architecture.structure.tolist(), cares.prevented_by)
    return LayerInWords(
        layer=layer + 1,
        behavior=module.name,
        excited=_one_line(written.excited),
        expects=_one_line(written.expects),
        inputs=_inputs(module, depends_on(table, cares.counts, sizes)),
        rules=_rules(module, boxes, _counts(visits, behavior, first), n_cells == 0) if is_readable else (),
        is_shortest=is_shortest,
        words=n_words,
        table=_table(table, cares, words) if is_readable and len(table) <= MOST_TABLE else (),
        counted=() if is_readable else _counted(table, words),
        kinds=cares.kinds,
        covered=covered,
        effective=effective,
        overruled_by=tuple(names[other] for other in above),
        never_asked=_never_asked(module, table, cares, said) if is_readable else (),
        cells=n_cells,
        asked=None if visits is None else int(visits.asked[behavior].sum()),
        controlled=None if visits is None else int(visits.controlled[behavior].sum()),
    )


def _inputs(module: Module, depends: Sequence[bool]) -> tuple[InputInWords, ...]:
    return tuple(
        InputInWords(name, tuple(map(str, cells)) if len(cells) <= MOST_TABLE else (), matters)
        for (name, cells), matters in zip(module.inputs.items(), depends, strict=True)
    )


def _overruled(
    cares: Cares, said: NDArray[np.int64], inputs: Inputs
) -> tuple[tuple[PlaceInWords, ...], tuple[PlaceInWords, ...]]:
    """Return where rules have an action and higher layers always act before, and where it is left to the behavior."""
    lost, left = cares.covered & (said > 0), ~cares.covered & (said > 0)
    if not lost.any():
        return (), ()
    free = cares.impossible | (said == 0)
    return places_in_words(lost, free | (cares.covered & ~lost), inputs), places_in_words(left, free, inputs)


def _counts(
    visits: Visits | None, behavior: int, first: NDArray[np.int64]
) -> Callable[[int], tuple[int | None, int | None]]:
    """Return a function from a rule's number to how often it was asked and controlled."""

    def counts(rule: int) -> tuple[int | None, int | None]:
        if visits is None:
            return None, None
        asked, controlled = (
            each[behavior][first == rule].sum() for each in (visits.asked, visits.controlled)
        )
        return int(asked), int(controlled)

    return counts


def _one_line(condition: Expression | None) -> str | None:
    return None if condition is None else one_line(condition)


def _rules(
    module: Module,
    boxes: Sequence[tuple[Box, int]],
    counts: Callable[[int], tuple[int | None, int | None]],
    overruled: bool,
) -> tuple[RuleInWords, ...]:
    words = (NO_ACTION_TEXT, *module.actions)
    return tuple(
        RuleInWords(
            words[decision],
            condition_text(box, module.inputs),
            conditions_of(box, module.inputs),
            overruled and decision > 0,
            *counts(index),
        )
        for index, (box, decision) in enumerate(boxes)
    )


def _table(table: NDArray[np.int64], cares: Cares, words: Sequence[str]) -> tuple[str, ...]:
    return tuple(
        words[decision] if counts else ""
        for decision, counts in zip(table.tolist(), cares.counts.tolist(), strict=True)
    )


def _never_asked(
    module: Module, table: NDArray[np.int64], cares: Cares, said: NDArray[np.int64]
) -> tuple[NeverAsked, ...]:
    """Return what a table says in cells that were never asked, first where it says something else than the rules."""
    words, found = (NO_ACTION_TEXT, *module.actions), list[NeverAsked]()
    if not cares.unasked.any():
        return ()
    for agrees in (False, True):
        cells = cares.unasked & ((said == table) == agrees)
        values = np.where(cells, table, np.where(cares.covered | cares.impossible, FREE, KEEP))
        boxes = unordered_cover(values, sizes_of(module.inputs))
        if n_words_of(boxes, module.inputs) > MOST_WORDS:
            continue
        found += [
            NeverAsked(
                words[decision], condition_text(box, module.inputs), conditions_of(box, module.inputs), agrees
            )
            for box, decision in boxes
        ]
    return tuple(found)


def _counted(table: NDArray[np.int64], words: Sequence[str]) -> tuple[CellsInWords, ...]:
    """Return the number of cells of each decision that a table has, the most frequent first."""
    counts = np.bincount(table).tolist()
    cells = [CellsInWords(words[decision], count) for decision, count in enumerate(counts) if count]
    return tuple(sorted(cells, key=lambda counted: -counted.cells))
