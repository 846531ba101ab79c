"""All kinds of diagnoses by their stable codes; each layer lists the kinds that it finds in a module of its own.

A new kind goes into its layer's module and takes the number after the highest one in use: mistakes count on from BB001,
warnings from BB201. A number says nothing about the layer, and the number of a removed kind is not used again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors.kinds.behaviors import BEHAVIOR_KINDS
from bbsd.errors.kinds.design import DESIGN_KINDS
from bbsd.errors.kinds.environment import ENVIRONMENT_KINDS
from bbsd.errors.kinds.expression import EXPRESSION_KINDS
from bbsd.errors.kinds.kind import Severity
from bbsd.errors.kinds.lists import LIST_KINDS
from bbsd.errors.kinds.outside import OUTSIDE_KINDS
from bbsd.errors.kinds.spec import SPEC_KINDS
from bbsd.errors.kinds.text import TEXT_KINDS
from bbsd.errors.kinds.warnings import WARNING_KINDS
from bbsd.errors.kinds.words import WORD_KINDS

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from bbsd.errors.kinds.kind import DiagnosisKind

PREFIX = "BB"


def in_order_of_codes(kinds: Iterable[DiagnosisKind]) -> dict[str, DiagnosisKind]:
    """Return kinds by their codes, ordered by number: BB099 before BB100 before BB1000."""
    return {kind.code: kind for kind in sorted(kinds, key=lambda kind: int(kind.code.removeprefix(PREFIX)))}


KINDS: Mapping[str, DiagnosisKind] = in_order_of_codes(
    (
        *TEXT_KINDS,
        *SPEC_KINDS,
        *BEHAVIOR_KINDS,
        *DESIGN_KINDS,
        *EXPRESSION_KINDS,
        *OUTSIDE_KINDS,
        *LIST_KINDS,
        *ENVIRONMENT_KINDS,
        *WORD_KINDS,
        *WARNING_KINDS,
    )
)


def describe(code: str) -> DiagnosisKind:
    """Return the kind of a code, written in either case; raises KeyError if there is no such code."""
    return KINDS[code.upper()]


def severity_of(code: str) -> Severity:
    """Return the severity of a code's kind; a code that the catalog does not have is a mistake."""
    kind = KINDS.get(code)
    return kind.severity if kind else Severity.MISTAKE
