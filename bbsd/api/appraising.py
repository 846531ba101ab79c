"""Say what the parts of a design are worth, and what it earns under faults."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.api.compiling import located_reward_errors
from bbsd.api.given.arguments import Assignments, checked, whole
from bbsd.api.given.environments import opened_environment, problem_of
from bbsd.api.specs import EPISODES_OF_DESIGN, AnySpec, loaded_from
from bbsd.architecture import given_architecture
from bbsd.compiler.problem import DEFAULT_LANES
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.evaluation import evaluation_key
from bbsd.evaluation.faults import read_faults
from bbsd.explanation.faults import Degradations, degradations
from bbsd.explanation.worth import Appraisal, Worth

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path
    from typing import Any

    from bbsd.environments.importing.modules import Announce


@checked(episodes=whole(2))
def worth(
    spec: AnySpec,
    *,
    episodes: int = EPISODES_OF_DESIGN,
    seed: int = 0,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    set: Assignments = (),
    progress: Callable[[int, int], None] | None = None,
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    announce: Announce | None = None,
    by_table: bool = True,
    note: Callable[[str], object] | None = None,
) -> Worth:
    """Say what the behaviors, layers and rules of a design are worth, and what stands out.

    The design and every change of it run the same episodes, those of `evaluate` with this seed.

    Args:
        spec: A spec without holes.
        episodes: Number of episodes, at least 2, of the design and of each change.
        seed: Seed of the episodes, and of the draws in constants.
        lanes: Episodes that a kernel runs side by side; affects only the speed.
        jobs: Threads to use; affects only the speed.
        set: Values that replace those of the spec.
        progress: Called with the numbers of parts done and of all.
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
        TooLongToWatch: an episode has too many steps to record who is excited.
        ImportNotAllowed: the spec's environment needs a module that was not allowed.
        EnvironmentFailed, EnvironmentHangs, ActionRefused: what the environment did wrong, or was told wrong.
    """
    loaded = loaded_from(spec, seed, set)
    opened = opened_environment(
        loaded, allow_import, import_from, environment, step_limit, announce, by_table, note
    )
    problem = problem_of(loaded, opened, lanes=lanes, jobs=jobs)
    generation = loaded.spec.design.coevolution.generations
    design = given_architecture(problem)
    with located_reward_errors(loaded):
        return Appraisal(problem, design, evaluation_key(seed), episodes, generation).worth(progress)


@checked(episodes=whole(2))
def faults(
    spec: AnySpec,
    faults: Sequence[str],
    *,
    episodes: int = EPISODES_OF_DESIGN,
    seed: int = 0,
    relearn: bool = False,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    set: Assignments = (),
    progress: Callable[[int, int], None] | None = None,
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    announce: Announce | None = None,
    by_table: bool = True,
    note: Callable[[str], object] | None = None,
) -> Degradations:
    """Say what a design earns undisturbed and under each fault alone, all in the episodes of `evaluate`.

    Args:
        spec: A spec without holes.
        faults: Texts such as "behavior=stop:silent", "behavior=stop:stuck@100", "sensor=tilt:noise(1.0)",
            "sensor=tilt:frozen@100", "sensor=tilt:lost", "robot=1:dead"; "all" stands for every behavior silent.
        episodes: Number of episodes, at least 2, undisturbed and under each fault.
        seed: Seed of the episodes, and of the draws in constants.
        relearn: Learn the order of the layers again around each fault, with the tables as they are.
        lanes: Episodes that a kernel runs side by side; affects only the speed.
        jobs: Threads to use; affects only the speed.
        set: Values that replace those of the spec.
        progress: Called with the numbers of faults done and of all.
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
        NoSuchFault: a fault is not understood, or of something that the spec does not have.
        ImportNotAllowed: the spec's environment needs a module that was not allowed.
        EnvironmentFailed, EnvironmentHangs, ActionRefused: what the environment did wrong, or was told wrong.
    """
    loaded = loaded_from(spec, seed, set)
    found = read_faults(faults, loaded.meaning)
    opened = opened_environment(
        loaded, allow_import, import_from, environment, step_limit, announce, by_table, note
    )
    problem = problem_of(loaded, opened, lanes=lanes, jobs=jobs)
    design, generation = given_architecture(problem), loaded.spec.design.coevolution.generations
    with located_reward_errors(loaded):
        return degradations(
            problem,
            design,
            found,
            evaluation_key(seed),
            episodes,
            generation,
            relearn=relearn,
            progress=progress,
        )
