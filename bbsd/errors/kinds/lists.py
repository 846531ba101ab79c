"""Kinds of mistakes in lists that are state or world, and in the keys of actions that set their elements."""

from __future__ import annotations

from bbsd.errors.kinds.kind import DiagnosisKind

LIST_KINDS = (
    DiagnosisKind(
        code="BB132",
        title="a list of another shape",
        explanation=(
            "State and world keep the shape that they start with: what sets a list as a whole is a list as long, of "
            "lists as long, and what sets a single value is a single value. Lengths are constant, so that a kernel "
            "knows where everything is."
        ),
        example=(
            "environment:\n  state:\n    waiting: list(0 for f in range(6))\n"
            "  dynamics:\n    waiting: list(waiting[f] + 1 for f in range(5))"
        ),
        mend=(
            "environment:\n  state:\n    waiting: list(0 for f in range(6))\n"
            "  dynamics:\n    waiting: list(waiting[f] + 1 for f in range(6))"
        ),
    ),
    DiagnosisKind(
        code="BB133",
        title="a list without a shape",
        explanation=(
            "A list that is state or world has one element or more, all numbers, all truths, or all lists of one "
            "length."
        ),
        example="environment:\n  state:\n    seen: list(list(0 for x in range(y + 1)) for y in range(3))",
        mend="environment:\n  state:\n    seen: list(list(0 for x in range(3)) for y in range(3))",
    ),
    DiagnosisKind(
        code="BB134",
        title="a key that is no element",
        explanation=(
            "In an action, name[index] sets one element of a state that is a list, with as many indices as there are "
            "lists in one another, or fewer to set a list in it. Indices count from 0; a computed one beyond the range "
            "means the nearest. Everything else is set as a whole, so that each name has one line that says "
            "what becomes of it."
        ),
        example=(
            "environment:\n  state:\n    waiting: list(0 for f in range(6))\n  dynamics:\n    waiting[2]: 0"
        ),
        mend=(
            "environment:\n  state:\n    waiting: list(0 for f in range(6))\n"
            "  dynamics:\n    waiting: list(0 if f == 2 else waiting[f] for f in range(6))"
        ),
    ),
    DiagnosisKind(
        code="BB135",
        title="an element that is set twice",
        explanation=(
            "An action sets each element once, or the list as a whole. Where two computed indices may happen "
            "to be the same, the assignment that is written later stays."
        ),
        example=(
            "environment:\n  state:\n    waiting: list(0 for f in range(6))\n"
            "behaviors:\n  stop:\n    actions:\n      halt:\n        waiting[1]: 0\n        waiting[2 - 1]: 3"
        ),
        mend=(
            "environment:\n  state:\n    waiting: list(0 for f in range(6))\n"
            "behaviors:\n  stop:\n    actions:\n      halt:\n        waiting[1]: 0\n        waiting[2]: 3"
        ),
    ),
    DiagnosisKind(
        code="BB172",
        title="a row of another length",
        explanation=(
            "A table is a list of rows. Where a row is chosen while episodes run, or the table is drawn as a grid, all "
            "rows are equally long. If one is shorter or longer than all others, it is told there."
        ),
        example="constants:\n  room: [[0, 0], [0], [0, 1]]\nenvironment:\n  definitions:\n    wall(row): room[row][0]\n"
        "reward:\n  clear: -wall(floor(height))",
        mend="constants:\n  room: [[0, 0], [0, 0], [0, 1]]\nenvironment:\n  definitions:\n    wall(row): room[row][0]\n"
        "reward:\n  clear: -wall(floor(height))",
    ),
)
