"""Runs a cell: the same rounds, records and race as `bbsd design`, without a folder."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import bbsd
from bbsd.compiler import compile_meaning
from bbsd.runs.run import generations, run_key, start
from bbsd.runs.searching import Course
from bbsd.runs.storage.state import Searching
from bbsd.solver.methods.method import SearchState
from bbsd.solver.methods.q_learning.q_learning import TooManyJointCells
from bbsd.solver.paper.generation import State
from bbsd.solver.paper.settings import settings_of
from bbsd.solver.search import final_race, search_budget
from experiments.methods.cells import Cell, Result
from experiments.methods.contestants import PAPER, method_of
from experiments.methods.tasks import Task, task

if TYPE_CHECKING:
    from bbsd.solver.space import Designs

WARM_UP = 5_000
"""Episodes of a search before the first that is timed, in which kernels are compiled or read."""

_warm: set[tuple[str, str]] = set()


class Answer(NamedTuple):
    """What a search came to: a design, one row, all episodes that it took, and the best so far on the way."""

    design: Designs
    spent: int
    curve: tuple[tuple[int, float], ...]


class CannotDesign(Exception):
    """A method that cannot design a task; the message says why."""


def run(cell: Cell) -> Result:
    """Run a cell."""
    where = task(cell.task)
    about = {**cell._asdict(), "of": where.digest(cell.method)}
    try:
        if (cell.task, cell.method) not in _warm:
            budget = cell.budget if cell.method == PAPER else min(WARM_UP, cell.budget)
            search(where, cell.method, budget, cell.seed)
            _warm.add((cell.task, cell.method))
        wall, processor = time.perf_counter(), time.process_time()
        answer = search(where, cell.method, cell.budget, cell.seed)
    except CannotDesign as reason:
        return Result(**about, mean=None, reason=str(reason))
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    names = where.arena.problem.names
    structure = tuple(names[behavior] for behavior in reversed(answer.design.structures[0]))
    return Result(
        **about, **where.earned(answer.design)._asdict(), structure=structure, spent=answer.spent,
        seconds=round(wall, 3), processor=round(processor, 3), curve=answer.curve,
    )  # fmt: skip


def search(where: Task, name: str, budget: int, seed: int) -> Answer:
    """Search for a design with a budget. Raises CannotDesign."""
    if name == PAPER:
        return _paper(where, budget, seed)
    with method_of(name) as method:
        return _rounds(where, method, budget, seed)


def _rounds(where: Task, method: str, budget: int, seed: int) -> Answer:
    settings = replace(settings_of(where.loaded.meaning), method=method, budget=budget)  # type: ignore[arg-type]
    course = Course(where.arena.problem, settings, run_key(seed, 0), 0)
    try:
        reached = course.start(budget)
    except TooManyJointCells as reason:
        raise CannotDesign(str(reason)) from None
    curve = []
    for reached, line in course.steps(reached, [budget]):  # noqa: B007, B020 - the last one counts
        if line is not None:
            curve.append((int(line["episodes"]), float(line["mean"])))
    if reached.answer is None or not isinstance(reached.state, Searching):
        raise RuntimeError("a search ended without an answer")
    return Answer(where.arena.space.designs([reached.answer]), reached.state.spent, tuple(curve))


def _paper(where: Task, budget: int, seed: int) -> Answer:
    """Run the paper's loop for as many generations as the search's part allows, then the race of all methods."""
    path = where.paper_path
    if path is None:
        raise CannotDesign("no spec has settings of the paper's loop for this task")
    settings = settings_of(bbsd.load(path).meaning)
    each = settings.coevolution.agents * settings.learning.episodes
    count = search_budget(budget) // each
    if count < 1:
        raise CannotDesign(f"a generation of the paper's loop takes {each:,} episodes")
    loaded = bbsd.load(path, set=[f"design.coevolution.generations={count}"])
    problem, settings = compile_meaning(loaded.meaning), settings_of(loaded.meaning)
    states = (
        reached.state
        for reached, _ in generations(start(problem, settings, seed, 0), problem, settings, seed)
        if isinstance(reached.state, State) and reached.state.generation == count
    )
    champions, spent = next(states).champions, count * each  # before the race of the paper's loop
    race = final_race(
        SearchState(spent=spent, champions=champions), where.arena, run_key(seed, 0), budget - spent
    )
    return Answer(race.design, spent + race.spent, ())
