"""Cells that rules leave open without saying so."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.scope import Findings
from bbsd.expression.syntax.mistakes import KEY, Mistake
from bbsd.language.meaning.tables.rules import table_of_rules
from bbsd.language.meaning.tables.table import OPEN_CELL
from bbsd.language.models import NO_ACTION_TEXT, OPEN, Otherwise, When

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.language.meaning import Meaning
    from bbsd.language.models import Rule
    from bbsd.language.validation import LocatedMistake


def undecided_cells(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield a warning for each behavior whose rules leave cells open that no rule names."""
    for index, module in enumerate(meaning.episode.modules):
        rules = meaning.spec.behaviors[module.name].rules
        if not rules or isinstance(rules[-1], Otherwise) or not module.table.is_open:
            continue
        decided = table_of_rules(
            [_with_decision(rule) for rule in rules], module.inputs, list(module.actions), (), Findings()
        )
        number = decided.given.count(OPEN_CELL)
        if number and meaning.structure.may_hold(index):
            cells = f"{number:,} of {module.n_cells:,} cells"
            message = f"no rule matches {cells}, so these are open to design"
            advice = f"end with - otherwise: {OPEN} if they shall be, else with - otherwise: {NO_ACTION_TEXT}"
            yield ("behaviors", module.name, "rules"), Mistake("BB205", message, KEY, advice)


def _with_decision(rule: Rule) -> Rule:
    """Return a rule that decides the same cells, and leaves none open."""
    return (
        rule.model_copy(update={"do": NO_ACTION_TEXT}) if isinstance(rule, When) and rule.do == OPEN else rule
    )
