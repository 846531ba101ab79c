"""Compare two designs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.api.compiling import located_reward_errors
from bbsd.api.given.arguments import Assignments, checked, whole
from bbsd.api.specs import EPISODES_OF_DESIGN, AnySpec, loaded_from, require_own_world
from bbsd.architecture import HolesLeft, given_architecture
from bbsd.compiler import compile_meaning
from bbsd.compiler.problem import DEFAULT_LANES
from bbsd.evaluation import evaluation_keys
from bbsd.explanation.comparison import Comparison, Design, compare_designs, earned_by

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bbsd.evaluation import PairedEpisodes
    from bbsd.language.loading import Loaded


@checked(episodes=whole(2))
def compare(
    a: AnySpec,
    b: AnySpec,
    *,
    episodes: int = EPISODES_OF_DESIGN,
    seed: int = 0,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    set: Assignments = (),
) -> Comparison:
    """Say how a design B differs from a design A: in what it does, in its rules and order, and in what it earns.

    Args:
        a: A spec without holes.
        b: Another one. Behaviors are matched by their names.
        episodes: Number of episodes, at least 2; both run the same ones, which are those of `evaluate`.
        seed: Seed of the episodes, and of the draws in constants.
        lanes: Episodes that a kernel runs side by side; affects only the speed.
        jobs: Threads to use; affects only the speed.
        set: Values that replace those of both specs.

    Raises:
        SpecError: with all mistakes of a spec, or if a reward is not finite.
        HolesLeft: a spec has holes.
    """
    one, other = (_design(loaded_from(spec, seed, set), lanes, jobs) for spec in (a, b))
    streams = evaluation_keys(seed, episodes)
    return compare_designs(one, other, streams, (_earned(one, streams), _earned(other, streams)))


def _earned(design: Design, streams: NDArray[np.uint64]) -> PairedEpisodes:
    with located_reward_errors(design.loaded):
        return earned_by(design, streams)


def _design(loaded: Loaded, lanes: int, jobs: int) -> Design:
    require_own_world(loaded)
    problem = compile_meaning(loaded.meaning, lanes=lanes, jobs=jobs)
    try:
        return Design(loaded, problem, given_architecture(problem))
    except HolesLeft as error:
        raise HolesLeft(f"{loaded.source.file}: {error}") from None
