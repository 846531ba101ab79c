"""The kinds of warnings, from BB201 on: what can be used, but probably does not say what its author meant."""

from __future__ import annotations

from bbsd.errors.kind import DiagnosisKind, Severity


def _warning(code: str, title: str, explanation: str, example: str, mend: str) -> DiagnosisKind:
    return DiagnosisKind(code, title, explanation, example, mend, Severity.WARNING)


WARNING_KINDS = (
    _warning(
        code="BB201",
        title="a name that nothing uses",
        explanation=(
            "A constant, world, state, definition or sensor matters only where the reward, an end, a behavior, an "
            "expectation, the view or the design comes to use it, perhaps by way of other names. What is only computed "
            "from its own last value, or used by names that nothing uses, does not count. Often another name stands "
            "where this one was meant."
        ),
        example=(
            "constants:\n  goal: 3\nbehaviors:\n  stop:\n    inputs:\n      reached: height >= 3      # goal was meant"
        ),
        mend="constants:\n  goal: 3\nbehaviors:\n  stop:\n    inputs:\n      reached: height >= goal",
    ),
)
