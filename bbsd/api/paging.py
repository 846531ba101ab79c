"""Gather what a page on a design shows: how it is built, what it earns, and episodes to replay."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from bbsd.api.appraising import faults as degradations
from bbsd.api.appraising import worth
from bbsd.api.comparing import compare
from bbsd.api.evaluating import evaluate
from bbsd.api.explaining import explain
from bbsd.api.given.arguments import Assignments, checked
from bbsd.api.given.environments import opened_environment, problem_of
from bbsd.api.given.sources import is_path, name_of, path_of, run_of
from bbsd.api.specs import EPISODES_OF_DESIGN, AnySpec, load, loaded_from
from bbsd.api.tracing import traced
from bbsd.architecture import given_architecture
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.evaluation import chosen_episode
from bbsd.evaluation.choosing import RANKS
from bbsd.evaluation.faults import ALL, read_faults
from bbsd.evaluation.situations import TooLongToWatch
from bbsd.runs.storage.finished import RUN_FILE
from bbsd.runs.storage.folder import Folder

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.environments.importing.modules import Announce
    from bbsd.environments.opening import Opened
    from bbsd.evaluation import Evaluation, Interval, Rank, Trace
    from bbsd.evaluation.spread import EachEpisode
    from bbsd.explanation import Explanation
    from bbsd.explanation.comparison import Comparison
    from bbsd.explanation.faults import Degradations
    from bbsd.explanation.worth import Worth
    from bbsd.language.loading import Loaded

    Progress = Callable[[int, int], None]

FEWER_EPISODES = 200
"""Episodes at most of the worth of a design and of its faults: dozens of changes run them all."""
RANDOM_AGENTS = 200
"""Random agents beside the design of a run."""


@dataclass(frozen=True, slots=True, eq=False)
class Replay:
    """An episode to replay: which one it is, what it earned, and its trace."""

    rank: Rank
    number: int
    """The episode's number in the evaluation, from 0."""
    total: float
    """Its return."""
    trace: Trace


@dataclass(frozen=True, slots=True)
class Run:
    """The run that a design is from: what `run.json` says, its metrics and its spec."""

    content: dict[str, Any]
    metrics: list[dict[str, Any]]
    spec: Loaded
    random: Interval
    """The mean return of random agents of the run's spec."""


@dataclass(frozen=True, slots=True, eq=False)
class Page:
    """All that a page on a design shows."""

    name: str
    """The name of the design's file or folder."""
    loaded: Loaded
    architecture: Architecture
    explanation: Explanation
    evaluation: Evaluation
    returns: NDArray[np.float64]
    """The return of each episode of the evaluation, (n_episodes,)."""
    replays: tuple[Replay, ...]
    """The worst, the median and the best episode."""
    run: Run | None
    """The run that the design is from, None where it is a file."""
    worth: Worth | None
    """What each part is worth, None where an episode has too many steps to record who is excited."""
    faults: Degradations
    """What it earns with each behavior silent, and under the faults that were asked for."""
    comparison: Comparison | None
    """What another design does and earns beside this one, None where none was given."""
    other: str
    """The name of the other design's file or folder, '' without one."""
    seed: int
    overrides: tuple[str, ...]
    wanted_faults: tuple[str, ...]
    """The faults that were asked for, as they are written."""


@checked()
def page(
    design: AnySpec,
    other: AnySpec | None = None,
    *,
    seed: int = 0,
    episodes: int = EPISODES_OF_DESIGN,
    faults: Sequence[str] = (),
    set: Assignments = (),
    progress: Progress | None = None,
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    announce: Announce | None = None,
    by_table: bool = True,
    note: Callable[[str], object] | None = None,
) -> Page:
    """Gather what a page on a design shows; `bbsd.report.page.page_text` makes the page of it.

    Args:
        design: A spec without holes, or the folder of a run.
        other: Another design to compare it with.
        seed: Seed of the episodes, and of the draws in constants.
        episodes: Number of episodes of the evaluation, as in `evaluate`.
        faults: Texts such as "robot=1:dead", as in `bbsd.faults`; every behavior silent is always shown.
        set: Values that replace those of the spec.
        progress: Called from time to time with the part that is done, in percent, and 100.
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
        NoDesign: a folder that is no run, or a run without an answer.
        ImportNotAllowed: the spec's environment needs a module that was not allowed.
        EnvironmentFailed, EnvironmentHangs, ActionRefused: what the environment did wrong, or was told wrong.
    """
    loaded = loaded_from(design, seed, set)
    wanted = [ALL, *faults]
    read_faults(wanted, loaded.meaning)
    opened = opened_environment(
        loaded, allow_import, import_from, environment, step_limit, announce, by_table, note
    )
    opening: dict[str, Any] = {
        "allow_import": allow_import,
        "import_from": import_from,
        "environment": environment,
        "step_limit": step_limit,
        "announce": announce,
        "by_table": by_table,
        "note": note,
    }
    problem = problem_of(loaded, opened)
    architecture = given_architecture(problem)
    few = min(max(2, episodes), FEWER_EPISODES)
    measured = evaluate(
        loaded, episodes=episodes, seed=seed, keep_each=True, progress=_part(progress, 0, 20), **opening
    )
    earned = cast("EachEpisode", measured.each).returns
    return Page(
        name=_name(design),
        loaded=loaded,
        architecture=architecture,
        explanation=explain(loaded),
        evaluation=measured,
        returns=earned,
        replays=_replays(loaded, opened, earned, seed),
        run=_run(design, seed, opening),
        worth=_worth(loaded, seed, few, _part(progress, 20, 70), opening),
        faults=degradations(
            loaded, wanted, seed=seed, episodes=few, progress=_part(progress, 70, 100), **opening
        ),
        comparison=None
        if other is None
        else compare(loaded, loaded_from(other, seed, set), episodes=max(2, episodes), seed=seed, **opening),
        other="" if other is None else _name(other),
        seed=seed,
        overrides=loaded.overrides,
        wanted_faults=tuple(faults),
    )


def _part(progress: Progress | None, first: int, last: int) -> Progress | None:
    """Return what reports the progress of a part of the work, from a percentage of the whole to another one."""
    if progress is None:
        return None
    return lambda done, total: progress(first + (last - first) * done // max(total, 1), 100)


def _name(design: AnySpec) -> str:
    """Return the name of a design's file or folder; of one that is in neither, its own."""
    return Path(path_of(design)).resolve().name if is_path(design) else name_of(design)


def _replays(
    loaded: Loaded, opened: Opened | None, returns: NDArray[np.float64], seed: int
) -> tuple[Replay, ...]:
    """Run the worst, the median and the best episode as plain Python, and record everything."""
    numbers = {rank: chosen_episode(returns, rank) for rank in RANKS}
    return tuple(
        Replay(rank, number, float(returns[number]), traced(loaded, opened, number, seed))
        for rank, number in numbers.items()
    )


def _worth(
    loaded: Loaded, seed: int, episodes: int, progress: Progress | None, opening: Mapping[str, Any]
) -> Worth | None:
    try:
        return worth(loaded, episodes=episodes, seed=seed, progress=progress, **opening)
    except TooLongToWatch:
        return None


def _run(design: AnySpec, seed: int, opening: Mapping[str, Any]) -> Run | None:
    """Return the run that a folder holds."""
    path = run_of(design)
    if path is None or not (path / RUN_FILE).is_file() or (is_path(design) and not path_of(design).is_dir()):
        return None
    folder = Folder(path)
    made = folder.design()
    spec = load(made.spec, seed=made.seed, set=made.overrides)
    beside = evaluate(spec, seed=seed, fill="random", agents=RANDOM_AGENTS, **opening)
    return Run(folder.read_run_file(), folder.lines(), spec, beside.returns)
