"""Design a spec."""

from __future__ import annotations

import time
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bbsd.api.given.arguments import Assignments, checked, optional, path, require_none, whole
from bbsd.api.given.environments import opened_environment, problem_of
from bbsd.api.making.interrupting import interruptible
from bbsd.api.making.place import Wanted, former_of, place_of, require_former
from bbsd.api.making.rivals import known_rivals
from bbsd.api.results import (
    AnyProgress,
    Designed,
    Interrupted,
    NoBudget,
    NothingToDesign,
    Progress,
    SearchProgress,
)
from bbsd.api.specs import AnySpec, loaded_from
from bbsd.architecture import designed_text, require_writable, tidy_tables
from bbsd.compiler.problem import DEFAULT_LANES
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.evaluation.visits import visits_after_design
from bbsd.language.design import LEAST_BUDGET
from bbsd.language.loading import loaded_again
from bbsd.runs.answers import complete_runs
from bbsd.runs.command import Command
from bbsd.runs.joint_policy import joint_policy_returns
from bbsd.runs.origin import origin_of
from bbsd.runs.pace import budget_of
from bbsd.runs.rival_command import paper_episodes
from bbsd.runs.rivals import each_run, rival, spent
from bbsd.runs.searching import ANSWER
from bbsd.runs.storage.folder import DIGEST, digest_of
from bbsd.runs.storage.identity import identity
from bbsd.runs.storage.lock import only_writer
from bbsd.runs.storage.unused import remove_parts
from bbsd.runs.storage.visits import write_visits
from bbsd.runs.visits import unvisited
from bbsd.solver.budget import automatic_budget
from bbsd.solver.judgement import judge
from bbsd.solver.paper.settings import settings_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from bbsd.compiler import Problem
    from bbsd.engines.engine import Engine
    from bbsd.environments.importing.modules import Announce
    from bbsd.environments.opening import Opened
    from bbsd.language.loading import Loaded
    from bbsd.runs.storage.folder import Folder
    from bbsd.solver.judgement import Selection
    from bbsd.solver.paper.settings import Settings


@checked(more=optional(whole(LEAST_BUDGET)), below=optional(path))
def design(
    spec: AnySpec,
    *,
    seed: int = 0,
    runs: int = 1,
    out: str | Path | None = None,
    below: str | Path | None = None,
    resume: bool = False,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    set: Assignments = (),
    progress: Callable[[AnyProgress], None] | None = None,
    overdue: Callable[[Interrupted], object] | None = None,
    engine: Engine | None = None,
    more: int | None = None,
    within: float | None = None,
    rivals: Sequence[str] = (),
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    announce: Announce | None = None,
    by_table: bool = True,
    note: Callable[[str], object] | None = None,
) -> Designed:
    """Fill the holes of a spec; where a folder is named, write the design and its metrics into it.

    The same spec, `set`, seed and number of runs give the same bytes of `architecture.yaml` and `metrics.jsonl`,
    however often the design was stopped and resumed.

    Args:
        spec: A spec with holes; with `resume` or `more` also the folder of a run, or what `design` returned, which name
            the spec, the seed, the runs and what is set.
        seed: Seed of all random numbers, of draws in constants too, also where the spec is loaded already.
        runs: Number of independent runs; the best of their designs is kept.
        out: The folder to write, new or empty. By default nothing is written, and the result has everything.
        below: Instead of `out`, a folder in which a new one is made, named by the spec and the seed.
        resume: Continue the same design in `out`, by default in the newest folder in `below` (`runs`) that holds it.
        lanes: Episodes that a kernel runs side by side; affects only the speed.
        jobs: Processes for several runs, and threads within a run if there are more jobs than runs; affects only
            the speed.
        set: Values that replace those of the spec.
        progress: Called after each generation, or each time the best so far was measured.
        overdue: Called in another thread if the design does not stop soon after an interrupt. An interrupt takes
            effect after the episodes that are running. `overdue` may end the process, since all written files are
            complete.
        engine: Where runs are done that this process does not do itself; by default so many processes are started
            as are needed.
        more: Continue as by `resume`, with so many episodes of a further budget for each run; the same sequence of
            budgets gives the same bytes.
        within: Seconds of each run, instead of a budget in episodes; the result cannot be reproduced.
        rivals: Names of methods on which the same budget is spent too; what they achieve is reported beside.
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
        NothingToDesign: the spec has no holes, or is the folder of a run that is finished.
        BadArgument: an argument is none that can be honoured.
        NoBudget: `more` or `within` for the paper's loop.
        FolderInUse: another process writes in the folder.
        FolderError: the folder cannot be written, or not be resumed.
        RunsLost: four processes that did a run were killed, one after the other; the other runs are complete.
        Interrupted: the design was interrupted; `resume` continues it.
        ImportNotAllowed: the spec's environment needs a module that was not allowed.
        EnvironmentFailed, EnvironmentHangs, ActionRefused: what the environment did wrong, or was told wrong.
    """
    started = time.monotonic()
    resume = resume or more is not None
    former = former_of(spec, goes_on=resume)
    if former is not None:
        made = former.design()
        given = {
            "seed": (seed, 0),
            "runs": (runs, 1),
            "set": (set, ()),
            "out": (out, None),
            "below": (below, None),
        }
        require_former(
            former, **{name: value for name, (value, default) in given.items() if value != default}
        )
        spec, seed, runs, set, out = made.spec, made.seed, made.runs, made.overrides, former.path
    require_none(["below"] if None not in (below, out) else [], "beside out, the folder itself")
    require_none(["more"] if None not in (more, within) else [], "beside within")
    wanted = Wanted(None if out is None else Path(out), None if below is None else Path(below), resume)
    loaded = loaded_again(loaded_from(spec, seed, set), seed=seed)
    opened = opened_environment(
        loaded, allow_import, import_from, environment, step_limit, announce, by_table, note
    )
    problem = problem_with_holes(loaded, opened, lanes, jobs)
    settings = settings_of(problem.meaning)
    if settings.method == "paper" and (more is not None or within is not None):
        raise NoBudget("the paper's loop has generations, which cannot be continued or timed")
    known_rivals(rivals, settings.method)
    run_identity = identity(loaded, seed, runs, None if opened is None else opened.plain())
    with place_of(wanted, loaded, run_identity) as folder, only_writer(folder):
        remove_parts(folder.path)
        if not resume:
            folder.begin(loaded.lineage.flat.source.text)
        fickle = None if opened is None else _fickle(opened, loaded)
        budgets = _budgets(settings, problem, folder, more, within)
        if not resume or budgets != folder.budgets():
            folder.write_run_file(run_identity, loaded.overrides, budgets, folder.result() or None, fickle)
        command = Command(
            problem, settings, seed, runs, folder, run_identity, budgets, within, origin_of(loaded, opened)
        )
        listener = progress and _metrics_listener(command, progress)
        with interruptible(command, loaded, overdue, keep_best=True, is_kept=wanted.is_kept):
            answers = complete_runs(command, jobs, listener, engine)
            judged = judge(answers, problem, settings, seed)
            missed = unvisited(command)
            designed = tidy_tables(problem.meaning, judged.architecture)
            visits = visits_after_design(problem, designed, seed, has_kernel=settings.method != "paper")
        folder.gather(runs)
        text = designed_text(loaded, designed)
        folder.write_architecture(text)
        write_visits(folder.path, text, problem.names, visits)
        names = tuple(problem.names[behavior] for behavior in reversed(judged.architecture.structure))
        result = {"structure": names, "return": asdict(judged.evaluation.returns), DIGEST: digest_of(text)}
        folder.write_run_file(run_identity, loaded.overrides, budgets, result, fickle)
        elsewhere = None if engine is None or engine.shares_machine else engine
        with interruptible(command, loaded, overdue, keep_best=False, is_kept=wanted.is_kept):
            others = tuple(
                rival(
                    command,
                    name,
                    loaded,
                    jobs,
                    progress and _metrics_listener(command, progress, name),
                    elsewhere,
                )
                for name in rivals
            )
        # What follows reads the runs again, and mends them where it must: nobody else may write yet.
        seconds = time.monotonic() - started
        return Designed(
            loaded.spec.name,
            text,
            folder.path if wanted.is_kept else None,
            tuple(folder.lines()),
            visits,
            settings.method,
            names,
            judged.evaluation,
            judged.lifetime,
            judged.random,
            seconds,
            judged.selection,
            spent(command),
            each_run(command, answers) if runs > 1 else (),
            others,
            _first_reward(folder, judged.selection),
            missed,
            joint_policy_returns(command),
            fickle or "",
        )


def _fickle(opened: Opened, loaded: Loaded) -> str:
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


def _budgets(
    settings: Settings, problem: Problem, folder: Folder, more: int | None, within: float | None
) -> tuple[int, ...]:
    """Return the budgets of each run: those that the folder names, and what is wanted beyond them."""
    if settings.method == "paper":
        return ()
    former = folder.budgets()
    wanted = sum(former)
    if within is None:
        wanted = settings.budget or wanted or automatic_budget(problem)
    elif not former:
        wanted = budget_of(within, problem, settings)
    further = [wanted - sum(former), more or 0]
    return (*former, *(budget for budget in further if budget > 0))


def problem_with_holes(loaded: Loaded, opened: Opened | None, lanes: int, jobs: int = 1) -> Problem:
    """Return the problem of a spec.

    Raises:
        NothingToDesign: it has no holes.
        SpecError: its design could not be written into its text.
    """
    problem = problem_of(loaded, opened, lanes=lanes, jobs=jobs)
    if not problem.has_holes:
        raise NothingToDesign(f"{loaded.source.file} has no holes: every cell and every layer is given")
    require_writable(loaded)
    return problem


def _metrics_listener(
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
