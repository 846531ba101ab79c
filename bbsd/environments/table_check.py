"""Whether an environment steps by its table of transitions: real steps are compared with what the table says.

The walk is guided by the table: it goes where actions were tried least. So all that can be reached is tried soon, and
an environment that keeps something back, as Taxi with a fickle passenger does, is found out.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from bbsd.environments.lanes.calling import calling
from bbsd.environments.lanes.time_limit import CallWatch
from bbsd.environments.tables import NoTable, Transition, copied_table, has_table
from bbsd.kernel.streams import fold, name_word, unit

if TYPE_CHECKING:
    from bbsd.environments.making import Making
    from bbsd.environments.opening import Opened
    from bbsd.environments.tables import Floats, Integers, TransitionTable

Truths = npt.NDArray[np.bool_]

LEAST_STEPS = 6_000
"""Real steps at least where outcomes are drawn, about 0.2 seconds."""
MOST_STEPS = 40_000
STEPS_OF_A_PAIR = 8
"""Real steps at most for each state and action, beside the least."""
TRIES = 3
"""Tries of each state and action that are wanted where nothing is drawn; of drawn ones, so many of each outcome."""
PLAN = 100
"""Steps until the way to where something is left to try is planned anew."""
KEY = name_word("check of a table of transitions")
SPREAD, SLACK = 6.0, 20.0
"""How far a chi-squared sum may be above its mean: so many standard deviations, and so much.

Chance alone goes beyond in fewer than one of a million checks.
"""


@dataclass(frozen=True, slots=True)
class TableCheck:
    """How thoroughly a table was compared with real steps."""

    steps: int
    tried: int
    """Pairs of a state and an action that were tried."""
    reachable: int
    """Those that there are, of states that an episode can come to."""


def checked_table(opened: Opened) -> tuple[TransitionTable, TableCheck] | None:
    """Return the table of an environment after real steps that agreed with it; None where it claims to have none.

    Raises:
        NoTable: its table cannot be used, or the environment does not keep to it.
        EnvironmentHangs: it takes too long.
    """
    refused = None
    watch = CallWatch(opened.recipe.seconds)
    with calling(lambda: f"{opened.name}, when its table of transitions was checked,", watch):
        try:
            return _checked(opened.making)
        except NoTable as error:
            refused = error
    raise refused


def _checked(making: Making) -> tuple[TransitionTable, TableCheck] | None:
    try:
        environment = making.make()
        if not has_table(environment):
            return None
        table = replace(copied_table(environment), most_steps=making.most_steps)
        if copied_table(making.make()).digest != copied_table(environment).digest:
            raise NoTable("it has another table each time it is made")
        return table, check_table(environment, table)
    except NoTable:
        raise
    except Exception as error:  # noqa: BLE001 - all that somebody else's code may raise
        raise NoTable(f"a step of the check raised {type(error).__name__}: {error}") from None


def check_table(environment: Any, table: TransitionTable) -> TableCheck:  # noqa: ANN401 - any environment
    """Compare real steps of an environment with a table. Raises NoTable where it does something else."""
    walk = _Walk(environment, table)
    reachable = _reachable(table)
    n_pairs = int(reachable.sum()) * table.n_actions
    most = min(MOST_STEPS, LEAST_STEPS + STEPS_OF_A_PAIR * n_pairs)
    wanted = TRIES * table.n_outcomes
    if table.n_outcomes > 1:
        wanted = max(wanted, LEAST_STEPS // n_pairs)
    walk.reset()
    while walk.steps < most and (walk.tries[reachable] < wanted).any():
        left: Truths = walk.tries.min(axis=1) < wanted
        distances = _distances(table, left)
        for _ in range(min(PLAN, most - walk.steps)):
            if not np.isfinite(distances[walk.state]):
                walk.reset()
            walk.step(walk.next_action(distances, wanted))
    walk.require_plausible_counts()
    tried = int((walk.tries[reachable] > 0).sum())
    return TableCheck(walk.steps, tried, n_pairs)


def _reachable(table: TransitionTable) -> Truths:
    """Return whether a state can be one in which something is done, (n_states,)."""
    reachable = table.starts > 0.0
    goes_on = (table.probabilities > 0.0) & ~table.ended
    while True:
        found = np.zeros_like(reachable)
        found[table.next_states[reachable][goes_on[reachable]]] = True
        if not (found & ~reachable).any():
            return reachable
        reachable |= found


def _distances(table: TransitionTable, wanted: Truths) -> Floats:
    """Return the fewest steps to a wanted state, with luck; infinite where there is no way."""
    distances: Floats = np.where(wanted, 0.0, np.inf)
    is_blocked = (table.probabilities <= 0.0) | table.ended
    while True:
        nearer = 1.0 + np.where(is_blocked, np.inf, distances[table.next_states]).min(axis=(1, 2))
        if not (nearer < distances).any():
            return distances
        distances = np.minimum(distances, nearer)


@dataclass
class _Walk:
    """A walk through the real environment that counts what followed."""

    environment: Any
    table: TransitionTable
    state: int = 0
    steps: int = 0
    episodes: int = 0
    tries: Integers = field(init=False)
    """(n_states, n_actions)."""

    def __post_init__(self) -> None:
        shape = self.table.probabilities.shape
        self.tries = np.zeros(shape[:2], np.int64)
        self._counts = np.zeros(shape, np.int64)
        self._starts = np.zeros(shape[0], np.int64)
        self._places: dict[tuple[int, int], dict[Transition, int]] = {}

    def reset(self) -> None:
        """Begin an episode. Raises NoTable where it begins in a state that the table has no start in."""
        seed = fold(KEY, self.episodes) >> 33
        observation, _ = self.environment.reset(seed=seed)
        self.state = self._state(observation)
        if self.table.starts[self.state] <= 0.0:
            raise NoTable(f"an episode began in state {self.state}, which initial_state_distrib excludes")
        self._starts[self.state] += 1
        self.episodes += 1

    def next_action(self, distances: Floats, wanted: int) -> int:
        """Return the action tried least, or one that may lead to where something is left to try."""
        tries = self.tries[self.state]
        if tries.min() < wanted or distances[self.state] == 0.0:
            return int(tries.argmin())
        possible = (self.table.probabilities[self.state] > 0.0) & ~self.table.ended[self.state]
        ahead = np.where(possible, distances[self.table.next_states[self.state]], np.inf).min(axis=1)
        best = np.flatnonzero(ahead == ahead.min())
        return int(best[int(unit(fold(KEY, self.steps + (1 << 40))) * len(best))])

    def step(self, action: int) -> None:
        """Take an action. Raises NoTable where what follows is not in the table."""
        before = self.state
        observation, reward, terminated, truncated, _ = self.environment.step(action)
        came = Transition(self._state(observation), float(reward), bool(terminated or truncated))
        place = self._places_of(before, action).get(came)
        if place is None:
            ended = " and the end" if came.ended else ""
            raise NoTable(
                f"action {action} in state {before} led to state {came.next_state} with reward {came.reward:g}{ended}, "
                "which its table does not list"
            )
        self.tries[before, action] += 1
        self._counts[before, action, place] += 1
        self.steps += 1
        self.state = came.next_state
        if came.ended:
            self.reset()

    def require_plausible_counts(self) -> None:
        """Raise NoTable where outcomes, or first states, came much more or less often than the table says."""
        table = self.table
        expected = table.probabilities * self.tries[..., None]
        if _is_implausible(self._counts, expected, table.n_outcomes):
            raise NoTable("its outcomes do not come as often as its table says")
        if _is_implausible(self._starts, table.starts * self.episodes, table.n_states):
            raise NoTable("its first states do not come as often as initial_state_distrib says")

    def _places_of(self, state: int, action: int) -> dict[Transition, int]:
        pair = state, action
        if pair not in self._places:
            self._places[pair] = {
                transition: place for place, transition in enumerate(self.table.transitions(*pair))
            }
        return self._places[pair]

    def _state(self, observation: Any) -> int:  # noqa: ANN401 - what the environment gives
        try:
            state = int(observation)
        except (TypeError, ValueError):
            raise NoTable("it observes something else than the number of its state") from None
        if not 0 <= state < self.table.n_states:
            raise NoTable(f"it observed {state}, which is none of its {self.table.n_states} states")
        return state


def _is_implausible(counts: Integers, expected: Floats, n_outcomes: int) -> bool:
    """Return whether counts differ from expected ones by more than chance explains, by Pearson's chi-squared sum."""
    counts, expected = counts.reshape(-1, n_outcomes), expected.reshape(-1, n_outcomes)
    possible = expected > 0.0
    off = np.divide((counts - expected) ** 2, expected, out=np.zeros_like(expected), where=possible)
    freedom = float(np.maximum(possible.sum(axis=1) - 1, 0).sum())
    return bool(off.sum() > freedom + SPREAD * (2.0 * freedom) ** 0.5 + SLACK)
