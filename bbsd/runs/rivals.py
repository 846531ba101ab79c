"""The same problem and the same budget for another method, kept beside the design in a folder of its own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.files import make_folder
from bbsd.runs.outcome.joint_policy import joint_policy_returns
from bbsd.runs.rival_command import PAPER, rival_command
from bbsd.runs.searching import UnsuitableMethod
from bbsd.runs.storage.state import Searching
from bbsd.runs.workers.answers import complete_runs
from bbsd.solver.judgement import best_of, fresh_returns
from bbsd.solver.methods.registry import METHODS

if TYPE_CHECKING:
    from bbsd.architecture import Architecture
    from bbsd.engines.engine import Engine
    from bbsd.evaluation import Interval
    from bbsd.language.loading import Loaded
    from bbsd.runs.command import Command, Listener


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


def rival(
    command: Command,
    method: str,
    loaded: Loaded,
    jobs: int,
    listener: Listener | None,
    engine: Engine | None = None,
) -> Rival:
    """Spend the budgets of a command on another method, and judge what it finds."""
    other = rival_command(command, method, loaded)
    make_folder(command.folder.below(other.folder.path.name).path)
    try:
        answers = complete_runs(other, jobs, listener, engine)
    except UnsuitableMethod as error:
        return Rival(method, None, 0, (), str(error))
    best = best_of(answers, other.problem, other.settings, other.seed)
    structure = tuple(other.problem.names[behavior] for behavior in reversed(best.structure))
    returns = fresh_returns(best, other.problem, other.settings, other.seed)
    return Rival(method, returns, spent(other), structure, joint=joint_policy_returns(other))


def spent(command: Command) -> int:
    """Return the episodes of all runs of a command that is complete."""
    states = [reached.state for run in range(command.n_runs) if (reached := command.reached(run))]
    evolved, lifetime = command.settings.coevolution, command.settings.learning.episodes
    return sum(
        state.spent if isinstance(state, Searching) else state.generation * evolved.agents * lifetime
        for state in states
    )


def each_run(command: Command, answers: list[Architecture]) -> tuple[tuple[Interval, tuple[str, ...]], ...]:
    """Return what each run's answer earns on the same fresh episodes, and its structure."""
    return tuple(
        (
            fresh_returns(answer, command.problem, command.settings, command.seed),
            tuple(command.problem.names[behavior] for behavior in reversed(answer.structure)),
        )
        for answer in answers
    )
