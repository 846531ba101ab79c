"""The behaviors of a page as plain data: their rules, tables and inputs, and how they are wired."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.architecture.boxes import first_match
from bbsd.architecture.rules import boxes_of, sizes_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.api.paging import Page
    from bbsd.explanation import LayerInWords
    from bbsd.language.field_types import Expression
    from bbsd.language.meaning.behaviors import Module
    from bbsd.report.plain import Plain

MOST_CELLS = 400
"""Cells of a decision table that can be opened on the page."""
MOST_PLACES = 20_000
"""Cells of a table whose rules are marked as the replay passes."""


class _Input(NamedTuple):
    name: str
    meaning: str


def behaviors_plain(page: Page) -> list[Plain]:
    """Return the behaviors in the spec's order."""
    layers = {layer.behavior: layer for layer in page.explanation.layers}
    return [
        _behavior_plain(page, index, module, layers.get(module.name))
        for index, module in enumerate(page.loaded.meaning.episode.modules)
    ]


def _behavior_plain(page: Page, index: int, module: Module, layer: LayerInWords | None) -> dict[str, Plain]:
    table = page.architecture.tables[index]
    written = page.loaded.spec.behaviors[module.name]
    rules = layer.rules if layer is not None else ()
    boxes, _ = boxes_of(table, module.inputs) if rules else ([], 0)
    matched = first_match([box for box, _ in boxes], sizes_of(module.inputs)).ravel() if boxes else None
    is_listed = len(table) <= MOST_CELLS
    return {
        "name": module.name,
        "actions": [
            {"name": name, "sets": [[command, _one_line(value)] for command, value in sets.items()]}
            for name, sets in written.actions.items()
        ],
        "inputs": [{"name": name, "cells": [*map(str, cells)]} for name, cells in module.inputs.items()],
        "excited": None if written.excited is None else _one_line(written.excited),
        "expects": None if written.expects is None else _one_line(written.expects),
        "rules": [
            {"decision": rule.decision, "where": rule.where, "overruled": rule.overruled} for rule in rules
        ],
        "rule_of_cell": _rules_of_cells(matched, len(table), len(rules)),
        "remarks": [],
        "n_cells": len(table),
        "table": table.tolist() if is_listed else None,
        "visits": _visits(page, index, len(table)) if is_listed else None,
    }


def _rules_of_cells(matched: NDArray[np.int64] | None, n_cells: int, n_rules: int) -> Plain:
    """Return for each cell the number of the rule that decides it; the last one is that for all other cells."""
    if not n_rules or n_cells > MOST_PLACES:
        return None
    if matched is None:
        return [0] * n_cells
    return [*map(int, np.where(matched < 0, n_rules - 1, matched))]


def _visits(page: Page, index: int, n_cells: int) -> list[Plain]:
    """Return the share of the replayed robot-steps in each cell."""
    cells = np.concatenate([replay.trace.decisions.cells[..., index].ravel() for replay in page.replays])
    counts = np.bincount(cells, minlength=n_cells)
    return [round(float(share), 6) for share in counts / max(counts.sum(), 1)]


def inputs_plain(page: Page) -> list[Plain]:
    """Return each input with its meaning and its users: the behavior, and which of its inputs it is."""
    meanings = {entry.word: entry.meaning for entry in page.explanation.inputs}
    users: dict[_Input, list[Plain]] = {}
    for layer in page.explanation.layers:
        index = [*page.loaded.spec.behaviors].index(layer.behavior)
        for place, name in enumerate(page.loaded.meaning.episode.modules[index].inputs):
            own = next((word for word in meanings if _belongs(word, name, layer.behavior)), name)
            users.setdefault(_Input(own, meanings.get(own, "")), []).append([index, place])
    return [{"name": read.name, "meaning": read.meaning, "users": used} for read, used in users.items()]


def _belongs(word: str, name: str, behavior: str) -> bool:
    """Return whether a word of the glossary is an input's name, perhaps followed by the behaviors that mean it."""
    start, _, owners = word.partition(" of ")
    return start == name and (not owners or behavior in owners.split(", "))


def commands_plain(page: Page) -> list[Plain]:
    """Return the names that actions set, in the spec's order of behaviors."""
    behaviors = page.loaded.spec.behaviors
    used = [behaviors[layer.behavior] for layer in reversed(page.explanation.layers)]
    return [*dict.fromkeys(name for each in used for sets in each.actions.values() for name in sets)]


def _one_line(expression: Expression) -> str:
    return " ".join(expression.text.split())
