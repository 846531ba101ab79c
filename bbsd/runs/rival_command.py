"""The command of a rival: the same problem, seed and budget, by another method, in a folder below."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.language.design import LEAST_BUDGET
from bbsd.language.lineage import overlay
from bbsd.language.meaning import elaborate
from bbsd.language.validation import validate
from bbsd.runs.storage.folder import Folder
from bbsd.solver.paper.settings import settings_of
from bbsd.solver.search import search_budget

if TYPE_CHECKING:
    from bbsd.compiler import Problem
    from bbsd.language.loading import Loaded
    from bbsd.runs.command import Command
    from bbsd.solver.paper.settings import Settings

PAPER = "paper"


def rival_command(command: Command, method: str, loaded: Loaded) -> Command:
    """Return the command of another method with the same runs, budgets and streams, in a folder below."""
    folder = Folder(command.folder.path / f"rival-{method}")
    who = replace(command.who, spec=(*command.who.spec, ("method", method)))
    budgets = command.budgets or (paper_episodes(command.settings),)
    problem, settings = command.problem, replace(command.settings, method=method)  # type: ignore[arg-type]
    if method == PAPER:
        problem, settings = _paper(loaded, command, max(LEAST_BUDGET, search_budget(sum(budgets))))
        who = replace(who, spec=(*who.spec, ("budget", str(sum(budgets)))))
        budgets = ()
    origin = command.origin and replace(command.origin, rival=method, budgets=command.budgets)
    return replace(
        command,
        problem=problem,
        settings=settings,
        folder=folder,
        who=who,
        budgets=budgets,
        seconds=command.seconds if command.is_limited else None,
        origin=origin,
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
    return problem, settings_of(problem.meaning, command.settings.starts)


def paper_episodes(settings: Settings) -> int:
    """Return the episodes of all generations of a run of the paper's loop."""
    evolved = settings.coevolution
    return evolved.generations * evolved.agents * settings.learning.episodes
