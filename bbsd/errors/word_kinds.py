"""Mistakes of words that name something else, or that are another tool's."""

from __future__ import annotations

from bbsd.errors.kind import DiagnosisKind

WORD_KINDS: tuple[DiagnosisKind, ...] = (
    DiagnosisKind(
        code="BB138",
        title="a cost, where everything is maximized",
        explanation=(
            "What is good is written under reward, as terms that are summed at each step, and a design is always "
            "searched for that earns as much as it can. What should be small is a term with a minus."
        ),
        example="minimize: abs(height - 3)",
        mend="reward:\n  distance: -abs(height - 3)",
    ),
)
