"""The compiled problem: what the solver and the evaluation know of a spec. Arrays only from here on."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import numpy.typing as npt

from bbsd.compiler.details import Detail, checked_slots
from bbsd.compiler.passes.shared_slots import share_slots
from bbsd.compiler.tables import Pool, TableShape, shape_of
from bbsd.compiler.team import Team
from bbsd.compiler.writing.source import module_source
from bbsd.kernel.modules import load_kernel
from bbsd.language.meaning.size import Size, size_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.compiler.team import Rollout
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.names import Slot

DEFAULT_LANES = 40

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Keys = npt.NDArray[np.uint64]


@dataclass(frozen=True)
class Problem:
    """A spec compiled for some number of lanes, or as plain Python."""

    meaning: Meaning
    tables: tuple[TableShape, ...]
    layers: Integers
    """Lowest first: a behavior where given, -1 where open."""
    candidates: Integers
    """Behaviors that may fill the open layers."""
    lanes: int
    compiled: bool
    jobs: int = 1
    """Threads that share the lanes; what comes out is the same for any number."""

    @property
    def n_behaviors(self) -> int:
        """The number of behaviors."""
        return len(self.tables)

    @property
    def names(self) -> tuple[str, ...]:
        """The behaviors' names in the spec's order."""
        return tuple(table.name for table in self.tables)

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
    def places(self) -> list[Slot]:
        """Where a detailed outcome counts values that are not finite."""
        return checked_slots(self.meaning.episode)

    @cached_property
    def _module(self) -> Any:  # noqa: ANN401 - a generated module
        source = module_source(self.meaning, self.tables, self.lanes, (Detail.CREDIT, Detail.TERMS))
        names = (Detail.CREDIT.value, Detail.TERMS.value)
        return load_kernel(source, "rollout", names, compiled=self.compiled)

    @cached_property
    def threads(self) -> ThreadPoolExecutor:
        """What runs the lanes where there are several jobs."""
        return ThreadPoolExecutor(self.jobs)

    @cached_property
    def rollout(self) -> Rollout:
        """The kernel that the life loop calls."""
        return self._quiet(self._module.rollout)

    @cached_property
    def rollout_detailed(self) -> Rollout:
        """The kernel that evaluation calls."""
        return self._quiet(self._module.rollout_detailed)

    @property
    def memory(self) -> int:
        """How many numbers a kernel works with."""
        return cast("int", self._module.MEMORY)

    def _quiet(self, function: Rollout) -> Rollout:
        """Infinities and NaN are values in every mode; NumPy's scalars would warn of them in plain Python."""
        if self.compiled:
            return function

        def quiet(*arguments: object) -> bool | None:
            with np.errstate(all="ignore"):
                return function(*arguments)

        return quiet

    def assemble(self, pools: Sequence[Pool], members: Integers, generation: int) -> Team:
        """Agents of individuals from the pools: members (n_agents, n_behaviors)."""
        return Team(
            self, tuple(pools), members, np.array(self.meaning.constants.vector(generation), np.float64)
        )


def compile_meaning(
    meaning: Meaning, *, lanes: int | None = None, compiled: bool = True, jobs: int = 1
) -> Problem:
    """Compile a spec's meaning. As plain Python, one lane at a time is the default."""
    structure = meaning.structure
    return Problem(
        share_slots(meaning),
        tuple(
            shape_of(module, left_out=index not in (*structure.layers, *structure.candidates))
            for index, module in enumerate(meaning.episode.modules)
        ),
        np.array(structure.layers, np.int64),
        np.array(structure.candidates, np.int64),
        lanes or (DEFAULT_LANES if compiled else 1),
        compiled,
        jobs,
    )
