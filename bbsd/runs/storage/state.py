"""How far a run is, and the same as plain arrays."""

from __future__ import annotations

from dataclasses import dataclass, fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.architecture import Architecture
from bbsd.language.meaning.tables.table import OPEN_CELL
from bbsd.runs.storage.checkpoint import CheckpointError
from bbsd.solver.champions import Champions
from bbsd.solver.climb import Climb
from bbsd.solver.early import ENDINGS
from bbsd.solver.methods.method import arrays_of, restored
from bbsd.solver.methods.society import Society
from bbsd.solver.paper.culture import Culture
from bbsd.solver.paper.generation import Census, State
from bbsd.solver.space import Designs
from bbsd.solver.structures import OPEN

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.runs.storage.checkpoint import Arrays
    from bbsd.solver.methods.method import SearchState

RUN, STATE, ANSWER = "run", "state.", "answer."


@dataclass(frozen=True, eq=False, kw_only=True)
class Searching:
    """How far a search is."""

    search: SearchState
    """The method's own state."""
    best: Designs
    """The best so far, one row; none before the first record."""
    best_mean: float = 0.0
    """Its mean return in episodes that took no part in choosing it, and their number."""
    best_count: int = 0
    best_squares: float = 0.0
    """The sum of the squared deviations of its returns from that mean."""
    improved: int = 0
    """Episodes that rounds had spent when it became the best."""
    ended: int = 0
    """Why the latest budget was not spent, by its number in `ENDINGS`."""
    finished: int = 0
    """Budgets that are spent."""
    begun: int = 0
    """Episodes that rounds had spent when the present budget began, and when the last record was made."""
    recorded: int = 0
    measured: int = 0
    """Episodes of measurements in the present budget."""
    other: int = 0
    """Episodes of races, and of measurements in former budgets."""

    @property
    def spent(self) -> int:
        """All episodes so far."""
        return self.search.spent + self.measured + self.other


@dataclass(frozen=True, slots=True, eq=False)
class RunState:
    """How far a run is: its number (from 0), the state of its method, and its latest answer."""

    run: int
    state: State | Searching
    answer: Architecture | None = None
    census: Census | None = None
    """The agents of the generation that ended just now; it is not kept with the state."""


def run_arrays(reached: RunState) -> Arrays:
    """Return all that a run is resumed from as named arrays."""
    arrays = {RUN: np.array(reached.run), **arrays_of(reached.state, STATE)}
    if reached.answer is not None:
        arrays[f"{ANSWER}tables"] = np.concatenate(reached.answer.tables)
        arrays[f"{ANSWER}structure"] = reached.answer.structure
    return arrays


def restored_run(arrays: Arrays, fresh: RunState, problem: Problem) -> RunState:
    """Return the run whose arrays these are, given the same run before its beginning.

    Raises:
        CheckpointError: an array is missing, is of another type or shape, or holds what the problem cannot have.
    """
    try:
        if int(arrays[RUN]) != fresh.run:
            raise CheckpointError(f"it is of run {int(arrays[RUN]) + 1}, not {fresh.run + 1}")
        reached = replace(fresh, state=restored(fresh.state, arrays, STATE), answer=_answer(arrays, problem))
    except (KeyError, TypeError, ValueError) as error:
        raise CheckpointError(f"it lacks what a run of this spec has: {error}") from None
    _require_possible(reached.state, fresh.state, problem)
    return reached


def _answer(arrays: Arrays, problem: Problem) -> Architecture | None:
    if f"{ANSWER}structure" not in arrays:
        return None
    tables, structure = arrays[f"{ANSWER}tables"], arrays[f"{ANSWER}structure"]
    _require_designs(tables[None], structure[None], problem)
    ends = np.cumsum([table.n_cells for table in problem.tables])[:-1]
    return Architecture(tuple(np.split(tables, ends)), structure)


def _require_possible(value: object, fresh: object, problem: Problem) -> None:
    """Raise CheckpointError where a state holds tables or structures that the problem cannot have."""
    if isinstance(value, State) and isinstance(fresh, State):
        _require_pools(value, fresh, problem)
    if isinstance(value, Searching):
        _require(0 <= value.ended < len(ENDINGS), "why the run ended")
    if isinstance(value, Champions | Designs):
        _require_designs(value.tables, value.structures, problem)
    if isinstance(value, Champions):
        _require(value.fitness.shape == value.tables.shape[:1], "the size of the champions' fitness")
    if isinstance(value, Society):
        most = np.concatenate([np.full(table.n_cells, table.n_actions) for table in problem.tables])
        _require(len(value.pools) > 0 and bool(np.all(value.pools <= most)), "the values of a pool")
    if isinstance(value, Culture):
        _require(len(value.memes) == len(value.fitness), "the size of the culture")
        _require_structures(value.memes, problem)
    if isinstance(value, Climb):
        sizes = {len(each) for each in (value.running, value.gains, value.squares, value.tried)}
        _require(len(value.design) == 1 and len(sizes) == 1, "the size of the climb")
    if is_dataclass(value):
        for field in fields(value):
            _require_possible(getattr(value, field.name), getattr(fresh, field.name), problem)
    elif isinstance(value, tuple) and isinstance(fresh, tuple):
        for item, other in zip(value, fresh, strict=True):
            _require_possible(item, other, problem)


def _require_pools(state: State, fresh: State, problem: Problem) -> None:
    for pool, other, table in zip(state.pools, fresh.pools, problem.tables, strict=True):
        _require(pool.shape == other.shape, "a pool's size")
        _require(bool(np.all(pool <= table.n_actions)), "the values of a pool")
    _require(state.fitness.shape == fresh.fitness.shape, "the size of the fitness")
    _require(0 <= state.improved <= state.generation, "the generation that got better")
    _require(0 <= state.ended < len(ENDINGS), "why the run ended")
    _require(0 <= state.generation <= problem.meaning.spec.design.coevolution.generations, "the generation")


def _require_designs(tables: NDArray[Any], structures: NDArray[Any], problem: Problem) -> None:
    given = np.concatenate([table.given for table in problem.tables])
    most = np.concatenate([np.full(table.n_cells, table.n_actions) for table in problem.tables])
    _require(tables.dtype == np.uint8 and tables.shape == (len(structures), len(given)), "the size of tables")
    _require(bool(np.all(tables <= most)), "the values of tables")
    _require(bool(np.all((tables == given) | (given == OPEN_CELL))), "the given cells of tables")
    _require_structures(structures, problem)


def _require_structures(structures: NDArray[Any], problem: Problem) -> None:
    layers = np.asarray(problem.layers)
    _require(structures.dtype == np.int64 and structures.shape[1:] == layers.shape, "the size of structures")
    _require(
        bool(np.all((structures >= 0) & (structures < problem.n_behaviors))), "the behaviors of structures"
    )
    _require(bool(np.all((structures == layers) | (layers == OPEN))), "the given layers of structures")
    ordered = np.sort(structures, axis=1)
    _require(bool(np.all(ordered[:, 1:] != ordered[:, :-1])), "the behaviors of structures")


def _require(is_so: bool, what: str) -> None:
    if not is_so:
        raise CheckpointError(f"{what} cannot be that of a run of this spec")
