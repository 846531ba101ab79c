"""All kinds of mistakes by their stable codes; each layer lists the kinds that it finds in one module."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors.expression_kinds import EXPRESSION_KINDS
from bbsd.errors.spec_kinds import SPEC_KINDS
from bbsd.errors.text_kinds import TEXT_KINDS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.errors.kind import DiagnosisKind

KINDS: Mapping[str, DiagnosisKind] = {
    kind.code: kind for kind in (*TEXT_KINDS, *SPEC_KINDS, *EXPRESSION_KINDS)
}


def describe(code: str) -> DiagnosisKind:
    """Return the kind of mistake of a code, in either case; raises KeyError if there is no such code."""
    return KINDS[code.upper()]
