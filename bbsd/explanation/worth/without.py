"""What a design would earn without what seems useless in it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.evaluation import interval, paired_episodes
from bbsd.explanation.worth.findings import change_text
from bbsd.explanation.worth.rules import single_rules
from bbsd.explanation.worth.variants import Variants

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.explanation.words import Useless


def with_worth(
    problem: Problem,
    architecture: Architecture,
    useless: Sequence[Useless],
    keys: NDArray[np.uint64],
    generation: int,
) -> tuple[Useless, ...]:
    """Measure the change of the return without each behavior and rule that is useless as far as episodes tell.

    What the tables prove useless changes nothing, and is not measured; nor are inputs, which can be left out in many
    ways.

    Args:
        problem: the spec.
        architecture: the design.
        useless: parts of it.
        keys: name the random streams of the episodes, (n_episodes,).
        generation: in whose constants they run.

    Raises:
        RewardNotFinite: a reward of the design itself was infinite or not a number.
    """
    variants = Variants(architecture)
    numbers = [
        None if each.is_certain else _variant(problem, architecture, variants, each) for each in useless
    ]
    if not any(numbers):
        return tuple(useless)
    paired = paired_episodes(
        problem, variants.agents, keys, generation, labels=variants.labels, all_finite=False
    )
    returns = interval(paired.returns[0])
    return tuple(
        each if number is None else replace(each, worth=change_text(paired.difference(number), returns))
        for each, number in zip(useless, numbers, strict=True)
    )


def _variant(
    problem: Problem, architecture: Architecture, variants: Variants, useless: Useless
) -> int | None:
    """Add the design without a behavior or rule to the variants, and return its number; None for anything else."""
    behavior = problem.names.index(useless.behavior)
    label = f"without {useless.behavior}"
    if useless.kind == "behavior":
        return variants.without(behavior, label)
    if useless.number is None:
        return None
    module, table = problem.meaning.episode.modules[behavior], architecture.tables[behavior]
    rules = single_rules(module, table, problem.meaning.spec.behaviors[useless.behavior].rules or ())
    if useless.number > len(rules):
        return None
    return variants.with_table(
        behavior, rules[useless.number - 1].without, f"{label}'s rule {useless.number}"
    )
