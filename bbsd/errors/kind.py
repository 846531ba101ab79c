"""What there is to say of one kind of mistake."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class DiagnosisKind:
    """A kind of mistake: its stable code, a few words, why it is one, a text that has it, the same mended."""

    code: str
    title: str
    explanation: str
    example: str
    mend: str
