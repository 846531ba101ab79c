"""Say what the parts of a design are worth."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.api.compiling import located_reward_errors
from bbsd.api.specs import AnySpec, load
from bbsd.architecture import given_architecture
from bbsd.compiler import compile_meaning
from bbsd.compiler.problem import DEFAULT_LANES
from bbsd.evaluation import evaluation_key
from bbsd.explanation.worth import Appraisal, Worth

if TYPE_CHECKING:
    from collections.abc import Sequence

EPISODES = 1000
"""The number of episodes by default, as in `evaluate`."""


def worth(
    spec: AnySpec,
    *,
    episodes: int = EPISODES,
    seed: int = 0,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    overrides: Sequence[str] = (),
) -> Worth:
    """Say what the behaviors, layers and rules of a design are worth, and what stands out.

    The design and every change of it run the same episodes, those of `evaluate` with this seed.

    Args:
        spec: A spec without holes.
        episodes: Number of episodes, at least 2, of the design and of each change.
        seed: Seed of the episodes, and of the draws in constants.
        lanes: Episodes that a kernel runs side by side; affects only the speed.
        jobs: Threads to use; affects only the speed.
        overrides: Values that replace those of the spec.

    Raises:
        SpecError: with all mistakes of the spec, or if a reward is not finite.
        HolesLeft: the spec has holes.
        TooLongToWatch: an episode has too many steps to record who is excited.
        ValueError: fewer than two episodes, of which no interval can be told.
    """
    if episodes < 2:
        raise ValueError("the worth of a design needs two episodes at least")
    loaded = load(spec, seed=seed, overrides=overrides)
    problem = compile_meaning(loaded.meaning, lanes=lanes, jobs=jobs)
    generation = loaded.spec.design.coevolution.generations
    design = given_architecture(problem)
    with located_reward_errors(loaded):
        return Appraisal(problem, design, evaluation_key(seed), episodes, generation).worth()
