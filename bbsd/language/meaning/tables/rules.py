"""From rules to the cells of a behavior's table: what the rules decide, and what they leave open."""

from __future__ import annotations

import re
from math import prod
from typing import TYPE_CHECKING

from bbsd.errors import did_you_mean, nearest
from bbsd.expression.scope import Findings
from bbsd.expression.syntax.mistakes import KEY, WHOLE, Rewriting
from bbsd.expression.syntax.tree import Call, Name
from bbsd.language.meaning.tables.naming import bounds_of, cells_named, meant_cell
from bbsd.language.meaning.tables.table import NO_ACTION, OPEN_CELL, Inputs, Table
from bbsd.language.models import NO_ACTION_TEXT, OPEN, Otherwise, Rule

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from bbsd.expression.scope import Path
    from bbsd.expression.syntax.tree import Span
    from bbsd.language.meaning.tables.labels import Labels
    from bbsd.language.models import PartitionText, Spec

MAX_MATCHED = 30_000_000
"""Cells that all rules of a behavior match, each counted once a rule that matches it."""
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?")
RANGE = re.compile(rf"(?:below|from) ({NUMBER.pattern})|({NUMBER.pattern}) to ({NUMBER.pattern})")
MOST_BOUNDS = 12
"""Bounds of a cut that a message repeats."""
NOTHING = frozenset(
    (
        *("nothing", "none", "null", "noop", "no-op", "no_op", "no_action", "no-action"),
        *("do nothing", "do_nothing", "pass", "idle", "wait", "skip", "-"),
    )
)
"""What other tools call no action."""


def table_of_rules(
    rules: Sequence[Rule] | None,
    inputs: Inputs,
    actions: Sequence[str],
    path: Path,
    findings: Findings,
    unusable: Collection[str] = (),
    spec: Spec | None = None,
) -> Table:
    """Return the cells that rules decide, each by the first rule that matches it; report mistakes and skip the rule.

    No mistake is reported in the use of `unusable` names, whose own mistakes were reported before. `spec` is the one
    that the rules stand in, to say what a wrong name is elsewhere.
    """
    decisions = [
        _decision(rule, actions, (*path, index), findings, unusable, spec)
        for index, rule in enumerate(rules or ())
    ]
    sizes = [len(cells) for cells in inputs.values()]
    given, undecided, n_matched = bytearray([OPEN_CELL]) * prod(sizes), bytearray([1]) * prod(sizes), 0
    for index, (rule, decision) in enumerate(zip(rules or (), decisions, strict=True)):
        matched = _matched(rule, inputs, (*path, index), findings, unusable, spec)
        if decision is None or matched is None:
            continue
        n_matched += prod(len(cells) for cells in matched)
        if n_matched > MAX_MATCHED:
            findings.report(
                path, "BB039", f"these rules match more than {MAX_MATCHED} cells, one by one", KEY
            )
            break
        fresh = [cell for cell in _cells_of_block(matched, sizes) if undecided[cell]]
        if not fresh:
            message = "this rule never applies: the rules before it decide all its cells"
            is_behind = any(isinstance(each, Otherwise) for each in (rules or ())[:index])
            advice = "otherwise decides all that is left: write it last" if is_behind else ""
            findings.report((*path, index), "BB037", message, WHOLE, advice)
        for cell in fresh:
            given[cell], undecided[cell] = decision, 0
    return Table(bytes(given))


def cells_matched(rule: Rule, inputs: Inputs) -> tuple[tuple[int, ...], ...]:
    """Return for each input the cells that a rule without mistakes matches, in ascending order."""
    matched = _matched(rule, inputs, (), Findings(), (), None)
    return tuple(tuple(cells) for cells in matched or ())


def _cells_of_block(matched: Sequence[Sequence[int]], sizes: Sequence[int]) -> list[int]:
    """Return the row-major indices of all combinations of the inputs' cells."""
    indices = [0]
    for cells, size in zip(matched, sizes, strict=True):
        indices = [index * size + cell for index in indices for cell in cells]
    return indices


def _decision(
    rule: Rule,
    actions: Sequence[str],
    path: Path,
    findings: Findings,
    unusable: Collection[str],
    spec: Spec | None,
) -> int | None:
    """Return what a cell holds where the rule decides; None where that is no action."""
    key, word = ("otherwise", rule.otherwise) if isinstance(rule, Otherwise) else ("do", rule.do)
    if word in (NO_ACTION_TEXT, OPEN):
        return NO_ACTION if word == NO_ACTION_TEXT else OPEN_CELL
    if word in actions:
        return actions.index(word) + 1
    if word not in unusable and not any(action in unusable for action in actions):
        other = (
            next((name for name, each in spec.behaviors.items() if word in each.actions), "") if spec else ""
        )
        if other and len(path) > 1:
            message = f'"{word}" is an action of {other}, not of {path[1]}'
            own = f"{path[1]} has: {', '.join(actions)}"
            advice = f"{own}; or write no action, or add {word} to the actions of {path[1]}"
            findings.report((*path, key), "BB036", message, WHOLE, advice)
            return None
        is_nothing = word.lower() in NOTHING
        near = NO_ACTION_TEXT if is_nothing else nearest(word, [*actions, NO_ACTION_TEXT, OPEN])
        hint = f'; did you mean "{near}"?' if near else ""
        message = f'"{word}" is not an action of this behavior{hint}'
        advice = f"its actions: {', '.join(actions)}" if actions else ""
        correction = Rewriting(near, is_certain=is_nothing) if near else None
        findings.report((*path, key), "BB036", message, WHOLE, advice, correction)
    return None


def _matched(
    rule: Rule,
    inputs: Inputs,
    path: Path,
    findings: Findings,
    unusable: Collection[str],
    spec: Spec | None,
) -> list[Sequence[int]] | None:
    """Return for each input the cells that the rule matches; None after a mistake."""
    when = {} if isinstance(rule, Otherwise) else rule.when
    for name in when:
        if name not in inputs and name not in unusable:
            if spec and len(path) > 1 and name in spec.environment.sensors:
                findings.report((*path, "when", name), "BB034", *_no_input(name, str(path[1]), spec))
                continue
            near = nearest(name, inputs)
            hint = did_you_mean(name, inputs) or f"; {_inputs_advice(inputs)}"
            message = f'"{name}" is not an input of this behavior{hint}'
            correction = Rewriting(near, KEY, is_certain=False) if near else None
            findings.report((*path, "when", name), "BB034", message, KEY, "", correction)
    matched = [_cells_matched(name, cells, when, path, findings) for name, cells in inputs.items()]
    understood = [cells for cells in matched if cells is not None]
    return understood if when.keys() <= inputs.keys() and len(understood) == len(matched) else None


def _no_input(name: str, behavior: str, spec: Spec) -> tuple[str, Span, str, Rewriting | None]:
    """Return what is said of a sensor that is none of a behavior's inputs: list it there."""
    message = f"{name} is a sensor, but not an input of {behavior}"
    inputs = spec.behaviors[behavior].inputs
    if isinstance(inputs, dict):
        return message, KEY, f"add it to the inputs of {behavior}: {name}: {name}", None
    cut = next((own for own in inputs if _is_cut_of(spec.environment.sensors.get(own), name)), "")
    if cut:
        return (
            f"{message}, which sees it cut: {cut}",
            KEY,
            f"write {cut}",
            Rewriting(cut, KEY, is_certain=False),
        )
    wanted = f"[{', '.join([*inputs, name])}]"
    written = Rewriting(wanted, is_certain=False, at=("behaviors", behavior, "inputs"))
    return message, KEY, f"write inputs: {wanted}", written


def _is_cut_of(sensor: PartitionText | None, name: str) -> bool:
    """Return whether a sensor cuts a number with a name into cells."""
    if sensor is None or isinstance(sensor, dict) or not isinstance(sensor.tree, Call):
        return False
    first = sensor.tree.arguments[:1]
    return sensor.tree.function in ("cut", "values") and [
        each.name for each in first if isinstance(each, Name)
    ] == [name]


def _inputs_advice(inputs: Inputs) -> str:
    return f"its inputs: {', '.join(inputs)}" if inputs else "it has none"


def _cells_matched(
    name: str, cells: Labels, when: Mapping[str, list[str]], path: Path, findings: Findings
) -> Sequence[int] | None:
    if name not in when:
        return range(len(cells))
    named = [cells_named(word, cells) for word in when[name]]
    for index, (word, matched) in enumerate(zip(when[name], named, strict=True)):
        if matched is None:
            near, is_certain = meant_cell(word, cells)
            where = (*path, "when", name, index)
            if (uncut := _uncut(word, name, cells)) is not None:
                findings.report(where, "BB035", uncut[0], WHOLE, uncut[1])
                continue
            if (others := _others(word, cells)) is not None:
                message = f'"{word}" is not a cell of {name}: a condition lists the cells in which it holds'
                written = Rewriting(others[0], is_certain=True) if len(others) == 1 else None
                advice = f"write {name}: {others[0] if len(others) == 1 else '[' + ', '.join(others) + ']'}"
                findings.report(where, "BB035", message, WHOLE, advice, written)
                continue
            hint = f'; did you mean "{near}"?' if near else ""
            message = f'"{word}" is not a cell of {name}{hint}'
            correction = Rewriting(near, is_certain=is_certain) if near else None
            findings.report(where, "BB035", message, WHOLE, _cells_advice(cells), correction)
    if None in named:
        return None
    return sorted({cell for matched in named for cell in matched or ()})


def _others(word: str, cells: Labels) -> list[str] | None:
    """Return the cells that `not CELL` means; None for other words, and for too many to list."""
    negated = re.fullmatch(r"(?:not |!|~)\s*(.+)", word.strip())
    if negated is None or negated[1] not in cells or len(cells) > MOST_BOUNDS:
        return None
    return [cell for cell in cells if cell != negated[1]]


def _uncut(word: str, name: str, cells: Labels) -> tuple[str, str] | None:
    """Return message and advice for a range that begins or ends where an input is not cut; None for other words."""
    match, bounds = RANGE.fullmatch(word.strip()), bounds_of(cells)
    if match is None or not bounds or not all(map(NUMBER.fullmatch, bounds)):
        return None
    wanted = [number for number in match.groups() if number is not None]
    new = [number for number in wanted if float(number) not in map(float, bounds)]
    if not new or len(bounds) > MOST_BOUNDS:
        return None
    message = f"{name} is not cut at {' and '.join(new)}, only at {_listed(bounds)}"
    all_bounds = ", ".join(sorted({*bounds, *new}, key=float))
    one = "take one of these" if len(bounds) > 1 else "take this one"
    return message, f"{one}, or add the bound where {name} is cut: cut(..., {all_bounds})"


def _listed(words: Sequence[str]) -> str:
    *former, last = words
    return f"{', '.join(former)} and {last}" if former else last


def _cells_advice(cells: Labels) -> str:
    shown = ", ".join(cells[:12])
    ranges = "; a range begins and ends at any bound" if bounds_of(cells) and len(cells) > 2 else ""
    return f"its cells: {shown}{', ...' if len(cells) > 12 else ''}{ranges}"
