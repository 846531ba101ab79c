"""Price what a design costs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bbsd.api.compiling import located_reward_errors
from bbsd.api.given.arguments import Assignments, checked
from bbsd.api.given.environments import opened_environment
from bbsd.api.making.designing import problem_with_holes
from bbsd.api.specs import AnySpec, loaded_from
from bbsd.compiler.problem import DEFAULT_LANES
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.language.loading import loaded_again
from bbsd.runs.pricing.price import Price
from bbsd.runs.pricing.price import price as price_of
from bbsd.solver.paper.settings import settings_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from bbsd.environments.importing.modules import Announce


@checked()
def price(
    spec: AnySpec,
    *,
    seed: int = 0,
    runs: int = 1,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    starting: float = 0.0,
    set: Assignments = (),
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    announce: Announce | None = None,
    by_table: bool = True,
    note: Callable[[str], object] | None = None,
) -> Price:
    """Estimate the time and memory of a `design` from a sample of its episodes; write nothing.

    Args:
        spec: A spec with holes.
        seed: Seed of the sample.
        runs: Number of runs.
        lanes: Episodes that a kernel runs side by side.
        jobs: Processes and threads of the design.
        starting: Seconds that the process needs before and after the design; they are added.
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
        SpecError: with all mistakes of the spec, or if a reward is not finite.
        NothingToDesign: the spec has no holes.
        ImportNotAllowed: the spec's environment needs a module that was not allowed.
        EnvironmentFailed, EnvironmentHangs, ActionRefused: what the environment did wrong, or was told wrong.
    """
    loaded = loaded_again(loaded_from(spec, seed, set), seed=seed)
    opened = opened_environment(
        loaded, allow_import, import_from, environment, step_limit, announce, by_table, note
    )
    problem = problem_with_holes(loaded, opened, lanes)
    with located_reward_errors(loaded):
        own_limit = None if opened is None else opened.making.most_steps
        return price_of(problem, settings_of(problem.meaning), seed, runs, jobs, starting, own_limit)
