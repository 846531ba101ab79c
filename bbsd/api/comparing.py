"""Compare two designs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.api.compiling import located_reward_errors
from bbsd.api.given.arguments import Assignments, checked, whole
from bbsd.api.given.environments import opened_environment, problem_of
from bbsd.api.specs import EPISODES_OF_DESIGN, AnySpec, loaded_from
from bbsd.architecture import HolesLeft, given_architecture
from bbsd.compiler.problem import DEFAULT_LANES
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.evaluation import evaluation_keys
from bbsd.explanation.comparison import Comparison, Design, compare_designs, earned_by

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path
    from typing import Any

    import numpy as np
    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.environments.importing.modules import Announce
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
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    announce: Announce | None = None,
    by_table: bool = True,
    note: Callable[[str], object] | None = None,
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
        allow_import: Modules that the specs' environments may import, with all below them, besides those of the user's
            configuration file. A spec whose world is its own imports nothing.
        import_from: Folders in which modules are looked for, after the installed environment.
        environment: A class in hand that is the environment of both; nothing is imported for it.
        step_limit: Seconds that a step or a reset of the environment may take.
        announce: Called with each module and its file before it is imported.
        by_table: Step the environment by its table of transitions, if it has one (`P`, as Taxi), and real steps agree
            with it: hundreds of times as fast. What is drawn is drawn from the keys of episodes then.
        note: Called with a sentence on that, if it has one.

    Raises:
        SpecError: with all mistakes of a spec, or if a reward is not finite.
        HolesLeft: a spec has holes.
        ImportNotAllowed: the spec's environment needs a module that was not allowed.
        EnvironmentFailed, EnvironmentHangs, ActionRefused: what the environment did wrong, or was told wrong.
    """
    designs = []
    for spec in (a, b):
        loaded = loaded_from(spec, seed, set)
        opened = opened_environment(
            loaded, allow_import, import_from, environment, step_limit, announce, by_table, note
        )
        designs.append(_design(loaded, problem_of(loaded, opened, lanes=lanes, jobs=jobs)))
    one, other = designs
    streams = evaluation_keys(seed, episodes)
    return compare_designs(one, other, streams, (_earned(one, streams), _earned(other, streams)))


def _earned(design: Design, streams: NDArray[np.uint64]) -> PairedEpisodes:
    with located_reward_errors(design.loaded):
        return earned_by(design, streams)


def _design(loaded: Loaded, problem: Problem) -> Design:
    try:
        return Design(loaded, problem, given_architecture(problem))
    except HolesLeft as error:
        raise HolesLeft(f"{loaded.source.file}: {error}") from None
