"""Mistakes of words that name something else, or that are another tool's."""

from __future__ import annotations

from bbsd.errors.kinds.kind import DiagnosisKind

WORD_KINDS: tuple[DiagnosisKind, ...] = (
    DiagnosisKind(
        code="BB131",
        title="a value that starts as another kind than it is",
        explanation=(
            "What state or world is at the start says whether it is a number or a truth, and so it stays. A value that "
            "starts as 0 or 1 and is a truth wherever it is set, or used, starts as false or true; and the reverse."
        ),
        example=(
            "environment:\n  state:\n    late: 0\n  dynamics:\n    late: step > 5\n"
            "reward:\n  late: -1 if late else 0"
        ),
        mend=(
            "environment:\n  state:\n    late: false\n  dynamics:\n    late: step > 5\n"
            "reward:\n  late: -1 if late else 0"
        ),
    ),
    DiagnosisKind(
        code="BB136",
        title="values of a state that cannot be read",
        explanation=(
            "A state, or a value of the world, may be one of several names: one of [idle, search, home], two or more, "
            "each once. It begins with the first one, or as starting says: an expression, or at random. The names are "
            "of the kind that expressions can use; for whole numbers a state needs no names."
        ),
        example="environment:\n  state:\n    mode: one of [1, 2, 3]",
        mend="environment:\n  state:\n    mode: one of [idle, search, home]",
    ),
    DiagnosisKind(
        code="BB137",
        title="not one of a state's values",
        explanation=(
            "What a state that is one of several names is compared with, or set to, must be one of these names, or "
            "another value of the same names in the same order. A name that several states have means the one of the "
            "state that it is compared with, or set for."
        ),
        example="environment:\n  state:\n    mode: one of [idle, search]\nreward:\n  busy: 1 if mode == serach else 0",
        mend="environment:\n  state:\n    mode: one of [idle, search]\nreward:\n  busy: 1 if mode == search else 0",
    ),
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
    DiagnosisKind(
        code="BB139",
        title="a named value where it has no meaning",
        explanation=(
            "Values with names are no numbers: they have no order and no sum, and are only set, and compared by == and "
            "!= with values of the same names. 1 if mode == idle else 0 makes a number of one."
        ),
        example="environment:\n  state:\n    mode: one of [idle, search]\nreward:\n  busy: mode + 1",
        mend="environment:\n  state:\n    mode: one of [idle, search]\nreward:\n  busy: 1 if mode == search else 0",
    ),
)
