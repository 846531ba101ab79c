"""Kinds of mistakes in the block `design`: settings that cancel one another."""

from __future__ import annotations

from bbsd.errors.kinds.kind import DiagnosisKind

DESIGN_KINDS = (
    DiagnosisKind(
        code="BB070",
        title="a budget beside generations",
        explanation=(
            "The episodes of the paper's loop are given by its generations, or by a budget from which the "
            "generations follow; with both, one of the two would have no effect."
        ),
        example="design:\n  method: paper\n  budget: 300_000\n  coevolution:\n    generations: 50",
        mend="design:\n  method: paper\n  budget: 300_000",
    ),
    DiagnosisKind(
        code="BB071",
        title="a setting of learning without effect",
        explanation=(
            "Exploration tries random structures in the episodes of a lifetime before the last ones. It does "
            "nothing where there is no structure to learn, where all episodes are last ones, and in methods other than "
            "paper; nor does what becomes of an explored structure, or of what is outside of the present one."
        ),
        example="design:\n  method: random\n  learning:\n    exploration: 0.1",
        mend="design:\n  method: random",
    ),
    DiagnosisKind(
        code="BB126",
        title="settings that contradict one another",
        explanation=(
            "One setting of the paper's loop leaves another nothing to do: as many elites as a pool has individuals, "
            "fewer agents than individuals to try, more last episodes than a lifetime has, records of generations "
            "that never come."
        ),
        example="design:\n  coevolution:\n    population: 6\n    elites: 7",
        mend="design:\n  coevolution:\n    population: 6\n    elites: 1",
    ),
    DiagnosisKind(
        code="BB171",
        title="a reason to stop that never comes",
        explanation=(
            "stop.unimproved ends a run after so many episodes in which nothing better was found. Where a run has no "
            "more episodes than that, it ends by its budget before, and the setting has no effect."
        ),
        example="design:\n  budget: 100_000\n  stop:\n    unimproved: 200_000",
        mend="design:\n  budget: 100_000\n  stop:\n    unimproved: 30_000",
    ),
)
