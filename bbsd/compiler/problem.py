"""The compiled problem: what the method and the evaluation know of a spec, arrays only."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.compiler.details import checked_slots
from bbsd.compiler.divided import DividedTeam
from bbsd.compiler.kernels import Kernels
from bbsd.compiler.tables import Pool, TableShape, shape_of
from bbsd.compiler.tabulated import tabulated
from bbsd.compiler.team import Team
from bbsd.language.meaning.size import Size, size_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from bbsd.environments.stepping import Stepper
    from bbsd.environments.tables import TransitionTable
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning

DEFAULT_LANES = 40

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]


@dataclass(frozen=True)
class Problem:
    """A spec compiled for some number of lanes, or as plain Python."""

    meaning: Meaning
    tables: tuple[TableShape, ...]
    layers: Integers
    """The layers, lowest first: a behavior where given, -1 where open."""
    candidates: Integers
    """Behaviors that may fill the open layers."""
    lanes: int
    compiled: bool
    jobs: int = 1
    """Threads that share the lanes; the outcome is the same for any number."""
    stepper: Callable[[], Stepper] | None = None
    """Makes what steps the environment, if it is stepped in Python and may be imported."""
    table: TransitionTable | None = None
    """The transitions of the environment, if it is stepped by them instead."""

    @property
    def n_behaviors(self) -> int:
        """The number of behaviors."""
        return len(self.tables)

    @property
    def names(self) -> tuple[str, ...]:
        """The behaviors' names in the spec's order."""
        return tuple(table.name for table in self.tables)

    @property
    def is_stepped(self) -> bool:
        """Whether the environment is stepped in Python; not where a table of its transitions replaces it."""
        return self.kernels.is_stepped

    @property
    def learns_structure(self) -> bool:
        """Whether more than one structure is possible."""
        return self.meaning.structure.is_open

    @property
    def has_holes(self) -> bool:
        """Whether anything is left to be designed."""
        return self.size.open_layers > 0 or self.size.open_cells > 0

    def evolves(self, behavior: int) -> bool:
        """Whether a behavior has cells to be designed."""
        return self.tables[behavior].n_open > 0 and self.meaning.structure.may_hold(behavior)

    @property
    def decades(self) -> float:
        """The size of the search space, all tables and orders, as a logarithm to base 10."""
        return self.size.decades

    @cached_property
    def size(self) -> Size:
        """What is open, and how many designs there are."""
        return size_of(self.meaning.episode.modules, self.meaning.structure)

    @property
    def checked_slots(self) -> list[Slot]:
        """Where a detailed outcome counts values that are not finite."""
        return checked_slots(self.meaning.episode)

    @cached_property
    def kernels(self) -> Kernels:
        """The rollouts, printed and loaded when they are first run."""
        return Kernels(self.meaning, self.tables, self.lanes, self.compiled, self.jobs, stepper=self.stepper)

    def with_meaning(self, meaning: Meaning) -> Problem:
        """Return the problem of another meaning in the same environment, which runs as this one does."""
        return compile_meaning(
            meaning,
            lanes=self.lanes,
            compiled=self.compiled,
            jobs=self.jobs,
            stepper=self.stepper,
            table=self.table,
        )

    def assemble(self, pools: Sequence[Pool], members: Integers, generation: int) -> Team:
        """Return agents of individuals from the pools, in the constants of a generation.

        Args:
            pools: of each behavior, (n_individuals, n_cells).
            members: the individual of each pool that each agent is made of, (n_agents, n_behaviors).
            generation: counted from 1.
        """
        constants = np.array(self.meaning.constants.vector(generation), np.float64)
        make = DividedTeam if self.kernels.is_stepped and self.jobs > 1 else Team
        return make(self.kernels, tuple(pools), members, constants)


def compile_meaning(
    meaning: Meaning,
    *,
    lanes: int | None = None,
    compiled: bool = True,
    jobs: int = 1,
    stepper: Callable[[], Stepper] | None = None,
    table: TransitionTable | None = None,
) -> Problem:
    """Return the problem of a spec's meaning; its kernels are printed and compiled when they are first run.

    As plain Python, one lane at a time is the default. An environment that is stepped in Python needs a stepper before
    the first episode. With one, the kernels of any spec are printed in phases. With a table of its transitions it needs
    none, since nothing is stepped in Python; raises NotTabulated where the spec does not go with the table.
    """
    if table is not None and meaning.episode.outside:
        meaning = tabulated(meaning, table)
    structure = meaning.structure
    return Problem(
        meaning,
        tuple(
            shape_of(module, left_out=index not in (*structure.layers, *structure.candidates))
            for index, module in enumerate(meaning.episode.modules)
        ),
        np.array(structure.layers, np.int64),
        np.array(structure.candidates, np.int64),
        lanes or (DEFAULT_LANES if compiled else 1),
        compiled,
        jobs,
        None if table else stepper,
        table,
    )
