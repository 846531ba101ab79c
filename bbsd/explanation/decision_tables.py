"""Decision tables as text: the rules of a behavior as rows, or all its cells as a grid; the whole architecture."""

from __future__ import annotations

from itertools import product
from math import prod
from typing import TYPE_CHECKING, NamedTuple

from bbsd.architecture.rules import cell_words
from bbsd.explanation.lines import LINE_WIDTH, percent, table_lines, wrapped
from bbsd.language.meaning.partitions import TRUTH_CELLS
from bbsd.language.meaning.tables.symbols import SYMBOLS
from bbsd.language.models import NO_ACTION_TEXT

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.explanation.words import Condition, Explanation, InputInWords, LayerInWords, Watched

SCREEN = 20
"""Rows of rules from which on a grid of cells is tried; with what is around it, a terminal's screen has 24."""
ANY = "-"
NOT_COUNTED = " "


class DecisionTable(NamedTuple):
    """Lines, and how to read them."""

    how: str
    lines: list[str]


def decision_table(layer: LayerInWords, indent: str = "", watched: Watched | None = None) -> DecisionTable:
    """Return a behavior's rules as a table: each row is a rule, and the first that fits decides.

    Where that has too many rows for a screen, and a grid of all its cells has fewer, it is the grid. Where
    episodes were watched, it says of each rule in which share of time the behavior was asked and the rule held first.
    """
    rules = _rule_table(layer, indent, watched)
    grid = _grid(layer, indent) if len(rules) > SCREEN else []
    if grid and len(grid) < len(rules):
        return DecisionTable("the decision in each cell", grid)
    return DecisionTable("the first row that fits decides", rules)


def _rule_table(layer: LayerInWords, indent: str, watched: Watched | None) -> list[str]:
    named = [each for each in layer.inputs if any(each.name in _inputs(rule.when) for rule in layer.rules)]
    head = [*(each.name for each in named), "decision", *(["asked"] if watched else [])]
    rows = [
        [
            *(_cell_text(rule.when, each) for each in named),
            rule.decision,
            *([percent((rule.asked or 0) / max(1, watched.robot_steps))] if watched else []),
        ]
        for rule in layer.rules
    ]
    return table_lines(head, rows, indent, frozenset({len(named) + 1}))


def _inputs(when: Sequence[Condition]) -> list[str]:
    return [condition.input for condition in when]


def _cell_text(when: Sequence[Condition], each: InputInWords) -> str:
    """Return which cells of an input a rule names: `-` for any, those that it excludes where these are fewer."""
    named = next((condition for condition in when if condition.input == each.name), None)
    if named is None:
        return ANY
    if not each.cells:
        return ", ".join(named.labels)
    chosen = named.cells
    if each.cells == TRUTH_CELLS:
        return "yes" if chosen == (1,) else "no"
    words = [str(word) for word in cell_words(chosen, each.cells)]
    others = [index for index in range(len(each.cells)) if index not in chosen]
    missing = [str(word) for word in cell_words(others, each.cells)] if others else []
    return ", ".join(words) if not missing or len(missing) >= len(words) else f"not {', '.join(missing)}"


def _grid(layer: LayerInWords, indent: str) -> list[str]:
    """Return all cells of a table as a grid, a character each; empty where it has no fitting form."""
    inputs = [each for each in layer.inputs if each.matters]
    if not layer.table or any(not each.cells for each in inputs):
        return []
    forms = [_grid_of(layer, inputs[:split], inputs[split:], indent) for split in range(1, len(inputs))]
    narrow_first = [form for form in reversed(forms) if max(map(len, form)) <= LINE_WIDTH]
    fits = (form for form in narrow_first if len(form) <= SCREEN)
    return next(fits, min(narrow_first, key=len, default=[]))


def _grid_of(
    layer: LayerInWords, down: Sequence[InputInWords], across: Sequence[InputInWords], indent: str
) -> list[str]:
    """Return the grid whose rows are the cells of some inputs, and whose lettered columns those of others."""
    words = list(dict.fromkeys(decision for decision in layer.table if decision))
    actions = [word for word in words if word != NO_ACTION_TEXT]
    symbols = {NO_ACTION_TEXT: SYMBOLS[0], "": NOT_COUNTED} | {
        word: SYMBOLS[index] for index, word in enumerate(actions, 1)
    }
    columns = list(product(*(range(len(each.cells)) for each in across)))
    letters = [chr(ord("a") + index) if index < 26 else f"{index}" for index in range(len(columns))]
    rows = [
        [
            *(each.cells[cell] for each, cell in zip(down, cells, strict=True)),
            *(
                symbols[
                    _decision(
                        layer,
                        dict(zip(_names(down), cells, strict=True))
                        | dict(zip(_names(across), column, strict=True)),
                    )
                ]
                for column in columns
            ),
        ]
        for cells in product(*(range(len(each.cells)) for each in down))
    ]
    key = "; ".join(
        f"{letter} {_column_text(across, column)}" for letter, column in zip(letters, columns, strict=True)
    )
    meanings = ", ".join(f"{symbols[word]} {word}" for word in words)
    meanings += "; blank where it does not matter" if "" in layer.table else ""
    return [
        *table_lines([*_names(down), *letters], rows, indent),
        *wrapped(f"columns: {key}", indent, indent + "  "),
        *wrapped(f"decisions: {meanings}", indent, indent + "  "),
    ]


def _names(inputs: Sequence[InputInWords]) -> list[str]:
    return [each.name for each in inputs]


def _column_text(across: Sequence[InputInWords], column: Sequence[int]) -> str:
    return ", ".join(f"{each.name} {each.cells[cell]}" for each, cell in zip(across, column, strict=True))


def _decision(layer: LayerInWords, cells: dict[str, int]) -> str:
    """Return the decision in the cells of the inputs that matter, of any cells of the others that count."""
    sizes = [len(each.cells) for each in layer.inputs]
    strides = [prod(sizes[index + 1 :]) for index in range(len(sizes))]
    choices = [
        [cells[each.name]] if each.name in cells else range(size)
        for each, size in zip(layer.inputs, sizes, strict=True)
    ]
    found = (
        layer.table[sum(cell * stride for cell, stride in zip(combination, strides, strict=True))]
        for combination in product(*choices)
    )
    return next((decision for decision in found if decision), "")


def whole_table(explanation: Explanation) -> list[str]:
    """Return the whole architecture as a table: which command in which situation, by which behavior."""
    if not explanation.rows:
        return ["No behavior ever controls, or the rows would be too many to read."]
    watched = explanation.watched
    head = [*(["time"] if watched else []), "command", "layer", "behavior", "where"]
    rows = [
        [
            *([percent((row.controlled or 0) / max(1, watched.robot_steps))] if watched else []),
            row.decision,
            str(row.layer),
            row.behavior,
            " and ".join(filter(None, [f"({row.excited})" if row.excited else "", row.where])) or "always",
        ]
        for row in explanation.rows
    ]
    if explanation.nobody_cells or (watched and watched.nobody):
        share = percent(watched.nobody / max(1, watched.robot_steps)) if watched else ""
        rows.append([*([share] if watched else []), "(none)", "", "nobody", "no row above holds"])
    shift = 1 if watched else 0
    return table_lines(head, rows, "", frozenset({*range(shift), shift + 1}))
