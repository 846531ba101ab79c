"""Trace an episode of a design, without a compiler where it is chosen by its number."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.api.compiling import located_reward_errors
from bbsd.api.given.arguments import Assignments, checked, optional, require_none, whole
from bbsd.api.given.environments import opened_environment, problem_of
from bbsd.api.specs import EPISODES_OF_DESIGN, AnySpec, loaded_from
from bbsd.architecture import given_architecture
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.evaluation import (
    NoSuchEpisode,
    Trace,
    agents_of,
    chosen_episode,
    episode_key,
    evaluation_keys,
    returns_of,
)
from bbsd.evaluation import trace as trace_episode

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path
    from typing import Any

    import numpy as np
    from numpy.typing import NDArray

    from bbsd.environments.importing.modules import Announce
    from bbsd.environments.opening import Opened
    from bbsd.evaluation import Rank
    from bbsd.language.loading import Loaded


@checked(episodes=optional(whole(1)))
def trace(
    spec: AnySpec,
    *,
    seed: int = 0,
    episode: int | Rank = 0,
    episodes: int | None = None,
    set: Assignments = (),
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    announce: Announce | None = None,
    by_table: bool = True,
    note: Callable[[str], object] | None = None,
) -> Trace:
    """Run one of the episodes of `evaluate`, and return all values of each step.

    Args:
        spec: A spec without holes.
        seed: As in `evaluate`.
        episode: Its number from 0, or "worst", "median" or "best" of the first `episodes`.
        episodes: How many episodes to choose from, where it is not a number; by default 1000.
        set: Values that replace those of the spec.
        allow_import: Modules that the spec's environment may import, with all below them, besides those of the user's
            configuration file. A spec whose world is its own imports nothing.
        import_from: Folders in which modules are looked for, after the installed environment.
        environment: A class in hand that is the spec's environment; nothing is imported for it.
        step_limit: Seconds that a step or a reset of the environment may take.
        announce: Called with each module and its file before it is imported.
        by_table: Step the environment by its table of transitions, if it has one (`P`, as Taxi), and real steps agree
            with it: hundreds of times as fast. What is drawn is drawn from the keys of episodes then.
        note: Called with a sentence on that, if it has one.

    Raises:
        SpecError: with all mistakes of the spec.
        HolesLeft: the spec has holes.
        NoSuchEpisode: the number is negative.
        ImportNotAllowed: the spec's environment needs a module that was not allowed.
        EnvironmentFailed, EnvironmentHangs, ActionRefused: what the environment did wrong, or was told wrong.
    """
    if not isinstance(episode, str):
        require_none([] if episodes is None else ["episodes"], "beside the number of an episode")
    loaded = loaded_from(spec, seed, set)
    opened = opened_environment(
        loaded, allow_import, import_from, environment, step_limit, announce, by_table, note
    )
    number = episode_number(
        loaded, episode, episodes=episodes or EPISODES_OF_DESIGN, seed=seed, opened=opened
    )
    return traced(loaded, opened, number, seed)


def traced(loaded: Loaded, opened: Opened | None, number: int, seed: int) -> Trace:
    """Run an episode of `evaluate` by its number, as plain Python, and return all values of each step."""
    problem = problem_of(loaded, opened, compiled=False)
    key = episode_key(seed, number)
    return trace_episode(
        problem, given_architecture(problem), key, loaded.spec.design.coevolution.generations
    )


def episode_number(
    loaded: Loaded,
    which: int | Rank,
    *,
    episodes: int = EPISODES_OF_DESIGN,
    seed: int = 0,
    opened: Opened | None = None,
) -> int:
    """Return the number of an episode of `evaluate`: a given one, or the worst, median or best of the first.

    Raises:
        SpecError: a reward is not finite.
        HolesLeft: the spec has holes.
        NoSuchEpisode: the number is negative.
    """
    if not isinstance(which, int):
        return chosen_episode(episode_returns(loaded, episodes, seed, opened), which)
    if which < 0:
        raise NoSuchEpisode(f"there is no episode {which}")
    return which


def episode_returns(
    loaded: Loaded, episodes: int = EPISODES_OF_DESIGN, seed: int = 0, opened: Opened | None = None
) -> NDArray[np.float64]:
    """Return the returns (n_episodes,) of the first episodes of `evaluate`.

    Raises:
        SpecError: a reward is not finite.
        HolesLeft: the spec has holes.
    """
    problem = problem_of(loaded, opened)
    agent = agents_of([given_architecture(problem)])
    streams = evaluation_keys(seed, episodes)
    with located_reward_errors(loaded):
        return returns_of(problem, agent, streams, loaded.spec.design.coevolution.generations).ravel()
