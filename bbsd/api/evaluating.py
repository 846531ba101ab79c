"""Evaluate a design."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from bbsd.api.given.arguments import Assignments, checked, optional, require_none, whole
from bbsd.architecture import given_architecture
from bbsd.compiler.problem import DEFAULT_LANES
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.errors import UsageError
from bbsd.evaluation import (
    Evaluation,
    agents_of,
    detailed_outcomes,
    enumerate_starts,
    evaluation,
    evaluation_key,
    evaluation_keys,
    from_the_top,
    weighted_evaluation,
)
from bbsd.kernel.keys import own_keys
from bbsd.kernel.streams import fold, name_word
from bbsd.solver.judgement import RANDOM_AGENTS, RANDOM_EPISODES
from bbsd.solver.random_agents import random_agents

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path
    from typing import Any

    from bbsd.compiler import DetailedOutcome, Problem
    from bbsd.environments.importing.modules import Announce
    from bbsd.evaluation import Agents
    from bbsd.evaluation.episodes import Keys
from bbsd.api.compiling import located_reward_errors
from bbsd.api.given.environments import opened_environment, problem_of
from bbsd.api.specs import EPISODES_OF_DESIGN, AnySpec, loaded_from


class NoSingleEpisodes(UsageError):
    """What single episodes brought is wanted of an evaluation that runs none."""

    advice = "leave out --exact, or what is wanted of single episodes"


EPISODES_OF_RANDOM_AGENT = RANDOM_EPISODES
"""Episodes of each random agent by default, as after a design."""


@checked(episodes=optional(whole(1)))
def evaluate(
    spec: AnySpec,
    *,
    episodes: int | None = None,
    seed: int = 0,
    fill: Literal["random"] | None = None,
    agents: int = RANDOM_AGENTS,
    exact: bool = False,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    set: Assignments = (),
    progress: Callable[[int, int], None] | None = None,
    keep_each: bool = False,
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    announce: Announce | None = None,
    by_table: bool = True,
    note: Callable[[str], object] | None = None,
) -> Evaluation:
    """Run episodes of a spec's design and return their statistics.

    Args:
        spec: A spec without holes, unless `fill` is given.
        episodes: Number of episodes; by default 1000 for a design and 10 for each random agent. Designs that are
            evaluated with the same seed face the same episodes.
        seed: Seed of the episodes, and of the draws in constants.
        fill: "random" fills the holes at random, once for each of `agents` agents; each has episodes of its own.
        agents: Number of random agents.
        exact: Run each possible start once, weighted by its probability, instead of random episodes. Where the
            environment is stepped by its table of transitions, all that chance may do is weighted so, and the
            optimum is given beside.
        lanes: Episodes that a kernel runs side by side; affects only the speed.
        jobs: Threads to use; affects only the speed.
        set: Values that replace those of the spec.
        progress: Called from time to time with the numbers of finished and of all episodes.
        keep_each: Keep what each episode brought, as `each`.
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
        SpecError: with all mistakes of the spec, or if a reward is not finite.
        HolesLeft: the spec has holes.
        NotEnumerable: `exact`, but the starts cannot be enumerated.
        NoSingleEpisodes: `exact` by a table of transitions, and `keep_each`.
        ImportNotAllowed: the spec's environment needs a module that was not allowed.
        EnvironmentFailed, EnvironmentHangs, ActionRefused: what the environment did wrong, or was told wrong.
    """
    if fill is not None:
        require_none(_given(exact=exact), "beside fill, which needs many agents instead of all starts")
    else:
        require_none(_given(agents=agents != RANDOM_AGENTS), 'without fill="random"')
    if exact:
        require_none(_given(episodes=episodes), "beside exact, which runs each possible start once")
    loaded = loaded_from(spec, seed, set)
    opened = opened_environment(
        loaded, allow_import, import_from, environment, step_limit, announce, by_table, note
    )
    problem = problem_of(loaded, opened, lanes=lanes, jobs=jobs)
    generation = loaded.spec.design.coevolution.generations
    key = evaluation_key(seed)
    with located_reward_errors(loaded):
        if fill == "random":
            fillings = random_agents(problem, fold(key, name_word("agents")), agents)
            streams = own_keys(key, agents, episodes or EPISODES_OF_RANDOM_AGENT)
            outcomes = _reported(problem, fillings, streams, generation, progress)
            return evaluation(problem, outcomes, agents, keep_each=keep_each)
        architecture = given_architecture(problem)
        agent = agents_of([architecture])
        structure = [problem.names[behavior] for behavior in reversed(architecture.structure.tolist())]
        if exact and problem.table is not None:
            if keep_each:
                raise NoSingleEpisodes(
                    "an exact mean by a table of transitions comes from no single episodes"
                )
            from bbsd.evaluation.exact.tables import exact_evaluation

            return from_the_top(exact_evaluation(problem, problem.table, architecture, generation), structure)
        if exact:
            problem, weights = enumerate_starts(problem)
            starts = np.arange(len(weights), dtype=np.uint64)
            outcomes = _reported(problem, agent, starts, generation, progress)
            measured = weighted_evaluation(problem, outcomes, weights, keep_each=keep_each)
            return from_the_top(measured, structure)
        streams = evaluation_keys(seed, episodes or EPISODES_OF_DESIGN)
        outcomes = _reported(problem, agent, streams, generation, progress)
        return from_the_top(evaluation(problem, outcomes, 1, keep_each=keep_each), structure)


def _given(**arguments: object) -> list[str]:
    """Return the names of arguments that are given: neither None nor False."""
    return [name for name, value in arguments.items() if value not in (None, False)]


def _reported(
    problem: Problem,
    agents: Agents,
    streams: Keys,
    generation: int,
    progress: Callable[[int, int], None] | None,
) -> Iterator[DetailedOutcome]:
    """Run the episodes of agents and yield their outcomes batch by batch, reporting each batch to `progress`."""
    done, total = 0, len(agents) * streams.shape[-1]
    for outcome in detailed_outcomes(problem, agents, streams, generation):
        done += len(outcome.returns)
        if progress is not None:
            progress(done, total)
        yield outcome
