"""The kinds of diagnoses: what the catalog says of each, and how severe it is."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Severity(StrEnum):
    """How severe a diagnosis is, by the word that texts, SARIF and GitHub use for it."""

    MISTAKE = "error"
    """The spec cannot be used before it is mended."""
    WARNING = "warning"
    """The spec can be used, but probably does not say what its author meant."""


@dataclass(frozen=True, slots=True)
class DiagnosisKind:
    """A kind of diagnosis: its stable code, its title, why it is reported, a text that has it, the same text mended."""

    code: str
    title: str
    explanation: str
    example: str
    mend: str
    severity: Severity = Severity.MISTAKE
