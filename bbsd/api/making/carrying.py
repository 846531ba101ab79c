"""Carry out a design: its runs, the judgement of their answers, what is kept, its rivals."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any, NamedTuple

from bbsd.api.making.interrupting import interruptible
from bbsd.api.results import AnyProgress, Designed, Interrupted, Progress, SearchProgress
from bbsd.architecture import designed_text, tidy_tables
from bbsd.evaluation.visits import visits_after_design
from bbsd.runs.outcome.endings import endings
from bbsd.runs.outcome.joint_policy import joint_policy_returns
from bbsd.runs.outcome.visits import unvisited
from bbsd.runs.rival_command import paper_episodes
from bbsd.runs.rivals import each_run, rival, spent
from bbsd.runs.searching import ANSWER
from bbsd.runs.storage.folder import DIGEST, digest_of
from bbsd.runs.storage.visits import write_visits
from bbsd.runs.workers.answers import complete_runs
from bbsd.solver.judgement import judge

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from bbsd.api.making.stopwatch import Stopwatch
    from bbsd.engines.engine import Engine
    from bbsd.environments.opening import Opened
    from bbsd.language.loading import Loaded
    from bbsd.runs.command import Command
    from bbsd.runs.rivals import Rival
    from bbsd.runs.storage.folder import Folder
    from bbsd.solver.judgement import Selection


class Kept(NamedTuple):
    """What a design is of, and whether it is kept."""

    loaded: Loaded
    fickle: str | None
    """Why an environment in Python does not repeat its episodes, '' where it does; None without one."""
    is_written: bool
    """Whether its folder stays."""


class Means(NamedTuple):
    """By what a design is carried out, and who is told of it; nothing of it changes what comes out."""

    jobs: int
    engine: Engine | None
    progress: Callable[[AnyProgress], None] | None
    overdue: Callable[[Interrupted], object] | None
    rivals: Sequence[str]


def carried_out(command: Command, kept: Kept, means: Means, stopwatch: Stopwatch) -> Designed:
    """Carry out a command, whose folder is locked, and return its result.

    Args:
        command: the runs.
        kept: what it is of.
        means: by what, and who is told.
        stopwatch: measures since it began.

    Raises:
        Interrupted: it was interrupted.
        RunsLost, FolderError, SpecError: as `design`.
    """
    problem, settings, seed, folder = command.problem, command.settings, command.seed, command.folder
    listener = means.progress and metrics_listener(command, means.progress)
    with interruptible(command, kept.loaded, means.overdue, keep_best=True, is_kept=kept.is_written):
        answers = complete_runs(command, means.jobs, listener, means.engine)
        judged = judge(answers, problem, settings, seed)
        missed = unvisited(command)
        designed = tidy_tables(problem.meaning, judged.architecture)
        visits = visits_after_design(problem, designed, seed, has_kernel=settings.method != "paper")
    folder.gather(command.n_runs)
    text = designed_text(kept.loaded, designed)
    folder.write_architecture(text)
    write_visits(folder.path, text, problem.names, visits)
    names = tuple(problem.names[behavior] for behavior in reversed(judged.architecture.structure))
    early = endings(command)
    result = {
        "structure": names,
        "return": asdict(judged.evaluation.returns),
        **({"ended": [each.plain() for each in early]} if early else {}),
        DIGEST: digest_of(text),
    }
    beginnings = () if command.origin is None else command.origin.beginnings
    overrides = kept.loaded.overrides
    folder.write_run_file(command.who, overrides, command.budgets, result, kept.fickle, beginnings)
    with interruptible(command, kept.loaded, means.overdue, keep_best=False, is_kept=kept.is_written):
        others = tuple(_rival(command, name, kept.loaded, means) for name in means.rivals)
    seconds, compile_seconds = stopwatch.read()
    # What follows reads the runs again, and mends them where it must: nobody else may write yet.
    return Designed(
        name=kept.loaded.spec.name,
        text=text,
        written=folder.path if kept.is_written else None,
        metrics=tuple(folder.lines()),
        visits=visits,
        method=settings.method,
        structure=names,
        evaluation=judged.evaluation,
        lifetime=judged.lifetime,
        random=judged.random,
        seconds=seconds,
        compile_seconds=compile_seconds,
        selection=judged.selection,
        spent=spent(command),
        each=each_run(command, answers) if command.n_runs > 1 else (),
        rivals=others,
        first_reward=_first_reward(folder, judged.selection),
        unvisited=missed,
        ended=early,
        joint=joint_policy_returns(command),
        not_reproducible=kept.fickle or "",
    )


def _rival(command: Command, name: str, loaded: Loaded, means: Means) -> Rival:
    elsewhere = None if means.engine is None or means.engine.shares_machine else means.engine
    listener = means.progress and metrics_listener(command, means.progress, name)
    return rival(command, name, loaded, means.jobs, listener, elsewhere)


def why_fickle(opened: Opened, loaded: Loaded) -> str:
    """Return why an environment's episodes cannot be repeated; '' where they can, as far as a self-check shows."""
    from bbsd.engines.processes import waiting_processes
    from bbsd.environments.for_spec import settings
    from bbsd.environments.self_check import self_check

    if opened.table is not None:
        return ""
    if opened.recipe.given is not None and not opened.recipe.is_portable:
        return self_check(opened, settings(loaded.meaning))
    with waiting_processes(1, ("bbsd.environments.self_check",)) as processes:
        return self_check(opened, settings(loaded.meaning), processes.submit)


def _first_reward(folder: Folder, selection: Selection) -> int | None:
    """Return the episodes after which a search had a design that earns something else than all random agents."""
    if selection.alike is None:
        return None
    lines = folder.lines()
    return min(
        (line["episodes"] for line in lines if "episodes" in line and line["mean"] != selection.alike),
        default=None,
    )


def metrics_listener(
    command: Command, progress: Callable[[AnyProgress], None], rival_name: str = ""
) -> Callable[[dict[str, Any]], None]:
    """Return a function that reports the metrics of a generation as progress."""

    def report(line: dict[str, Any]) -> None:
        run, runs = line["run"], command.n_runs
        if "generation" in line:
            fitness = (line["mean"], line["best"], line["lifetime"])
            generations = command.settings.coevolution.generations
            progress(Progress(run, runs, line["generation"], generations, *fitness))
        else:
            best = (line["mean"], line["measured"], line["stage"] == ANSWER)
            budget = sum(command.budgets) or paper_episodes(command.settings)
            progress(SearchProgress(run, runs, line["episodes"], budget, *best, rival_name))

    return report
