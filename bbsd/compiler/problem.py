"""The compiled problem: what the solver and the evaluation know of a spec. Arrays only from here on."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import lgamma, log
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from bbsd.compiler.deciding import ACTION_BITS
from bbsd.compiler.frame import Detail
from bbsd.compiler.merging import merged
from bbsd.compiler.reckoning import odd_slots
from bbsd.compiler.source import module_source
from bbsd.compiler.tables import Pool, TableShape, cells_of, shape_of, words_of
from bbsd.kernel.modules import load_kernel
from bbsd.spec.meaning.structure import OPEN_LAYER

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from bbsd.spec.meaning import Meaning
    from bbsd.spec.meaning.names import Slot

DEFAULT_LANES = 40
NEVER = -(1 << 40)
"""The priority of a behavior that is not in the structure."""

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Keys = npt.NDArray[np.uint64]


@dataclass(frozen=True, slots=True)
class Outcome:
    """An episode of every agent: returns (n_agents,).

    And credit (n_agents, n_behaviors + 1), the last column nobody's.
    """

    returns: Floats
    credit: Floats


@dataclass(frozen=True, slots=True)
class DetailedOutcome:
    """An episode of every agent in detail.

    returns (n,), credit (n, n_behaviors + 1), terms (n, n_terms) in the spec's order, control (n, n_behaviors + 1)
    robot-steps by behavior and nobody, taken (n,) steps, odd (n, n_places) steps in which a value was not finite.
    """

    returns: Floats
    credit: Floats
    terms: Floats
    control: Floats
    taken: Floats
    odd: Floats


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
        return bool((self.layers == OPEN_LAYER).any()) or any(map(self.evolves, range(self.n_behaviors)))

    def evolves(self, behavior: int) -> bool:
        """Whether a behavior has cells to be designed."""
        return self.tables[behavior].n_open > 0 and self.meaning.structure.may_hold(behavior)

    @property
    def decades(self) -> float:
        """The size of the search space, all tables and orders, as a logarithm to base 10."""
        n, k = len(self.candidates), int(np.count_nonzero(self.layers == OPEN_LAYER))
        orders = (lgamma(n + 1) - lgamma(n - k + 1)) / log(10)
        evolved = (table for index, table in enumerate(self.tables) if self.evolves(index))
        return sum(table.decades for table in evolved) + orders

    @property
    def places(self) -> list[Slot]:
        """Where a detailed outcome counts values that are not finite."""
        return odd_slots(self.meaning)

    @cached_property
    def _module(self) -> Any:  # noqa: ANN401 - a generated module
        source = module_source(self.meaning, self.tables, self.lanes, (Detail.CREDIT, Detail.TERMS))
        names = (Detail.CREDIT.value, Detail.TERMS.value)
        return load_kernel(source, "rollout", names, compiled=self.compiled)

    @cached_property
    def rollout(self) -> Callable[..., None]:
        """The kernel that the life loop calls."""
        return self._quiet(self._module.rollout)

    @cached_property
    def rollout_detailed(self) -> Callable[..., None]:
        """The kernel that evaluation calls."""
        return self._quiet(self._module.rollout_detailed)

    def _quiet(self, function: Callable[..., None]) -> Callable[..., None]:
        """Infinities and NaN are values in every mode; NumPy's scalars would warn of them in plain Python."""
        if self.compiled:
            return function

        def quiet(*arguments: object) -> None:
            with np.errstate(all="ignore"):
                function(*arguments)

        return quiet

    def assemble(self, pools: Sequence[Pool], members: Integers, generation: int) -> Team:
        """Agents of individuals from the pools: members (n_agents, n_behaviors)."""
        return Team(
            self, tuple(pools), members, np.array(self.meaning.constants.vector(generation), np.float64)
        )


def compile_meaning(meaning: Meaning, *, lanes: int | None = None, compiled: bool = True) -> Problem:
    """Compile a spec's meaning. As plain Python, one lane at a time is the default."""
    structure = meaning.structure
    return Problem(
        merged(meaning),
        tuple(
            shape_of(module, left_out=index not in (*structure.layers, *structure.candidates))
            for index, module in enumerate(meaning.episode.modules)
        ),
        np.array(structure.layers, np.int64),
        np.array(structure.candidates, np.int64),
        lanes or (DEFAULT_LANES if compiled else 1),
        compiled,
    )


class Team:
    """Agents ready to live: their tables as the kernel reads them.

    Lanes refer to individuals, they do not copy them.
    """

    def __init__(
        self, problem: Problem, pools: tuple[Pool, ...], members: Integers, constants: Floats
    ) -> None:
        self.problem = problem
        self.size = len(members)
        padded = -(-self.size // problem.lanes) * problem.lanes
        self._individuals = np.zeros((problem.n_behaviors, padded), np.int64)
        self._individuals[:, : self.size] = members.T
        self._words = words_of(problem.tables, pools)
        self._cells, self._origins = cells_of(problem.tables, pools)
        self._constants = constants
        self._keys = np.zeros(padded, np.uint64)
        self._priorities = np.full((problem.n_behaviors, padded), NEVER, np.int64)
        actions = [0, *np.cumsum([table.n_actions for table in problem.tables])[:-1]]
        self._first_actions = np.array(actions, np.int64)

    def episode(self, keys: Keys, structures: Integers) -> Outcome:
        """Live one episode: keys (n_agents,) name its streams, structures (n_agents, n_layers) order the behaviors."""
        returns, credit = self._outputs(1)[0], self._outputs(self.problem.n_behaviors + 1)
        self.problem.rollout(*self._inputs(keys, structures), returns, credit)
        return Outcome(returns[: self.size], credit[:, : self.size].T)

    def detailed_episode(self, keys: Keys, structures: Integers) -> DetailedOutcome:
        """The same episode with everything that an evaluation reports."""
        n_behaviors, size = self.problem.n_behaviors, self.size
        returns, taken = self._outputs(1)[0], self._outputs(1)[0]
        credit, control = self._outputs(n_behaviors + 1), self._outputs(n_behaviors + 1)
        terms, odd = (
            self._outputs(len(self.problem.meaning.episode.reward)),
            self._outputs(len(self.problem.places)),
        )
        self.problem.rollout_detailed(
            *self._inputs(keys, structures), returns, credit, terms, control, taken, odd
        )
        return DetailedOutcome(
            returns[:size],
            credit[:, :size].T,
            terms[:, :size].T,
            control[:, :size].T,
            taken[:size],
            odd[:, :size].T,
        )

    def traced_episode(
        self, rollout: Callable[..., None], key: int, structure: Integers, record: Floats
    ) -> int:
        """The first agent's episode by a rollout for one lane that notes every step into record; the steps taken."""
        n_behaviors, keys = self.problem.n_behaviors, np.array([key], np.uint64)
        returns, taken = self._outputs(1)[0], self._outputs(1)[0]
        credit, control = self._outputs(n_behaviors + 1), self._outputs(n_behaviors + 1)
        terms, odd = (
            self._outputs(len(self.problem.meaning.episode.reward)),
            self._outputs(len(self.problem.places)),
        )
        first, _, *inputs = self._inputs(
            np.resize(keys, self.size), np.resize(structure, (self.size, len(structure)))
        )
        with np.errstate(all="ignore"):
            rollout(first, 1, *inputs, returns, credit, terms, control, taken, odd, record)
        return int(taken[0])

    def _outputs(self, rows: int) -> Floats:
        return np.zeros((rows, self._keys.size))

    def _inputs(self, keys: Keys, structures: Integers) -> tuple[object, ...]:
        self._keys[: self.size] = keys
        self._set_priorities(structures)
        arrays = (
            self._keys,
            self._individuals,
            self._words,
            self._cells,
            self._origins,
            self._priorities,
            self._constants,
        )
        return 0, self._keys.size, *arrays

    def _set_priorities(self, structures: Integers) -> None:
        """Higher layers bid higher; what is added makes of a choice the action's number over all behaviors."""
        self._priorities[:] = NEVER
        agents = np.arange(self.size)
        for layer in range(structures.shape[1]):
            behaviors = structures[:, layer]
            self._priorities[behaviors, agents] = ((layer + 1) << ACTION_BITS) + self._first_actions[
                behaviors
            ]
