"""Teams whose environment is stepped in Python, divided among processes: threads would wait for each other's steps.

An agent's episode depends on its own key, tables and structure alone, so who runs it changes no bit.
"""

from __future__ import annotations

import atexit
import pickle
from concurrent.futures import BrokenExecutor
from contextlib import suppress
from dataclasses import fields
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from bbsd.compiler.team import DetailedOutcome, Outcome, Team
from bbsd.engines.engine import ATTEMPTS
from bbsd.engines.processes import started_processes
from bbsd.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from concurrent.futures import Future

    from bbsd.compiler.kernels import Kernels
    from bbsd.compiler.steps import Steps
    from bbsd.compiler.tables import Pool
    from bbsd.compiler.team import Floats, Integers, Keys, Learn
    from bbsd.engines.processes import Processes

NEEDED = ("bbsd.compiler.divided",)
"""What processes import before their first episode."""
WORTH_DIVIDING = 2_000
"""Steps of a process from which on a call is divided: some 50 ms in a fast environment."""


class StepperKilled(UsageError):
    """Processes that stepped environments and were killed, again and again."""

    advice = "fewer --jobs need less memory; with --jobs 1 environments are stepped in bbsd's own process"

    def __init__(self) -> None:
        super().__init__(
            f"{ATTEMPTS} processes that stepped the environment were killed, maybe by the system for lack of memory, "
            "maybe by the environment itself"
        )


class Share(NamedTuple):
    """Agents that live in one process, and what they are asked for."""

    pools: tuple[Pool, ...]
    members: Integers
    constants: Floats
    method: str
    arguments: tuple[Any, ...]
    """Of the method."""

    def done_by(self, kernels: Kernels) -> Any:  # noqa: ANN401 - what the method returns
        """Return what the agents give; of practice also what it records."""
        team = Team(kernels, self.pools, self.members, self.constants)
        method = getattr(team, self.method)
        if self.method != "practice":
            return method(*self.arguments)
        records: list[tuple[Steps, Floats]] = []
        returns = method(*self.arguments, lambda *record: records.append(record))
        return returns, records


class DividedTeam(Team):
    """A team whose agents live in several processes, some of them in this one."""

    def __init__(
        self, kernels: Kernels, pools: tuple[Pool, ...], members: Integers, constants: Floats
    ) -> None:
        super().__init__(kernels.alone, pools, members, constants)
        self._divided, self._pools, self._members, self._constants = kernels, pools, members, constants

    def episode(self, keys: Keys, structures: Integers) -> Outcome:
        """Run one episode of each agent, as a team in one process does."""
        if self._n_parts == 1:
            return super().episode(keys, structures)
        outcome: Outcome = self._lived("episode", keys, structures)
        return outcome

    def detailed_episode(self, keys: Keys, structures: Integers) -> DetailedOutcome:
        """Run the same episode and return everything that an evaluation reports."""
        if self._n_parts == 1:
            return super().detailed_episode(keys, structures)
        outcome: DetailedOutcome = self._lived("detailed_episode", keys, structures)
        return outcome

    def practice(
        self, keys: Keys, structures: Integers, rates: Floats, open_cells: Pool, learn: Learn
    ) -> Floats:
        """Run one episode of each agent that strays from its tables, as a team in one process does."""
        if self._n_parts == 1:
            return super().practice(keys, structures, rates, open_cells, learn)
        size = min(self.kernels.lanes, -(-self.size // self._n_parts))
        which = [np.arange(first, min(first + size, self.size)) for first in range(0, self.size, size)]
        shares = [
            self._share("practice", agents, keys[agents], structures[agents], rates[agents], open_cells)
            for agents in which
        ]
        returns = []
        for agents, (returned, records) in zip(which, _done(self._divided, shares), strict=True):
            returns.append(returned)
            for steps, steps_taken in records:
                learn(steps._replace(first=steps.first + int(agents[0])), steps_taken)
        return np.concatenate(returns)

    @property
    def _n_parts(self) -> int:
        """Among how many processes the agents are divided."""
        steps = self.size * self.kernels.meaning.spec.environment.steps
        return max(1, min(self._divided.jobs, self.size, steps // WORTH_DIVIDING))

    def _share(self, method: str, agents: Integers, *arguments: object) -> Share:
        return Share(self._pools, self._members[agents], self._constants, method, arguments)

    def _lived(self, method: str, keys: Keys, structures: Integers) -> Any:  # noqa: ANN401 - an outcome
        """Let agents live, every so-manieth one in the same process, and put their outcomes together."""
        which = [np.arange(part, self.size, self._n_parts) for part in range(self._n_parts)]
        shares = [self._share(method, agents, keys[agents], structures[agents]) for agents in which]
        outcomes = list(_done(self._divided, shares))
        order = np.argsort(np.concatenate(which))
        kind = type(outcomes[0])
        return kind(*(_joined(outcomes, field.name)[order] for field in fields(kind)))


def _joined(outcomes: Sequence[Outcome | DetailedOutcome], name: str) -> Floats:
    joined: Floats = np.concatenate([getattr(outcome, name) for outcome in outcomes])
    return joined


def _done(kernels: Kernels, shares: Sequence[Share]) -> Iterator[Any]:
    """Yield what the shares give, in their order; this process does the last of every `jobs` shares."""
    processes, jobs = _ready(kernels.jobs - 1), kernels.jobs
    try:
        futures = {
            place: _submitted(processes, kernels, share)
            for place, share in enumerate(shares)
            if place % jobs < jobs - 1
        }
        own = {
            place: share.done_by(kernels.alone) for place, share in enumerate(shares) if place not in futures
        }
        for place, share in enumerate(shares):
            yield own[place] if place in own else _result(futures[place], processes, kernels, share)
    except BaseException:
        _ready.cache_clear()
        processes.stop()
        raise


def _submitted(processes: Processes, kernels: Kernels, share: Share) -> Future[Any]:
    return processes.submit(_do, kernels.recipe, share)


def _result(future: Future[Any], processes: Processes, kernels: Kernels, share: Share) -> Any:  # noqa: ANN401 - what it gives
    """Wait for what a share gives; one whose process was killed is done again by another. Raises StepperKilled."""
    for _ in range(ATTEMPTS - 1):
        with suppress(BrokenExecutor):
            return future.result()
        future = _submitted(processes, kernels, share)
    try:
        return future.result()
    except BrokenExecutor:
        raise StepperKilled from None


@lru_cache(1)
def _ready(count: int) -> Processes:
    """Return so many processes, which wait for work until this one ends."""
    processes = started_processes(count, NEEDED)
    atexit.register(processes.end)
    return processes


def _do(recipe: bytes, share: Share) -> Any:  # noqa: ANN401 - what the share gives
    return share.done_by(_kernels(recipe))


@lru_cache(4)
def _kernels(recipe: bytes) -> Kernels:
    kernels: Kernels = pickle.loads(recipe)  # noqa: S301 - from the process that started this one
    return kernels
