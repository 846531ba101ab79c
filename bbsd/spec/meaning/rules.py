"""Rules to table cells: what a behavior's rules give, cell by cell, and what they leave open."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from bbsd.errors import did_you_mean
from bbsd.expression.mistakes import Mistake
from bbsd.expression.scope import Findings, Path
from bbsd.expression.tree import Span
from bbsd.spec.models import NO_ACTION_TEXT, OPEN, Otherwise, Rule

OPEN_CELL = 255
NO_ACTION = 0

Inputs = Mapping[str, tuple[str, ...]]
"""Each input's cells, in the order of the table's dimensions."""


@dataclass(frozen=True, slots=True)
class Table:
    """A table's cells in row-major order of the inputs: 0 for No Action, k for the k-th action, 255 for open."""

    given: bytes

    @property
    def is_open(self) -> bool:
        """Whether any cell is left to be designed."""
        return OPEN_CELL in self.given


def table(rules: Sequence[Rule] | None, inputs: Inputs, actions: Sequence[str], path: Path, findings: Findings) -> Table:
    """The cells that rules decide, the first match first; mistakes are told and the rule is passed over."""
    sizes = [len(cells) for cells in inputs.values()]
    decided: dict[tuple[int, ...], int] = {}
    for place, rule in enumerate(rules or ()):
        decision = _decision(rule, actions, (*path, place), findings)
        matched = _matched(rule, inputs, (*path, place), findings)
        if decision is None or matched is None:
            continue
        fresh = [cells for cells in product(*matched) if cells not in decided]
        if not fresh:
            _tell(findings, (*path, place), "BB037", "this rule never applies: the rules before it decide all its cells")
        decided.update(dict.fromkeys(fresh, decision))
    return Table(bytes(decided.get(cells, OPEN_CELL) for cells in product(*(range(size) for size in sizes))))


def _tell(findings: Findings, path: Path, code: str, message: str, advice: str = "") -> None:
    findings.mistakes[path, Mistake(code, message, Span(0, 0), advice)] = None


def _decision(rule: Rule, actions: Sequence[str], path: Path, findings: Findings) -> int | None:
    key, word = ("otherwise", rule.otherwise) if isinstance(rule, Otherwise) else ("do", rule.do)
    if word in (NO_ACTION_TEXT, OPEN):
        return NO_ACTION if word == NO_ACTION_TEXT else OPEN_CELL
    if word in actions:
        return actions.index(word) + 1
    hint = did_you_mean(word, [*actions, NO_ACTION_TEXT, OPEN])
    _tell(findings, (*path, key), "BB036", f'"{word}" is not an action of this behavior{hint}', f"its actions: {', '.join(actions)}")
    return None


def _matched(rule: Rule, inputs: Inputs, path: Path, findings: Findings) -> list[list[int]] | None:
    """For each input, the cells that the rule matches; None after a mistake."""
    when = {} if isinstance(rule, Otherwise) else rule.when
    correct = True
    for name in when.keys() - inputs.keys():
        hint = did_you_mean(name, inputs) or (f"; its inputs: {', '.join(inputs)}" if inputs else "; it has none")
        _tell(findings, (*path, "when", name), "BB034", f'"{name}" is not an input of this behavior{hint}')
        correct = False
    matched = []
    for name, cells in inputs.items():
        named = [_cells(word, cells) for word in when.get(name, [])]
        for place, (word, found) in enumerate(zip(when.get(name, []), named, strict=True)):
            if found is None:
                message = f'"{word}" is not a cell of {name}{did_you_mean(word, cells)}'
                _tell(findings, (*path, "when", name, place), "BB035", message, _cells_advice(cells))
                correct = False
        matched.append(sorted({cell for found in named for cell in found or ()}) if name in when else list(range(len(cells))))
    return matched if correct else None


def _cells_advice(cells: tuple[str, ...]) -> str:
    shown = ", ".join(cells[:12])
    return f"its cells: {shown}{', ...' if len(cells) > 12 else ''}"


RANGE = re.compile(r"below (?P<below>.+)|from (?P<from>.+)|(?P<low>.+?) to (?P<high>.+)")


def _cells(word: str, cells: tuple[str, ...]) -> range | None:
    """The cells a word names: one, or a range of the cells of a cut."""
    if word in cells:
        return range(cells.index(word), cells.index(word) + 1)
    bounds = _bounds(cells)
    match = RANGE.fullmatch(word)
    if bounds is None or match is None:
        return None
    low = match["from"] or match["low"]
    high = match["below"] or match["high"]
    if not {low, high} <= {None, *bounds}:
        return None
    first = bounds.index(low) + 1 if low else 0
    last = bounds.index(high) + 1 if high else len(cells)
    return range(first, last) if first < last else None


def _bounds(cells: tuple[str, ...]) -> list[str] | None:
    """The bounds of a cut, read off its cells."""
    if not (len(cells) >= 2 and cells[0].startswith("below ") and cells[-1].startswith("from ")):
        return None
    return [cells[0].removeprefix("below "), *(cell.split(" to ", 1)[1] for cell in cells[1:-1])]
