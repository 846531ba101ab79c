"""The commands as functions, for Python programs: load, check, compile, design, price, evaluate, trace, explain.

A spec is given as the path of its file, or as what `load` returned. `overrides` are texts such as
"design.coevolution.generations=10"; they replace values of the spec. `seed` is that of all random numbers: the same
spec, overrides and seed give the same result. `lanes`, the episodes that a kernel runs side by side, and `jobs` affect
only the speed.
"""

from __future__ import annotations

import time
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from bbsd.architecture import designed_text, given_architecture, require_writable, tidy_tables
from bbsd.compiler import Detail, Problem, compile_meaning, kernel_source
from bbsd.compiler.problem import DEFAULT_LANES
from bbsd.errors import Diagnosis, SpecError, UsageError
from bbsd.evaluation import (
    Evaluation,
    Interval,
    RewardNotFinite,
    Trace,
    agents_of,
    detailed_outcomes,
    enumerate_starts,
    evaluation,
    weighted_evaluation,
)
from bbsd.evaluation import trace as trace_episode
from bbsd.explanation import Explanation, explain_architecture
from bbsd.kernel.keys import keys, own_keys
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.language.loading import Loaded
from bbsd.language.loading import check as check_source
from bbsd.language.loading import load as load_source
from bbsd.language.meaning import seed_key
from bbsd.runs.answers import complete_runs
from bbsd.runs.command import Command
from bbsd.runs.interim import best_so_far
from bbsd.runs.pace import budget_of
from bbsd.runs.price import Price
from bbsd.runs.price import price as price_of
from bbsd.runs.rivals import Rival, each_run, paper_episodes, rival, spent
from bbsd.runs.searching import ANSWER
from bbsd.runs.signals import interrupts_request_stop
from bbsd.runs.storage.folder import DIGEST, Folder, digest_of, folder_to_resume, new_folder
from bbsd.runs.storage.identity import Identity, identity
from bbsd.runs.storage.lock import only_writer
from bbsd.runs.visits import Unvisited, unvisited
from bbsd.solver.budget import automatic_budget
from bbsd.solver.judgement import RANDOM_EPISODES, Selection, judge
from bbsd.solver.paper.settings import settings_of
from bbsd.solver.random_agents import random_agents
from bbsd.stopping import stop_request_of_context
from bbsd.text import Source

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from bbsd.compiler import DetailedOutcome
    from bbsd.evaluation import Agents
    from bbsd.evaluation.episodes import Keys
    from bbsd.runs.processes import Processes
    from bbsd.solver.paper.settings import Settings

EVALUATION = name_word("evaluation")
EPISODES_OF_DESIGN, EPISODES_OF_RANDOM_AGENT = 1000, RANDOM_EPISODES
"""Numbers of episodes in an evaluation by default: of a design, and of each random agent, as after a design."""

AnyProgress: TypeAlias = "Progress | SearchProgress"
AnySpec = str | Path | Loaded
"""The path of a spec's file, or a loaded spec."""


class NothingToDesign(UsageError):
    """A spec without holes was given to `design`."""

    advice = "to have parts of it designed, leave them out: the rules of a behavior, or the structure"


class NoBudget(UsageError):
    """A budget was given to a method that has none."""

    advice = "name another method, such as --set design.method=auto"


class Interrupted(KeyboardInterrupt):
    """A design was stopped; its state is in `folder`, from which `design(..., resume=True)` continues."""

    def __init__(self, folder: Path) -> None:
        super().__init__(str(folder))
        self.folder = folder
        self.best: BestSoFar | None = None
        """The best design so far, None where there is none."""


@dataclass(frozen=True, slots=True)
class BestSoFar:
    """The best design of a search that was stopped, by a short race."""

    architecture: Path
    """The file of the designed spec."""
    mean: float
    episodes: int
    """Its mean return in the race, and the episodes of it."""


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a design is after a generation, and the fitness of its agents. Runs and generations count from 1."""

    run: int
    runs: int
    generation: int
    generations: int
    mean: float
    best: float
    lifetime: float

    @property
    def done(self) -> int:
        """What is done of a run, in generations."""
        return self.generation

    @property
    def total(self) -> int:
        """What a run consists of, in generations."""
        return self.generations


@dataclass(frozen=True, slots=True)
class SearchProgress:
    """How far a search is, and the best design so far. Runs count from 1."""

    run: int
    runs: int
    episodes: int
    """Episodes so far."""
    budget: int
    mean: float
    """The mean return of the best design so far, in episodes that took no part in choosing it."""
    measured: int
    """The number of these episodes."""
    is_answer: bool
    """Whether the run has ended, and the best is its answer."""
    rival: str = ""
    """The method, where it is a rival's."""

    @property
    def done(self) -> int:
        """What is done of a run, in episodes."""
        return self.budget if self.is_answer else min(self.episodes, self.budget - 1)

    @property
    def total(self) -> int:
        """What a run consists of, in episodes."""
        return self.budget


@dataclass(frozen=True, slots=True)
class Designed:
    """The result of a design."""

    architecture: Path
    """The file of the designed spec."""
    folder: Path
    """The folder of all files of the design."""
    method: str
    """The method that searched."""
    structure: tuple[str, ...]
    """The names of the behaviors, highest layer first."""
    evaluation: Evaluation
    """Its evaluation on episodes that took no part in choosing it."""
    lifetime: Interval | None
    """The lifetime fitness of agents that have its behaviors and its structure at birth, and learn.

    None for methods that have no lifetimes.
    """
    random: Interval
    """The mean return of random agents, for comparison."""
    seconds: float
    """How long the design took."""
    selection: Selection
    """What selection among random agents has to work on."""
    spent: int
    """The episodes of all runs."""
    each: tuple[tuple[Interval, tuple[str, ...]], ...]
    """The mean return of each run's answer on the same new episodes, and its structure; none of a single run."""
    rivals: tuple[Rival, ...]
    """What other methods achieved with the same budget."""
    first_reward: int | None
    """Where all random agents earn the same: the episodes after which the search had a better design."""
    unvisited: tuple[Unvisited, ...]
    """Behaviors that have open cells which no candidate's episodes visited."""

    @property
    def mean(self) -> float:
        """The mean return of the design."""
        return self.evaluation.mean

    @property
    def sd(self) -> float:
        """The standard deviation of the return."""
        return self.evaluation.sd

    @property
    def ci95(self) -> tuple[float, float]:
        """The 95 % interval of the mean return."""
        return self.evaluation.ci95

    @property
    def episodes(self) -> int:
        """The number of episodes of its evaluation."""
        return self.evaluation.episodes


def load(spec: AnySpec, *, seed: int = 0, overrides: Sequence[str] = ()) -> Loaded:
    """Read and check a spec; random draws in its constants depend on the seed.

    Raises:
        SpecError: with all mistakes of the spec.
        OSError: its file cannot be read.
    """
    return (
        spec
        if isinstance(spec, Loaded)
        else load_source(Source.read(str(spec)), seed=seed, overrides=overrides)
    )


def check(spec: str | Path) -> tuple[Diagnosis, ...]:
    """Return all mistakes of a spec, none if it is correct.

    Raises:
        OSError: its file cannot be read.
    """
    try:
        return check_source(Source.read(str(spec)))
    except SpecError as error:
        return error.diagnoses


def compile(spec: AnySpec, *, lanes: int = DEFAULT_LANES, overrides: Sequence[str] = ()) -> str:  # noqa: A001 - the verb
    """Return the Python source of a spec's kernel: a rollout for the solver and one for evaluation.

    Raises:
        SpecError: with all mistakes of the spec.
    """
    problem = compile_meaning(load(spec, overrides=overrides).meaning)
    return kernel_source(problem.meaning, problem.tables, lanes, (Detail.CREDIT, Detail.TERMS))


def evaluate(
    spec: AnySpec,
    *,
    episodes: int | None = None,
    seed: int = 0,
    fill: Literal["random"] | None = None,
    agents: int = 1000,
    exact: bool = False,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    overrides: Sequence[str] = (),
    progress: Callable[[int, int], None] | None = None,
) -> Evaluation:
    """Run episodes of a spec's design and return their statistics.

    Args:
        spec: A spec without holes, unless `fill` is given.
        episodes: Number of episodes; by default 1000 for a design and 10 for each random agent. Designs that are
            evaluated with the same seed face the same episodes.
        seed: Seed of the episodes, and of the draws in constants.
        fill: "random" fills the holes at random, once for each of `agents` agents; each has episodes of its own.
        agents: Number of random agents.
        exact: Run each possible start once, weighted by its probability, instead of random episodes.
        lanes: Episodes that a kernel runs side by side; affects only the speed.
        jobs: Threads to use; affects only the speed.
        overrides: Values that replace those of the spec.
        progress: Called from time to time with the numbers of finished and of all episodes.

    Raises:
        SpecError: with all mistakes of the spec, or if a reward is not finite.
        HolesLeft: the spec has holes.
        NotEnumerable: `exact`, but the starts cannot be enumerated.
    """
    loaded = load(spec, seed=seed, overrides=overrides)
    problem = compile_meaning(loaded.meaning, lanes=lanes, jobs=jobs)
    generation = loaded.spec.design.coevolution.generations
    key = fold(seed_key(seed), EVALUATION)
    with _located_reward_errors(loaded):
        if fill == "random":
            fillings = random_agents(problem, fold(key, name_word("agents")), agents)
            streams = own_keys(key, agents, episodes or EPISODES_OF_RANDOM_AGENT)
            return evaluation(problem, _reported(problem, fillings, streams, generation, progress), agents)
        agent = agents_of([given_architecture(problem)])
        if exact:
            problem, weights = enumerate_starts(problem)
            starts = np.arange(len(weights), dtype=np.uint64)
            return weighted_evaluation(
                problem, _reported(problem, agent, starts, generation, progress), weights
            )
        streams = keys(key, 0, episodes or EPISODES_OF_DESIGN)
        return evaluation(problem, _reported(problem, agent, streams, generation, progress), 1)


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


def trace(spec: AnySpec, *, seed: int = 0, episode: int = 0, overrides: Sequence[str] = ()) -> Trace:
    """Run one of the episodes of `evaluate`, by its number from 0, and return all values of each step.

    Raises:
        SpecError: with all mistakes of the spec.
        HolesLeft: the spec has holes.
    """
    loaded = load(spec, seed=seed, overrides=overrides)
    problem = compile_meaning(loaded.meaning, compiled=False)
    key = fold(fold(seed_key(seed), EVALUATION), word_of(episode))
    return trace_episode(
        problem, given_architecture(problem), key, loaded.spec.design.coevolution.generations
    )


def explain(spec: AnySpec, *, seed: int = 0, overrides: Sequence[str] = ()) -> Explanation:
    """Describe in words what the design of a spec does, layer by layer.

    Raises:
        SpecError: with all mistakes of the spec.
        HolesLeft: the spec has holes.
    """
    meaning = load(spec, seed=seed, overrides=overrides).meaning
    return explain_architecture(meaning, given_architecture(compile_meaning(meaning)))


def design(
    spec: AnySpec,
    *,
    seed: int = 0,
    runs: int = 1,
    out: str | Path | None = None,
    resume: bool = False,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    overrides: Sequence[str] = (),
    progress: Callable[[AnyProgress], None] | None = None,
    overdue: Callable[[Interrupted], object] | None = None,
    ready: Processes | None = None,
    more: int | None = None,
    within: float | None = None,
    rivals: Sequence[str] = (),
) -> Designed:
    """Fill the holes of a spec, and write the design and its metrics into a folder.

    The same spec, overrides, seed and number of runs give the same bytes of `architecture.yaml` and `metrics.jsonl`,
    however often the design was stopped and resumed.

    Args:
        spec: A spec with holes.
        seed: Seed of all random numbers.
        runs: Number of independent runs; the best of their designs is kept.
        out: The folder to write, new or empty; by default the first free one under `runs/`.
        resume: Continue the same design in `out`, by default in the newest folder under `runs/` that holds it.
        lanes: Episodes that a kernel runs side by side; affects only the speed.
        jobs: Processes for several runs, and threads within a run if there are more jobs than runs; affects only
            the speed.
        overrides: Values that replace those of the spec.
        progress: Called after each generation, or each time the best so far was measured.
        overdue: Called in another thread if the design does not stop soon after an interrupt. An interrupt takes
            effect after the episodes that are running. `overdue` may end the process, since all written files are
            complete.
        ready: Worker processes that were started before; by default as many are started as are needed.
        more: Episodes of a further budget for each run that `resume` continues; the same sequence of budgets gives
            the same bytes.
        within: Seconds of each run, instead of a budget in episodes; the result cannot be reproduced.
        rivals: Names of methods on which the same budget is spent too; what they achieve is reported beside.

    Raises:
        SpecError: with all mistakes of the spec, or if a reward is not finite.
        NothingToDesign: the spec has no holes.
        NoBudget: `more` or `within` for the paper's loop.
        FolderInUse: another process writes in the folder.
        FolderError: the folder cannot be written, or not be resumed.
        WorkerLost: a process that did a run was killed.
        Interrupted: the design was interrupted; `resume` continues it.
    """
    started = time.monotonic()
    loaded = load(spec, seed=seed, overrides=overrides)
    problem = _problem_with_holes(loaded, lanes, jobs)
    settings = settings_of(loaded.meaning)
    if settings.method == "paper" and (more is not None or within is not None):
        raise NoBudget("the paper's loop has generations, which cannot be continued or timed")
    run_identity = identity(loaded, seed, runs)
    folder = _run_folder(loaded, run_identity, Path(out) if out else None, resume=resume)
    with only_writer(folder):
        budgets = _budgets(settings, problem, folder, more, within)
        if not resume or budgets != folder.budgets():
            folder.write_run_file(run_identity, overrides, budgets, folder.result() or None)
        command = Command(problem, settings, seed, runs, folder, run_identity, budgets, within)
        listener = progress and _metrics_listener(command, progress)
        with _interruptible(command, loaded, overdue, keep_best=True):
            answers = complete_runs(command, jobs, listener, ready)
            judged = judge(answers, problem, settings, seed)
            missed = unvisited(command)
        folder.gather(runs)
        text = designed_text(loaded, tidy_tables(problem.meaning, judged.architecture))
        folder.write_architecture(text)
        names = tuple(problem.names[behavior] for behavior in reversed(judged.architecture.structure))
        result = {"structure": names, "return": asdict(judged.evaluation.returns), DIGEST: digest_of(text)}
        folder.write_run_file(run_identity, overrides, budgets, result)
        with _interruptible(command, loaded, overdue, keep_best=False):
            others = tuple(
                rival(command, name, loaded, jobs, progress and _metrics_listener(command, progress, name))
                for name in rivals
            )
    seconds = time.monotonic() - started
    return Designed(
        folder.architecture,
        folder.path,
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
    )


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


@contextmanager
def _interruptible(
    command: Command,
    loaded: Loaded,
    overdue: Callable[[Interrupted], object] | None,
    *,
    keep_best: bool,
) -> Iterator[None]:
    """Turn an interrupt inside into Interrupted, the best design so far being kept where there is no answer yet."""
    interrupted = Interrupted(command.folder.path)
    with _located_reward_errors(loaded), interrupts_request_stop(overdue and (lambda: overdue(interrupted))):
        try:
            yield
        except KeyboardInterrupt:
            if keep_best:
                with stop_request_of_context():
                    interrupted.best = _keep_best(command, loaded)
            raise interrupted from None


def _keep_best(command: Command, loaded: Loaded) -> BestSoFar | None:
    """Write the best design so far of a search that was stopped."""
    best = best_so_far(command)
    if best is None:
        return None
    text = designed_text(loaded, tidy_tables(command.problem.meaning, best.architecture))
    return BestSoFar(command.folder.write_best(text), best.mean, best.episodes)


def price(
    spec: AnySpec,
    *,
    seed: int = 0,
    runs: int = 1,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    starting: float = 0.0,
    overrides: Sequence[str] = (),
) -> Price:
    """Estimate the time and memory of a `design` from a sample of its episodes; write nothing.

    Args:
        spec: A spec with holes.
        seed: Seed of the sample.
        runs: Number of runs.
        lanes: Episodes that a kernel runs side by side.
        jobs: Processes and threads of the design.
        starting: Seconds that the process needs before and after the design; they are added.
        overrides: Values that replace those of the spec.

    Raises:
        SpecError: with all mistakes of the spec, or if a reward is not finite.
        NothingToDesign: the spec has no holes.
    """
    loaded = load(spec, seed=seed, overrides=overrides)
    problem = _problem_with_holes(loaded, lanes)
    with _located_reward_errors(loaded):
        return price_of(problem, settings_of(loaded.meaning), seed, runs, jobs, starting)


def _problem_with_holes(loaded: Loaded, lanes: int, jobs: int = 1) -> Problem:
    problem = compile_meaning(loaded.meaning, lanes=lanes, jobs=jobs)
    if not problem.has_holes:
        raise NothingToDesign(f"{loaded.source.file} has no holes: every cell and every layer is given")
    require_writable(loaded)
    return problem


def _run_folder(loaded: Loaded, run_identity: Identity, out: Path | None, *, resume: bool) -> Folder:
    name = Path(loaded.source.file).stem
    if resume:
        return folder_to_resume(out, name, run_identity)
    folder = new_folder(out, name, run_identity.seed)
    folder.copy_spec(loaded.lineage.flat.source.text)
    return folder


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


@contextmanager
def _located_reward_errors(loaded: Loaded) -> Iterator[None]:
    """Turn a RewardNotFinite into a SpecError at the place of the reward term in the spec."""
    try:
        yield
    except RewardNotFinite as error:
        place = loaded.lineage.place(("reward", error.term))
        raise loaded.lineage.error([Diagnosis("BB045", str(error), place)]) from None
