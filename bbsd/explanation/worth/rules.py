"""The rules of a behavior one by one: the cells that each decides, and the table without it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.architecture.boxes import first_match
from bbsd.architecture.rules import boxes_of, n_words_of, sizes_of
from bbsd.architecture.spec_changes import MOST_WORDS
from bbsd.explanation.conditions import condition_text
from bbsd.language.meaning.tables.rules import cells_matched
from bbsd.language.meaning.tables.table import NO_ACTION, OPEN_CELL
from bbsd.language.models import NO_ACTION_TEXT, Otherwise

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.architecture.boxes import Box
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.models import Rule

Cells = npt.NDArray[np.uint8]

MOST_RULES, MOST_CELLS = 100, 5_000_000
"""Rules of a behavior that are looked at one by one, and cells of all tables without one: more are not read."""


@dataclass(frozen=True, slots=True, eq=False)
class SingleRule:
    """A rule of a behavior, the first match deciding.

    `where` is its condition in words, '' otherwise. `cells` (n_cells,) are those that it decides, `without` (n_cells,)
    is the table without the rule: its cells follow the next rule that holds, or are left to the layers below.
    """

    where: str
    decision: str
    cells: npt.NDArray[np.bool_]
    without: Cells

    @property
    def acts(self) -> bool:
        """Whether its decision is an action."""
        return self.decision != NO_ACTION_TEXT


def single_rules(module: Module, table: Cells, written: Sequence[Rule] = ()) -> list[SingleRule]:
    """Return the rules of a behavior, first to last; none if they are too many to look at one by one.

    Args:
        module: the behavior.
        table: its decisions, (n_cells,).
        written: the rules that the spec has; they count as they are where they decide the whole table, else short ones
            are found.
    """
    sizes = sizes_of(module.inputs)
    boxes, decisions = _as_written(module, written)
    if not np.array_equal(decisions[_matches(boxes, sizes)], table):
        found, default = boxes_of(table, module.inputs)
        if n_words_of(found, module.inputs) > MOST_WORDS:
            return []
        boxes = [box for box, _ in found]
        decisions = np.array([*(decision for _, decision in found), default], np.uint8)
    if len(decisions) > min(MOST_RULES, MOST_CELLS // len(table)):
        return []
    words, matched = (NO_ACTION_TEXT, *module.actions), _matches(boxes, sizes)
    rules = []
    for index, decision in enumerate(decisions.tolist()):
        rest = _matches(boxes[:index] + boxes[index + 1 :], sizes)
        without = np.append(np.delete(decisions, index), np.uint8(NO_ACTION))[rest]
        where = condition_text(boxes[index], module.inputs) if index < len(boxes) else ""
        rules.append(SingleRule(where, words[decision], matched == index, without))
    return rules if rules[-1].cells.any() or rules[-1].where else rules[:-1]


def _as_written(module: Module, written: Sequence[Rule]) -> tuple[list[Box], Cells]:
    """Return the boxes of the rules of a spec, and their decisions, the last one for all other cells."""
    words = (NO_ACTION_TEXT, *module.actions)
    rules = [rule for rule in written if not isinstance(rule, Otherwise)]
    otherwise = [rule.otherwise for rule in written if isinstance(rule, Otherwise)] or [NO_ACTION_TEXT]
    decisions = [*(rule.do for rule in rules), otherwise[0]]
    if not set(decisions) <= {*words}:
        return [], np.array([OPEN_CELL], np.uint8)
    boxes = [cells_matched(rule, module.inputs) for rule in rules]
    return boxes, np.array([words.index(decision) for decision in decisions], np.uint8)


def _matches(boxes: Sequence[Box], sizes: Sequence[int]) -> npt.NDArray[np.int64]:
    """Return the index of the first box that holds each cell, and one more than the last where none does."""
    indices = first_match(boxes, sizes)
    return np.where(indices < 0, len(boxes), indices)
