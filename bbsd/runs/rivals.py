"""The same problem and the same budget for another method, kept beside the design in a folder of its own."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bbsd.language.design import LEAST_BUDGET
from bbsd.language.lineage import overlay
from bbsd.language.meaning import elaborate
from bbsd.language.validation import validate
from bbsd.runs.answers import complete_runs
from bbsd.runs.joint_policy import joint_policy_returns
from bbsd.runs.searching import UnsuitableMethod
from bbsd.runs.storage.folder import Folder
from bbsd.runs.storage.state import Searching
from bbsd.solver.judgement import best_of, fresh_returns
from bbsd.solver.methods.registry import METHODS
from bbsd.solver.paper.settings import settings_of
from bbsd.solver.search import search_budget

if TYPE_CHECKING:
    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.evaluation import Interval
    from bbsd.language.loading import Loaded
    from bbsd.runs.command import Command, Listener
    from bbsd.solver.paper.settings import Settings

PAPER = "paper"


@dataclass(frozen=True, slots=True)
class Rival:
    """What another method achieved with the same budget, on the same fresh episodes."""

    method: str
    returns: Interval | None
    """None where the method could not search."""
    episodes: int
    """Those of all its runs, races included; of the paper's loop, those of its generations."""
    structure: tuple[str, ...]
    reason: str = ""
    """Why the method could not search."""
    joint: Interval | None = None
    """What the joint policy of Q-learning earns; None for other methods."""


def all_rivals(method: str) -> tuple[str, ...]:
    """Return the names of all methods but one."""
    return tuple(name for name in (*METHODS, PAPER) if name != method)


def rival(command: Command, method: str, loaded: Loaded, jobs: int, listener: Listener | None) -> Rival:
    """Spend the budgets of a command on another method, and judge what it finds."""
    other = rival_command(command, method, loaded)
    try:
        answers = complete_runs(other, jobs, listener)
    except UnsuitableMethod as error:
        return Rival(method, None, 0, (), str(error))
    best = best_of(answers, other.problem, other.settings, other.seed)
    structure = tuple(other.problem.names[behavior] for behavior in reversed(best.structure))
    returns = fresh_returns(best, other.problem, other.settings, other.seed)
    return Rival(method, returns, spent(other), structure, joint=joint_policy_returns(other))


def rival_command(command: Command, method: str, loaded: Loaded) -> Command:
    """Return the command of another method with the same runs, budgets and streams, in a folder below."""
    folder = Folder(command.folder.path / f"rival-{method}")
    folder.path.mkdir(exist_ok=True)
    who = replace(command.who, spec=(*command.who.spec, ("method", method)))
    budgets = command.budgets or (paper_episodes(command.settings),)
    problem, settings = command.problem, replace(command.settings, method=method)  # type: ignore[arg-type]
    if method == PAPER:
        problem, settings = _paper(loaded, command, max(LEAST_BUDGET, search_budget(sum(budgets))))
        who = replace(who, spec=(*who.spec, ("budget", str(sum(budgets)))))
        budgets = ()
    return replace(
        command, problem=problem, settings=settings, folder=folder, who=who, budgets=budgets, seconds=None
    )


def _paper(loaded: Loaded, command: Command, episodes: int) -> tuple[Problem, Settings]:
    """Return the problem, and the settings of the paper's loop with as many generations as the episodes are for."""
    data = loaded.data if isinstance(loaded.data, dict) else {}
    over = {"design": {"method": PAPER, "budget": episodes, "coevolution": {"generations": None}}}
    if "generations" not in loaded.spec.design.coevolution.model_fields_set:
        over["design"].pop("coevolution")
    spec, _ = validate(overlay(data, over))  # type: ignore[arg-type]
    meaning = elaborate(spec, command.seed)[0] if spec else None
    if meaning is None:
        raise RuntimeError("a spec without mistakes has some with another method")
    problem = command.problem.with_meaning(meaning)
    return problem, settings_of(problem.meaning)


def paper_episodes(settings: Settings) -> int:
    """Return the episodes of all generations of a run of the paper's loop."""
    evolved = settings.coevolution
    return evolved.generations * evolved.agents * settings.learning.episodes


def spent(command: Command) -> int:
    """Return the episodes of all runs of a command that is complete."""
    if command.settings.method == PAPER:
        return command.n_runs * paper_episodes(command.settings)
    states = [command.reached(run) for run in range(command.n_runs)]
    return sum(reached.state.spent for reached in states if reached and isinstance(reached.state, Searching))


def each_run(command: Command, answers: list[Architecture]) -> tuple[tuple[Interval, tuple[str, ...]], ...]:
    """Return what each run's answer earns on the same fresh episodes, and its structure."""
    return tuple(
        (
            fresh_returns(answer, command.problem, command.settings, command.seed),
            tuple(command.problem.names[behavior] for behavior in reversed(answer.structure)),
        )
        for answer in answers
    )
