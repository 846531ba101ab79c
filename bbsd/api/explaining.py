"""Explain a design: what it does, from its tables and what its run has kept, without a compiler."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.api.given.arguments import Assignments, checked, whole
from bbsd.api.given.sources import run_of
from bbsd.api.results import Designed
from bbsd.api.specs import EPISODES_OF_DESIGN, AnySpec, loaded_from
from bbsd.architecture import HolesLeft, architecture_of, holes_of
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.explanation import Explanation, explain_architecture
from bbsd.runs.storage.visits import read_visits

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path
    from typing import Any

    from bbsd.architecture import Architecture
    from bbsd.architecture.visits import Visits
    from bbsd.environments.importing.modules import Announce
    from bbsd.environments.opening import Opened
    from bbsd.language.loading import Loaded


class NothingToExplain(HolesLeft):
    """A spec with holes, of which nothing is decided yet."""

    advice = "have it designed: bbsd design, then bbsd explain FOLDER"


@checked(episodes=whole(0))
def explain(
    spec: AnySpec,
    *,
    seed: int = 0,
    episodes: int = 0,
    worth: bool = False,
    set: Assignments = (),
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    announce: Announce | None = None,
    by_table: bool = True,
    note: Callable[[str], object] | None = None,
) -> Explanation:
    """Describe in words what the design of a spec does, layer by layer.

    Of a run, it uses what the run has kept of how often each cell was asked.

    Args:
        spec: A design: a spec without holes.
        seed: Seed of the draws in constants, and of the episodes.
        episodes: Count anew, in so many episodes, how often each cell is asked.
        worth: Also measure, in 1,000 or so many episodes, what the design would earn without what seems useless.
        set: Values that replace those of the spec.
        allow_import: Modules that the spec's environment may import for episodes, with all below them, besides those of
            the user's configuration file. A spec whose world is its own imports nothing.
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
        ImportNotAllowed: the spec's environment needs a module that was not allowed.
        EnvironmentFailed, EnvironmentHangs, ActionRefused: what the environment did wrong, or was told wrong.
    """
    loaded = loaded_from(spec, seed, set)
    if holes := holes_of(loaded.meaning):
        raise NothingToExplain(f"there is nothing to explain yet: the spec has holes ({'; '.join(holes)})")
    architecture, opened = architecture_of(loaded.meaning), None
    visits = None if episodes or set else _kept(spec, loaded, architecture)
    if episodes or worth:
        from bbsd.api.given.environments import opened_environment

        opened = opened_environment(
            loaded, allow_import, import_from, environment, step_limit, announce, by_table, note
        )
        counted = episodes or (EPISODES_OF_DESIGN if visits is None else 0)
        visits = _counted(loaded, opened, architecture, seed, counted) if counted else visits
    explanation = explain_architecture(loaded.meaning, architecture, visits)
    if not worth:
        return explanation
    return _with_worth(loaded, opened, architecture, explanation, seed, episodes or EPISODES_OF_DESIGN)


def _with_worth(
    loaded: Loaded,
    opened: Opened | None,
    architecture: Architecture,
    explanation: Explanation,
    seed: int,
    episodes: int,
) -> Explanation:
    """Return the explanation with what the design would earn without what seems useless."""
    from bbsd.api.compiling import located_reward_errors
    from bbsd.api.given.environments import problem_of
    from bbsd.evaluation import evaluation_keys
    from bbsd.explanation.worth.without import with_worth

    generation = loaded.spec.design.coevolution.generations
    problem, keys = problem_of(loaded, opened), evaluation_keys(seed, episodes)
    with located_reward_errors(loaded):
        useless = with_worth(problem, architecture, explanation.useless, keys, generation)
    return replace(explanation, useless=useless)


def _kept(spec: AnySpec, loaded: Loaded, architecture: Architecture) -> Visits | None:
    """Return the visits that a run has kept; None where there are none."""
    if isinstance(spec, Designed):
        return spec.visits
    folder = run_of(spec)
    if folder is None:
        return None
    cells = [len(table) for table in architecture.tables]
    return read_visits(folder, dict(zip(loaded.spec.behaviors, cells, strict=True)))


def _counted(
    loaded: Loaded, opened: Opened | None, architecture: Architecture, seed: int, episodes: int
) -> Visits:
    from bbsd.api.compiling import located_reward_errors
    from bbsd.evaluation.visits import visits_of

    stepper, table = (None, None) if opened is None else (opened.stepper, opened.table)
    with located_reward_errors(loaded):
        return visits_of(loaded.meaning, architecture, seed, episodes, stepper, table)
