"""Behaviors that stand in no layer."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY, Mistake
from bbsd.language.models import OPEN

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.language.meaning import Meaning
    from bbsd.language.validation import LocatedMistake


def left_out_behaviors(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield a warning where a structure leaves out behaviors, but for specs that say how many layers they have."""
    structure, design = meaning.spec.structure, meaning.spec.design
    if structure is None or OPEN in structure or design.layers is not None:
        return
    left_out = [name for name in meaning.spec.behaviors if name not in structure]
    if left_out:
        stands = "stands" if len(left_out) == 1 else "stand"
        message = f"{' and '.join(left_out)} {stands} in no layer, and so never in control"
        advice = f"add {', '.join(left_out)} to structure at its place, or {OPEN} for a layer to be designed"
        yield ("structure",), Mistake("BB215", message, KEY, advice)
