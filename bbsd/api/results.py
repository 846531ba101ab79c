"""What the verbs return and raise, and what they report on the way."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

from bbsd.errors import UsageError
from bbsd.runs.storage.finished import ARCHITECTURE

if TYPE_CHECKING:
    from pathlib import Path

    from bbsd.architecture.visits import Visits
    from bbsd.evaluation import Evaluation, Interval
    from bbsd.runs.outcome.endings import Ending
    from bbsd.runs.outcome.visits import Unvisited
    from bbsd.runs.rivals import Rival
    from bbsd.solver.judgement import Selection

AnyProgress: TypeAlias = "Progress | SearchProgress"


class NothingToDesign(UsageError):
    """A spec without holes, or a finished run, was given to `design`."""

    advice = "to have parts of it designed, leave them out: the rules of a behavior, or the structure"

    def __init__(self, message: str, advice: str | None = None) -> None:
        super().__init__(message)
        if advice is not None:
            self.advice = advice


class NoBudget(UsageError):
    """A budget was given to a method that has none."""

    advice = "name another method, such as --set design.method=auto"


class NotWritten(UsageError):
    """The folder of a design is asked for that was written nowhere."""

    advice = "name a folder: bbsd.design(..., out=FOLDER); the result itself has `text` and `metrics`"


def _written(folder: Path | None) -> Path:
    if folder is None:
        raise NotWritten("the design was written into no folder")
    return folder


class Interrupted(KeyboardInterrupt):
    """A design was stopped; its state is in `folder`, from which `design(..., resume=True)` continues.

    Where the design is written nowhere, nothing is left but `best`.
    """

    def __init__(self, written: Path | None) -> None:
        super().__init__("" if written is None else str(written))
        self.written = written
        """The folder, None where the design is written nowhere."""
        self.best: BestSoFar | None = None
        """The best design so far, None where there is none."""

    @property
    def folder(self) -> Path:
        """The folder. Raises NotWritten where there is none."""
        return _written(self.written)


@dataclass(frozen=True, slots=True)
class BestSoFar:
    """The best design of a search that was stopped, by a short race."""

    architecture: Path | None
    """The file of the designed spec, None where nothing is written."""
    text: str
    """The designed spec."""
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

    def __str__(self) -> str:
        """Return a line for `progress=print`."""
        fitness = f"mean {self.mean:.6g}, best {self.best:.6g}, lifetime {self.lifetime:.6g}"
        return f"run {self.run}/{self.runs}, generation {self.generation}/{self.generations}: {fitness}"


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

    def __str__(self) -> str:
        """Return a line for `progress=print`."""
        rival = f"rival {self.rival}, " if self.rival else ""
        best = f"best so far {self.mean:.6g} in {self.measured:,} new episodes"
        return f"{rival}run {self.run}/{self.runs}, {self.episodes:,} of {self.budget:,} episodes: {best}"


@dataclass(frozen=True, slots=True)
class Designed:
    """The result of a design; every verb takes it in place of the designed spec."""

    name: str
    """What the design is called."""
    text: str
    """The designed spec."""
    written: Path | None
    """The folder of all files of the design, None where it was written nowhere."""
    metrics: tuple[dict[str, Any], ...]
    """The records of `metrics.jsonl`."""
    visits: Visits = field(compare=False)
    """How often each cell was asked, and the behavior controlled then, in episodes of the design."""
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
    """How long the design took, without compiling."""
    compile_seconds: float
    """How long this process compiled for it; next to nothing where the kernels were in the cache."""
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
    ended: tuple[Ending, ...] = ()
    """The runs that ended before their budget was spent."""
    joint: Interval | None = None
    """What the joint policy of Q-learning earns in the same episodes, which behaviors may be unable to express.

    None for other methods.
    """
    not_reproducible: str = ""
    """Why the episodes of an environment that is stepped in Python cannot be repeated; '' where they can."""

    @property
    def folder(self) -> Path:
        """The folder of all files of the design. Raises NotWritten where there is none."""
        return _written(self.written)

    @property
    def architecture(self) -> Path:
        """The file of the designed spec. Raises NotWritten where there is none."""
        return self.folder / ARCHITECTURE

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

    def to_frame(self) -> Any:  # noqa: ANN401 - pandas is optional
        """Return the metrics of all runs on the way as a pandas DataFrame, a row for each record or generation.

        Raises NoPandas where pandas is not installed.
        """
        from bbsd.evaluation.frames import metrics_frame

        return metrics_frame(self.metrics)

    def __repr__(self) -> str:
        low, high = self.ci95
        structure = " ".join(self.structure)
        what = self.name if self.written is None else self.architecture
        return f"<Designed {what}: mean return {self.mean:.6g} ({low:.6g} to {high:.6g}), {structure}>"
