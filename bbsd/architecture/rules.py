"""From a table to the rules that a designer would write, in the words of the spec."""

from __future__ import annotations

import re
from itertools import pairwise
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.boxes import FREE, KEEP, cover, n_words
from bbsd.expression.scope import Findings
from bbsd.language.meaning.partitions import TRUTH_CELLS
from bbsd.language.meaning.tables.rules import table_of_rules
from bbsd.language.meaning.tables.table import OPEN_CELL
from bbsd.language.models import NO_ACTION_TEXT, OPEN, Otherwise

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from bbsd.architecture.boxes import Box
    from bbsd.language.meaning.tables.labels import Labels
    from bbsd.language.meaning.tables.table import Inputs
    from bbsd.language.models import Rule
    from bbsd.text import Data

RuleData = dict[str, "Data"]
"""A rule as plain data, as the spec writes it."""

WHOLE_NUMBER = re.compile(r"0|-?[1-9][0-9]{0,14}")


def rules_of(
    table: NDArray[np.uint8],
    inputs: Inputs,
    actions: Sequence[str],
    given: Sequence[Rule] = (),
    most_words: float = inf,
) -> list[RuleData] | None:
    """Return a short list of rules that decide every cell as the table does, each cell by the first match.

    Rules that the designer gave are kept, and new ones inserted before the first that leaves its cells open; at the
    end, if none does. None where the new ones would have more than `most_words`.

    Args:
        table: (n_cells,), 0 for No Action, k for the k-th action.
        inputs: each input's cells, in the order of the table's dimensions.
        actions: the actions' names.
        given: rules that agree with the table and leave a cell open at least.
        most_words: decisions and named cells, counted together.
    """
    first = next((index for index, rule in enumerate(given) if _decision(rule) == OPEN), len(given))
    before, after = given[:first], [rule for rule in given[first:] if _decision(rule) != OPEN]
    is_open = _cells(given, inputs, actions) == OPEN_CELL
    is_decided = _cells(before, inputs, actions) != OPEN_CELL
    words = (NO_ACTION_TEXT, *actions)

    values = np.where(is_open, table, np.where(is_decided, FREE, KEEP))
    last: list[RuleData] = []
    if not after:
        default = most_common(table[is_open])
        values[is_open & (table == default)] = KEEP
        last = [{"otherwise": words[default]}]
    designed = cover(values, sizes_of(inputs))
    if n_words_of(designed, inputs) > most_words:
        return None
    rules: list[RuleData] = [{"when": conditions(box, inputs), "do": words[value]} for box, value in designed]
    return [*map(_rule_data, before), *rules, *last, *map(_rule_data, after)]


def boxes_of(table: NDArray[np.uint8], inputs: Inputs) -> tuple[list[tuple[Box, int]], int]:
    """Return the boxes and decisions of a table's rules, and the decision otherwise; shapes as in `rules_of`."""
    default = most_common(table)
    values = np.where(table == default, KEEP, table.astype(np.int64))
    return cover(values, sizes_of(inputs)), default


def n_words_of(boxes: Sequence[tuple[Box, int]], inputs: Inputs) -> int:
    """Return the number of decisions and cells that the rules for some boxes name."""
    return sum(n_words(box, sizes_of(inputs)) for box, _ in boxes)


def most_common(decisions: NDArray[np.uint8]) -> int:
    """Return the most common decision; of equals the lowest, which is No Action if it is among them."""
    return int(np.bincount(decisions).argmax())


def sizes_of(inputs: Inputs) -> list[int]:
    """Return the number of cells of each input."""
    return [len(cells) for cells in inputs.values()]


def conditions(box: Box, inputs: Inputs) -> dict[str, Data]:
    """Return what a rule for a box says under `when`: a cell, or a list of cells, of each input that matters."""
    named = {
        name: cell_words(chosen, cells)
        for (name, cells), chosen in zip(inputs.items(), box, strict=True)
        if len(chosen) < len(cells)
    }
    return {name: words[0] if len(words) == 1 else words for name, words in named.items()}


def _cells(rules: Sequence[Rule], inputs: Inputs, actions: Sequence[str]) -> NDArray[np.int64]:
    return np.frombuffer(table_of_rules(rules, inputs, actions, (), Findings()).given, np.uint8).astype(
        np.int64
    )


def _decision(rule: Rule) -> str:
    return rule.otherwise if isinstance(rule, Otherwise) else rule.do


def _rule_data(rule: Rule) -> RuleData:
    if isinstance(rule, Otherwise):
        return {"otherwise": rule.otherwise}
    words = {name: [_datum(cell) for cell in cells] for name, cells in rule.when.items()}
    when: Data = {name: cells[0] if len(cells) == 1 else cells for name, cells in words.items()}
    return {"when": when, "do": rule.do}


def cell_words(chosen: Sequence[int], cells: Labels) -> list[Data]:
    """Return cells as a rule names them; of a cut, neighbors as one range."""
    bounds = _bounds(cells)
    if bounds is None:
        return [_datum(cells[cell]) for cell in chosen]
    return [_range(run, bounds) for run in _runs(chosen)]


def _datum(cell: str) -> Data:
    """Return a cell's label as the YAML value that reads best: `true` and `5` without quotes."""
    if cell in TRUTH_CELLS:
        return cell == TRUTH_CELLS[1]
    return int(cell) if WHOLE_NUMBER.fullmatch(cell) else cell


def _bounds(cells: Labels) -> list[str] | None:
    """Return the bounds of a cut, read off its labels; None where a range of them would not be understood."""
    if not cells[0].startswith("below "):
        return None
    bounds = [cells[0].removeprefix("below "), *(cell.split(" to ", 1)[-1] for cell in cells[1:-1])]
    labels = [
        f"below {bounds[0]}",
        *(f"{low} to {high}" for low, high in pairwise(bounds)),
        f"from {bounds[-1]}",
    ]
    is_clear = not any(" to " in bound or bound.startswith(("below ", "from ")) for bound in bounds)
    return bounds if [*cells] == labels and len(set(bounds)) == len(bounds) and is_clear else None


def _runs(chosen: Iterable[int]) -> list[range]:
    """Return cells as runs of neighbors."""
    runs: list[range] = []
    for cell in chosen:
        if runs and runs[-1].stop == cell:
            runs[-1] = range(runs[-1].start, cell + 1)
        else:
            runs.append(range(cell, cell + 1))
    return runs


def _range(run: range, bounds: list[str]) -> str:
    if run.start == 0:
        return f"below {bounds[run.stop - 1]}"
    if run.stop > len(bounds):
        return f"from {bounds[run.start - 1]}"
    return f"{bounds[run.start - 1]} to {bounds[run.stop - 1]}"
