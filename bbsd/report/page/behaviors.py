"""The behaviors of a page as plain data: their rules, tables and inputs, and how they are wired."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.architecture.boxes import first_match
from bbsd.architecture.rules import sizes_of
from bbsd.architecture.sayings import one_line
from bbsd.explanation.conditions import join_words
from bbsd.language.meaning.setting.targets import target_name

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.api.paging import Page
    from bbsd.explanation import LayerInWords, RuleInWords
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
    is_listed = len(table) <= MOST_CELLS
    return {
        "name": module.name,
        "actions": [
            {"name": name, "sets": [[command, value] for command, value in _sets_plain(sets).items()]}
            for name, sets in written.actions.items()
        ],
        "inputs": [{"name": name, "cells": [*map(str, cells)]} for name, cells in module.inputs.items()],
        "excited": None if written.excited is None else one_line(written.excited),
        "expects": None if written.expects is None else one_line(written.expects),
        "rules": [
            {"decision": rule.decision, "where": rule.where, "overruled": rule.overruled} for rule in rules
        ],
        "rule_of_cell": _rules_of_cells(rules, module),
        "decisions": table.tolist() if len(table) <= MOST_PLACES else [],
        "remarks": [] if layer is None else _remarks(layer),
        "n_cells": len(table),
        "is_listed": is_listed,
        "visits": _visits(page, index, len(table)) if is_listed else None,
    }


def _sets_plain(sets: Mapping[str, Expression]) -> dict[str, str]:
    """Return what an action sets of each state, as written; of elements, with their indices before."""
    texts: dict[str, list[str]] = {}
    for key, value in sets.items():
        name, text = target_name(key), one_line(value)
        indices = key.strip().removeprefix(name)
        texts.setdefault(name, []).append(f"{indices}: {text}" if indices else text)
    return {name: "; ".join(written) for name, written in texts.items()}


def _rules_of_cells(rules: Sequence[RuleInWords], module: Module) -> Plain:
    """Return for each cell the number of the first rule that holds in it; None where there are none to mark."""
    if not rules or module.n_cells > MOST_PLACES:
        return None
    boxes = []
    for rule in rules:
        named = {condition.input: condition.cells for condition in rule.when}
        boxes.append(
            tuple(named.get(name, tuple(range(len(cells)))) for name, cells in module.inputs.items())
        )
    return [*map(int, first_match(boxes, sizes_of(module.inputs)).ravel())]


def _remarks(layer: LayerInWords) -> list[Plain]:
    """Return what higher layers always prevent."""
    if layer.cells == 0 and layer.overruled_by:
        return [f"Never controls: {join_words(layer.overruled_by, 'or')} above always does."]
    if layer.covered:
        return [
            f"Higher layers always act where {'; or where '.join(place.where for place in layer.covered)}."
        ]
    return []


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
    return [
        *dict.fromkeys(target_name(key) for each in used for sets in each.actions.values() for key in sets)
    ]
