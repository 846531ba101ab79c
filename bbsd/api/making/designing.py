"""Design a spec."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from bbsd.api.given.arguments import Assignments, checked, number, optional, path, require_none, whole
from bbsd.api.given.environments import opened_environment, problem_of
from bbsd.api.making.carrying import Kept, Means, carried_out, why_fickle
from bbsd.api.making.place import Wanted, former_of, place_of, require_former
from bbsd.api.making.rivals import known_rivals
from bbsd.api.making.starting import beginnings_of, resumed_beginnings, starts
from bbsd.api.making.stopwatch import Stopwatch
from bbsd.api.results import AnyProgress, Designed, Interrupted, NoBudget, NothingToDesign
from bbsd.api.specs import AnySpec, loaded_from
from bbsd.architecture import require_writable
from bbsd.compiler.problem import DEFAULT_LANES
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.language.design import LEAST_BUDGET
from bbsd.language.loading import loaded_again
from bbsd.runs.beginnings import solver_starts
from bbsd.runs.command import Command
from bbsd.runs.origin import origin_of
from bbsd.runs.pricing.pace import budget_of
from bbsd.runs.storage.identity import identity
from bbsd.runs.storage.lock import only_writer
from bbsd.runs.storage.unused import remove_parts
from bbsd.solver.budget import automatic_budget
from bbsd.solver.paper.settings import settings_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from bbsd.compiler import Problem
    from bbsd.engines.engine import Engine
    from bbsd.environments.importing.modules import Announce
    from bbsd.environments.opening import Opened
    from bbsd.language.loading import Loaded
    from bbsd.runs.storage.folder import Folder
    from bbsd.solver.paper.settings import Settings


@checked(
    more=optional(whole(LEAST_BUDGET)),
    below=optional(path),
    start=starts,
    time_limit=optional(number(above=0)),
)
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
    start: AnySpec | Sequence[AnySpec] = (),
    time_limit: float | None = None,
    finish: Callable[[Designed], object] | None = None,
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
        note: Called with a sentence on that, if it has one, and on what of a start is set aside.
        start: A known design, or a list of several, with which the search begins: they are among its first candidates
            and in its final race. Behaviors, cells and actions are matched by name; what a start leaves open is drawn.

        time_limit: Seconds after which the searches end, with their final races; where runs go one after another, each
            has its part. The result cannot be reproduced, and `more` goes on.
        finish: Called with the result while its folder is still locked, so that nobody else writes there meanwhile.

    Raises:
        SpecError: with all mistakes of the spec, or if a reward is not finite.
        NothingToDesign: the spec has no holes, or is the folder of a run that is finished.
        BadArgument: an argument is none that can be honored.
        NoBudget: `more` or `within` for the paper's loop.
        FolderInUse: another process writes in the folder.
        FolderError: the folder cannot be written, or not be resumed.
        RunsLost: four processes that did a run were killed, one after the other; the other runs are complete.
        Interrupted: the design was interrupted; `resume` continues it.
        ImportNotAllowed: the spec's environment needs a module that was not allowed.
        EnvironmentFailed, EnvironmentHangs, ActionRefused: what the environment did wrong, or was told wrong.
    """
    stopwatch = Stopwatch()
    resume = resume or more is not None
    former = former_of(spec, goes_on=resume)
    if former is not None:
        require_former(former, seed=seed, runs=runs, set=set, out=out, below=below)
        made = former.design()
        spec, seed, runs, set, out = made.spec, made.seed, made.runs, made.overrides, former.path
    require_none(["below"] if None not in (below, out) else [], "beside out, the folder itself")
    require_none(["more"] if None not in (more, within) else [], "beside within")
    require_none(["time_limit"] if None not in (time_limit, within) else [], "beside within")
    loaded = loaded_again(loaded_from(spec, seed, set), seed=seed)
    opened = opened_environment(
        loaded, allow_import, import_from, environment, step_limit, announce, by_table, note
    )
    problem = problem_with_holes(loaded, opened, lanes, jobs)
    method = loaded.spec.design.chosen_method
    if method == "paper" and (more is not None or within is not None):
        raise NoBudget(
            "the paper's loop has generations, which cannot be continued, and no budget that is a time"
        )
    known_rivals(rivals, method)
    environment_identity = None if opened is None else opened.plain()
    known = cast("tuple[AnySpec, ...]", start)
    beginnings = () if resume else beginnings_of(known, problem, seed, note)
    folder_wanted, new_below = (None if each is None else Path(each) for each in (out, below))
    wanted = Wanted(folder_wanted, new_below, resume, bool(known))
    with (
        place_of(wanted, loaded, identity(loaded, seed, runs, environment_identity)) as folder,
        only_writer(folder.path),
    ):
        if resume:
            beginnings = resumed_beginnings(known, folder, problem, seed, note)
        begun = solver_starts(problem, beginnings, seed)
        settings = settings_of(problem.meaning, begun)
        run_identity = identity(loaded, seed, runs, environment_identity, begun)
        remove_parts(folder.path)
        if not resume:
            folder.begin(loaded.lineage.flat.source.text)
        fickle = None if opened is None else why_fickle(opened, loaded)
        budgets = _budgets(settings, problem, folder, more, within)
        if not resume or budgets != folder.budgets():
            result = folder.result() or None
            folder.write_run_file(run_identity, loaded.overrides, budgets, result, fickle, beginnings)
        command = Command(
            problem,
            settings,
            seed,
            runs,
            folder,
            run_identity,
            budgets,
            within if time_limit is None else time_limit / -(-runs // _side_by_side(jobs, engine)),
            time_limit is not None,
            origin_of(loaded, opened, beginnings),
        )
        kept = Kept(loaded, fickle, is_written=wanted.is_kept)
        designed = carried_out(command, kept, Means(jobs, engine, progress, overdue, rivals), stopwatch)
        if finish is not None:
            finish(designed)
        return designed


def _side_by_side(jobs: int, engine: Engine | None) -> int:
    """Return how many runs go on at the same time."""
    return jobs if engine is None or engine.shares_machine else max(1, engine.capacity())


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
