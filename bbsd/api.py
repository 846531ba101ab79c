"""The verbs: what the command line does, for programs."""

from __future__ import annotations

import time
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from bbsd.architecture import designed_text, given_architecture, require_writable, tidied
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
from bbsd.runs.folder import Folder, Identity, folder_to_resume, identity, new_folder
from bbsd.runs.price import Price
from bbsd.runs.price import price as price_of
from bbsd.runs.signals import interrupts_request_stop
from bbsd.solver.judgement import RANDOM_EPISODES, judge
from bbsd.solver.random_agents import random_agents
from bbsd.solver.settings import settings_of
from bbsd.text import Source

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from bbsd.compiler import DetailedOutcome
    from bbsd.evaluation import Agents
    from bbsd.evaluation.episodes import Keys
    from bbsd.runs.processes import Processes

EVALUATION = name_word("evaluation")
EPISODES, EPISODES_AT_RANDOM = 1000, RANDOM_EPISODES
"""Episodes that a design lives by default, and that each of many random agents does, as in a design's comparison."""

Spec = str | Path | Loaded
"""A spec's file, or one that is loaded."""


class NothingToDesign(UsageError):
    """A spec without holes."""


class Interrupted(KeyboardInterrupt):
    """A design that was stopped; its state is in the folder and can be gone on from."""

    def __init__(self, folder: Path) -> None:
        super().__init__(str(folder))
        self.folder = folder


@dataclass(frozen=True, slots=True)
class Progress:
    """What a design tells after each generation. Runs and generations count from 1."""

    run: int
    runs: int
    generation: int
    generations: int
    mean: float
    best: float
    lifetime: float


@dataclass(frozen=True, slots=True)
class Designed:
    """What a design came to."""

    architecture: Path
    folder: Path
    structure: tuple[str, ...]
    """Highest layer first."""
    evaluation: Evaluation
    """On episodes that took no part in choosing the design."""
    lifetime: Interval
    random: Interval
    seconds: float

    @property
    def mean(self) -> float:
        """The mean return of the design."""
        return self.evaluation.mean

    @property
    def sd(self) -> float:
        """The standard deviation of its return."""
        return self.evaluation.sd

    @property
    def ci95(self) -> tuple[float, float]:
        """The 95 % interval of its mean return."""
        return self.evaluation.ci95

    @property
    def episodes(self) -> int:
        """The episodes it was judged on."""
        return self.evaluation.episodes


def load(spec: Spec, *, seed: int = 0, overrides: Sequence[str] = ()) -> Loaded:
    """Read and check a spec; draws in constants come from the seed.

    Raises SpecError with all its mistakes.
    """
    return (
        spec
        if isinstance(spec, Loaded)
        else load_source(Source.read(str(spec)), seed=seed, overrides=overrides)
    )


def check(spec: str | Path) -> tuple[Diagnosis, ...]:
    """All mistakes in a spec, none if it is correct."""
    try:
        return check_source(Source.read(str(spec)))
    except SpecError as error:
        return error.diagnoses


def compile(spec: Spec, *, lanes: int = DEFAULT_LANES, overrides: Sequence[str] = ()) -> str:  # noqa: A001 - the verb
    """The source of the kernel that a spec compiles to: a rollout for the solver and one for evaluation."""
    problem = compile_meaning(load(spec, overrides=overrides).meaning)
    return kernel_source(problem.meaning, problem.tables, lanes, (Detail.CREDIT, Detail.TERMS))


def evaluate(
    spec: Spec,
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
    """Let the design of a spec live episodes, the same ones for every spec and the same seed.

    With fill="random" the holes are filled at random, by so many agents that live so many episodes of their own. By
    default a design lives 1000 episodes and a random agent 10. With `exact` every start is tried once.
    `progress` is told now and then how many episodes were lived, and of how many. Raises HolesLeft for a spec
    with holes, NotEnumerable, SpecError.
    """
    loaded = load(spec, seed=seed, overrides=overrides)
    problem = compile_meaning(loaded.meaning, lanes=lanes, jobs=jobs)
    generation = loaded.spec.design.coevolution.generations
    key = fold(seed_key(seed), EVALUATION)
    with _reward_at_its_place(loaded):
        if fill == "random":
            lived = random_agents(problem, fold(key, name_word("agents")), agents)
            streams = own_keys(key, agents, episodes or EPISODES_AT_RANDOM)
            return evaluation(problem, _lived(problem, lived, streams, generation, progress), agents)
        lived = agents_of([given_architecture(problem)])
        if exact:
            problem, weights = enumerate_starts(problem)
            starts = np.arange(len(weights), dtype=np.uint64)
            return weighted_evaluation(problem, _lived(problem, lived, starts, generation, progress), weights)
        streams = keys(key, 0, episodes or EPISODES)
        return evaluation(problem, _lived(problem, lived, streams, generation, progress), 1)


def _lived(
    problem: Problem, agents: Agents, streams: Keys, generation: int, tell: Callable[[int, int], None] | None
) -> Iterator[DetailedOutcome]:
    """The episodes of agents, batch by batch, each of which is told of."""
    done, total = 0, len(agents) * streams.shape[-1]
    for outcome in detailed_outcomes(problem, agents, streams, generation):
        done += len(outcome.returns)
        if tell is not None:
            tell(done, total)
        yield outcome


def trace(spec: Spec, *, seed: int = 0, episode: int = 0, overrides: Sequence[str] = ()) -> Trace:
    """One of the episodes that `evaluate` lives, step by step; raises as `evaluate`."""
    loaded = load(spec, seed=seed, overrides=overrides)
    problem = compile_meaning(loaded.meaning, compiled=False)
    key = fold(fold(seed_key(seed), EVALUATION), word_of(episode))
    return trace_episode(
        problem, given_architecture(problem), key, loaded.spec.design.coevolution.generations
    )


def explain(spec: Spec, *, seed: int = 0, overrides: Sequence[str] = ()) -> Explanation:
    """What the design of a spec does, layer by layer. Raises HolesLeft for a spec with holes, SpecError."""
    meaning = load(spec, seed=seed, overrides=overrides).meaning
    return explain_architecture(meaning, given_architecture(compile_meaning(meaning)))


def design(
    spec: Spec,
    *,
    seed: int = 0,
    runs: int = 1,
    out: str | Path | None = None,
    resume: bool = False,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    overrides: Sequence[str] = (),
    progress: Callable[[Progress], None] | None = None,
    overdue: Callable[[Interrupted], object] | None = None,
    ready: Processes | None = None,
) -> Designed:
    """Fill the holes of a spec and write what came of it into a folder.

    The same spec, seed, runs and settings give the same bytes of `architecture.yaml` and `metrics.jsonl`,
    however often it was stopped and gone on with (`resume`), and for any number of lanes and of jobs: processes
    that do different runs, and threads inside a run where there are more jobs than runs. Raises NothingToDesign,
    SpecError, FolderError, WorkerLost, and Interrupted, after which `resume` goes on.

    An interrupt is noted at once and heeded when the episodes that are being lived are over. If that takes too
    long, `overdue` is called, in another thread; it may end the process, since what was kept is whole.

    Processes that are `ready` do some of the runs; by default as many are started as are needed.
    """
    began = time.monotonic()
    loaded = load(spec, seed=seed, overrides=overrides)
    problem = _with_holes(loaded, lanes, jobs)
    who = identity(loaded.lineage.flat.source.text, tuple(overrides), seed, runs)
    folder = _folder(loaded, who, Path(out) if out else None, resume=resume)
    command = Command(problem, settings_of(loaded.meaning), seed, runs, folder)
    stopped = Interrupted(folder.path)
    with _reward_at_its_place(loaded), interrupts_request_stop(overdue and (lambda: overdue(stopped))):
        try:
            judged = judge(
                complete_runs(command, jobs, progress and _teller(command, progress), ready),
                problem,
                command.settings,
                seed,
            )
        except KeyboardInterrupt:
            raise stopped from None
    folder.gather(runs)
    architecture = tidied(problem.meaning, judged.architecture)
    folder.write_architecture(designed_text(loaded, architecture))
    names = tuple(problem.names[behavior] for behavior in reversed(judged.architecture.structure))
    folder.write_run_file(who, {"structure": names, "return": asdict(judged.evaluation.returns)})
    seconds = time.monotonic() - began
    return Designed(
        folder.architecture, folder.path, names, judged.evaluation, judged.lifetime, judged.random, seconds
    )


def price(
    spec: Spec,
    *,
    seed: int = 0,
    runs: int = 1,
    lanes: int = DEFAULT_LANES,
    jobs: int = 1,
    starting: float = 0.0,
    overrides: Sequence[str] = (),
) -> Price:
    """What `design` would cost, from a sample of its episodes; raises as `design`, and writes nothing.

    `starting` are the seconds that a process needs before it begins with it and after it, and are added.
    """
    loaded = load(spec, seed=seed, overrides=overrides)
    problem = _with_holes(loaded, lanes)
    with _reward_at_its_place(loaded):
        return price_of(problem, settings_of(loaded.meaning), seed, runs, jobs, starting)


def _with_holes(loaded: Loaded, lanes: int, jobs: int = 1) -> Problem:
    problem = compile_meaning(loaded.meaning, lanes=lanes, jobs=jobs)
    if not problem.has_holes:
        raise NothingToDesign(f"{loaded.source.file} has no holes: every cell and every layer is given")
    require_writable(loaded)
    return problem


def _folder(loaded: Loaded, who: Identity, out: Path | None, *, resume: bool) -> Folder:
    name = Path(loaded.source.file).stem
    if resume:
        return folder_to_resume(out, name, who)
    folder = new_folder(out, name, who.seed)
    folder.copy_spec(loaded.lineage.flat.source.text)
    folder.write_run_file(who)
    return folder


def _teller(command: Command, progress: Callable[[Progress], None]) -> Callable[[dict[str, Any]], None]:
    """What makes a generation's metrics into its progress."""

    def tell(line: dict[str, Any]) -> None:
        figures = (line["mean"], line["best"], line["lifetime"])
        generations = command.settings.coevolution.generations
        progress(Progress(line["run"], command.n_runs, line["generation"], generations, *figures))

    return tell


@contextmanager
def _reward_at_its_place(loaded: Loaded) -> Iterator[None]:
    """Tells of a reward that is not finite at the term's place in the spec."""
    try:
        yield
    except RewardNotFinite as error:
        place = loaded.lineage.place(("reward", error.term))
        raise loaded.lineage.error([Diagnosis("BB045", str(error), place)]) from None
