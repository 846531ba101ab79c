"""Graceful degradation: what a design earns under each of some faults, and with its order learned again around them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from bbsd.evaluation import Agents, Interval, agents_of, interval, returns_of
from bbsd.evaluation.faults import faulty_meaning
from bbsd.evaluation.frames import frame
from bbsd.evaluation.sums import mean, row_means
from bbsd.explanation.worth.orders import tried_orders
from bbsd.explanation.worth.results import clearly_above
from bbsd.explanation.worth.variants import RANDOM_TABLES, with_random_tables
from bbsd.kernel.keys import keys as keys_of
from bbsd.kernel.streams import fold, name_word, word_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.evaluation.faults import Fault

Floats = npt.NDArray[np.float64]
Keys = npt.NDArray[np.uint64]
Structure = npt.NDArray[np.int64]

ORDERS = name_word("orders around a fault")
"""Random tables of a behavior whose fault is to be random; each has its part of the episodes."""


@dataclass(frozen=True, slots=True)
class Relearned:
    """The order learned again around a fault, with all tables as they are.

    `change` is beside the undisturbed design, `gain` beside the faulty one in its own order.
    """

    structure: tuple[str, ...]
    """Highest layer first."""
    returns: Interval
    change: Interval
    gain: Interval


@dataclass(frozen=True, slots=True)
class Degradation:
    """What a design earns under a fault, and the change beside the undisturbed design in the same episodes."""

    fault: Fault
    returns: Interval
    change: Interval
    relearned: Relearned | None


@dataclass(frozen=True, slots=True, repr=False)
class Degradations:
    """What a design earns undisturbed, and under each fault alone."""

    returns: Interval
    structure: tuple[str, ...]
    """Highest layer first."""
    faults: tuple[Degradation, ...]
    random_tables: int

    def to_frame(self) -> Any:  # noqa: ANN401 - pandas is optional
        """Return a pandas DataFrame with a row for each fault; `gain` is that of an order learned again.

        Raises NoPandas where pandas is not installed.
        """
        changes = [each.change for each in self.faults]
        gains = [nan if each.relearned is None else each.relearned.gain.mean for each in self.faults]
        columns: dict[str, Sequence[object]] = {
            "fault": [each.fault.text for each in self.faults],
            "return": [each.returns.mean for each in self.faults],
            "change": [change.mean for change in changes],
            "low": [change.low for change in changes],
            "high": [change.high for change in changes],
            "gain": gains,
        }
        return frame(columns, index="fault")

    def __repr__(self) -> str:
        return f"<Degradations: mean return {self.returns.mean:.6g}, {len(self.faults)} faults>"


@dataclass(frozen=True)
class Disturbed:
    """A design under one fault."""

    problem: Problem
    architecture: Architecture
    fault: Fault
    key: int
    generation: int
    n_tables: int

    @cached_property
    def _faulty(self) -> Problem:
        """The problem under the fault, as it is where only the design's tables change."""
        if self._changes_tables:
            return self.problem
        return self.problem.with_meaning(faulty_meaning(self.problem.meaning, self.fault))

    @property
    def _changes_tables(self) -> bool:
        return self.fault.kind == "random" or (self.fault.kind == "silent" and self.fault.since == 1)

    @cached_property
    def _designs(self) -> Agents:
        """The design with its tables as the fault makes them: one agent, or one for each random table."""
        design = agents_of([self.architecture])
        if not self._changes_tables:
            return design
        behavior = self.problem.names.index(self.fault.name)
        if self.fault.kind == "silent":
            return design.held(behavior)
        return with_random_tables(self.problem, self.architecture, behavior, self.key, self.n_tables)

    def returns(self, structures: Sequence[Structure], keys: Keys) -> Floats:
        """Run the design in some orders, (n_orders, n_episodes); each random table has its part of the episodes."""
        n_designs, n_orders = len(self._designs), len(structures)
        each = len(keys) // n_designs
        own = np.tile(keys[: n_designs * each].reshape(n_designs, each), (n_orders, 1))
        agents = self._designs[np.tile(np.arange(n_designs), n_orders)]
        agents = agents.with_structures(np.repeat(np.stack(structures), n_designs, axis=0))
        returns = returns_of(self._faulty, agents, own, self.generation, all_finite=False)
        return returns.reshape(n_orders, -1)

    def interval(self, values: Floats) -> Interval:
        """Return the mean of values by episode with its interval, over the random tables where there are several."""
        n_designs = len(self._designs)
        if not np.isfinite(values).all():
            return interval(values)
        return interval(values) if n_designs == 1 else interval(row_means(values.reshape(n_designs, -1)))

    def learned(self, episodes: int) -> Structure:
        """Return the best order around the fault, or the given one where none is clearly better.

        Of few layers all orders are tried; of many, behaviors change their places as long as it helps.
        """
        best, stream = self.architecture.structure, fold(self.key, ORDERS)
        for climbed in range(len(best)):
            orders, whole = tried_orders(best)
            keys = keys_of(fold(stream, word_of(climbed)), 0, episodes)
            returns = self.returns(orders, keys)
            most = max(range(len(orders)), key=lambda order: _mean_or_worst(returns[order]))
            with np.errstate(invalid="ignore"):
                gain = self.interval(returns[most] - returns[0])
            if not clearly_above(gain):
                break
            best = orders[most]
            if whole:
                break
        return best


def degradations(
    problem: Problem,
    architecture: Architecture,
    faults: Sequence[Fault],
    key: int,
    episodes: int,
    generation: int,
    *,
    relearn: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> Degradations:
    """Run a design undisturbed and under each fault alone, in the same episodes.

    Args:
        problem: the spec.
        architecture: the design.
        faults: of `read_faults`.
        key: names the stream of the episodes.
        episodes: how many there are, at least 2.
        generation: in whose constants they run.
        relearn: whether to learn the order of the layers again around each fault.
        progress: is called with the numbers of faults done and of all.

    Raises:
        RewardNotFinite: a reward of the undisturbed design was infinite or not a number.
    """
    keys, n_tables = keys_of(key, 0, episodes), min(RANDOM_TABLES, episodes)
    base = returns_of(problem, agents_of([architecture]), keys, generation)[0]
    found = []
    for done, fault in enumerate(faults, start=1):
        disturbed = Disturbed(problem, architecture, fault, key, generation, n_tables)
        found.append(_degradation(disturbed, base, keys, relearn=relearn))
        if progress is not None:
            progress(done, len(faults))
    return Degradations(interval(base), _named(problem, architecture.structure), tuple(found), n_tables)


def _mean_or_worst(returns: Floats) -> float:
    """Return the mean of returns, less than all others where a reward was not finite."""
    return mean(returns) if np.isfinite(returns).all() else float("-inf")


def _degradation(disturbed: Disturbed, base: Floats, keys: Keys, *, relearn: bool) -> Degradation:
    structures = [disturbed.architecture.structure]
    if relearn and len(structures[0]) > 1:
        structures.append(disturbed.learned(len(keys)))
    returns = disturbed.returns(structures, keys)
    base = base[: returns.shape[1]]
    relearned = None
    with np.errstate(invalid="ignore"):
        changes, gain = returns - base, returns[-1] - returns[0]
    if len(structures) > 1:
        relearned = Relearned(
            _named(disturbed.problem, structures[1]),
            disturbed.interval(returns[1]),
            disturbed.interval(changes[1]),
            disturbed.interval(gain),
        )
    change = disturbed.interval(changes[0])
    return Degradation(disturbed.fault, disturbed.interval(returns[0]), change, relearned)


def _named(problem: Problem, structure: Structure) -> tuple[str, ...]:
    return tuple(problem.names[behavior] for behavior in reversed(structure.tolist()))
