"""All warnings about a spec without mistakes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.language.warnings.unused import unused_names
from bbsd.language.warnings.uses import uses_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.language.meaning import Meaning
    from bbsd.language.validation import LocatedMistake


def warnings_of(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield the warnings about a spec that was understood, in no order, but for those of single expressions."""
    uses = uses_of(meaning.spec)
    yield from unused_names(uses)
