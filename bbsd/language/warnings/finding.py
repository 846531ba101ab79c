"""All warnings about a spec without mistakes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.language.warnings.actions import useless_actions
from bbsd.language.warnings.conditions import vain_conditions
from bbsd.language.warnings.influence import uninfluenced_terms
from bbsd.language.warnings.left_out import left_out_behaviors
from bbsd.language.warnings.proving import Prover
from bbsd.language.warnings.reach import unreached_cells
from bbsd.language.warnings.robots import absent_robots, robots_alike
from bbsd.language.warnings.rounding import rounded_equalities
from bbsd.language.warnings.terms import settled_terms
from bbsd.language.warnings.undecided import undecided_cells
from bbsd.language.warnings.unset import unset_values
from bbsd.language.warnings.unused import unused_names
from bbsd.language.warnings.uses import uses_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.language.meaning import Meaning
    from bbsd.language.validation import LocatedMistake


def warnings_of(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield the warnings about a spec that was understood, in no order, but for those of single expressions."""
    uses, prover = uses_of(meaning.spec), Prover(meaning)
    yield from unused_names(uses)
    yield from unset_values(meaning, uses)
    yield from useless_actions(meaning)
    yield from undecided_cells(meaning)
    yield from left_out_behaviors(meaning)
    yield from robots_alike(meaning)
    yield from uninfluenced_terms(meaning)
    absent = [*absent_robots(meaning)]
    yield from absent
    yield from vain_conditions(meaning, prover, {path for path, _ in absent})
    yield from settled_terms(meaning, prover)
    yield from unreached_cells(meaning, prover)
    yield from rounded_equalities(meaning)
