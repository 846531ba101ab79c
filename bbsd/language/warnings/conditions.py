"""Conditions that hold never, or always."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import WHOLE, Mistake

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from bbsd.expression.scope import Path
    from bbsd.language.meaning import Meaning
    from bbsd.language.validation import LocatedMistake
    from bbsd.language.warnings.proving import Prover


def vain_conditions(
    meaning: Meaning, prover: Prover, told: Collection[Path] = ()
) -> Iterator[LocatedMistake]:
    """Yield a warning for each behavior that is never excited, and for an end that never comes or comes at once.

    At the paths in `told` the cause was told before.
    """
    for module in meaning.episode.modules:
        behavior = meaning.spec.behaviors[module.name]
        if ("behaviors", module.name, "excited") in told:
            continue
        if behavior.excited is not None and all(map(prover.never, dict.fromkeys(module.excited))):
            message, advice = (
                f"{module.name} is never excited: this never holds",
                "mend it, or leave the behavior out",
            )
            yield ("behaviors", module.name, "excited"), Mistake("BB209", message, WHOLE, advice)
    ends, written = meaning.episode.ends, meaning.spec.environment.ends
    if ends is not None and written is not None and meaning.spec.environment.outside is None:
        path = ("environment", "ends")
        if path in told:
            return
        if prover.never(ends):
            yield (
                path,
                Mistake(
                    "BB209", "this never holds, so no episode ends by it", WHOLE, "mend it, or leave it out"
                ),
            )
        elif prover.always(ends):
            message = "this always holds, so every episode ends after its first step"
            yield path, Mistake("BB209", message, WHOLE, "mend it, or write steps: 1")
