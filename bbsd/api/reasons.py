"""Say why a robot did what it did."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.api.given.arguments import Assignments, checked, require_none
from bbsd.api.specs import AnySpec, loaded_from
from bbsd.architecture import architecture_of
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.errors import UsageError
from bbsd.explanation.why import Answer, answer_of, described_situation, situation_in

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path
    from typing import Any

    from bbsd.environments.importing.modules import Announce
    from bbsd.evaluation import Rank
    from bbsd.explanation.why.described import Given


class NoMoment(UsageError):
    """A why without a step, or with both a step and a described situation."""

    advice = (
        "bbsd why --step 10 asks about step 10 of robot 0 in episode 0 (others by --robot and --episode); "
        "or describe a situation with --at NAME=VALUE"
    )


@checked()
def why(
    spec: AnySpec,
    *,
    episode: int | Rank = 0,
    step: int | None = None,
    robot: int = 0,
    at: Mapping[str, Given] | None = None,
    unwanted: Sequence[str] = (),
    wanted: Sequence[str] = (),
    seed: int = 0,
    set: Assignments = (),
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    announce: Announce | None = None,
    by_table: bool = True,
    note: Callable[[str], object] | None = None,
) -> Answer:
    """Return why a robot did what it did: what each layer perceived and wanted, and which one controlled.

    Args:
        spec: A spec without holes, or the folder of a run.
        episode: An episode of `evaluate`, by its number from 0, or "worst", "median" or "best".
        step: The step in it, from 1.
        robot: The robot, from 0.
        at: Instead of a step, the values of state, world, sensors by name, for all robots or a list with one for each.
        unwanted: Actions or behaviors; for each, what would have had to be different for it not to control.
        wanted: Actions or behaviors; for each, what would have had to be different for it to control.
        seed: As in `evaluate`.
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
        NoMoment: neither a step nor a situation is given, or both are.
        NoSuchMoment: the episode has no such step, or the team no such robot.
        BadSituation: a value is unknown, of a wrong form, or missing.
        NoSuchAction: a name stands for nothing.
        AsItWas: what is unwanted did not control, or what is wanted did.
        ImportNotAllowed: the spec's environment needs a module that was not allowed.
        EnvironmentFailed, EnvironmentHangs, ActionRefused: what the environment did wrong, or was told wrong.
    """
    loaded = loaded_from(spec, seed, set)
    if (step is None) is (not at):
        raise NoMoment("a step of an episode or a situation is needed" if step is None else "both are given")
    if step is None:
        require_none(["episode"] if episode != 0 else [], "without a step of it")
    architecture = architecture_of(loaded.meaning)
    number = None
    if step is None:
        generation = loaded.spec.design.coevolution.generations
        situation = described_situation(loaded.meaning, at or {}, robot, generation)
    else:
        # A described situation needs no compiler.
        from bbsd.api.given.environments import opened_environment
        from bbsd.api.tracing import episode_number, traced

        opened = opened_environment(
            loaded, allow_import, import_from, environment, step_limit, announce, by_table, note
        )
        number = episode_number(loaded, episode, seed=seed, opened=opened)
        situation = situation_in(traced(loaded, opened, number, seed), step, robot)
    return answer_of(
        loaded.meaning,
        architecture,
        situation,
        robot,
        episode=number,
        step=step,
        unwanted=unwanted,
        wanted=wanted,
    )
