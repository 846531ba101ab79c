"""The table of transitions of an environment that steps by one, as Gymnasium's Taxi, FrozenLake and CliffWalking do.

Such an environment has finitely many states, observes its state as one whole number, and keeps in `P` what may follow:
`P[state][action]` lists (probability, next state, reward, ended). Copied into arrays it needs no Python to step.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from math import fsum, isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from collections.abc import Mapping

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]

MOST_ENTRIES = 200_000
"""Outcomes of a table at most: a kernel is given up to four numbers for each."""
TOLERANCE = 1e-9
"""How far a sum of probabilities may be from 1."""


class NoTable(Exception):
    """An environment without a table of transitions that can be used; the message says why."""


class Transition(NamedTuple):
    """What may follow an action: the next state, the reward, and whether the episode is over then."""

    next_state: int
    reward: float
    ended: bool


@dataclass(frozen=True, eq=False)
class TransitionTable:
    """All transitions of an environment with finitely many states.

    The first three arrays are (n_states, n_actions, n_outcomes); outcomes of one action are all different, and where it
    has fewer than others, the last ones have probability 0.
    """

    probabilities: Floats
    next_states: Integers
    rewards: Floats
    ended: npt.NDArray[np.bool_]
    starts: Floats
    """The probability that an episode starts in a state, (n_states,)."""
    most_steps: int | None = None
    """The steps after which the environment ends an episode, if it does."""

    @property
    def n_states(self) -> int:
        """The number of states."""
        return len(self.probabilities)

    @property
    def n_actions(self) -> int:
        """The number of actions."""
        return int(self.probabilities.shape[1])

    @property
    def n_outcomes(self) -> int:
        """The most outcomes that an action has in a state."""
        return int(self.probabilities.shape[2])

    @cached_property
    def cumulative(self) -> Floats:
        """The probability of an outcome or one before it, 1 from the last possible outcome on; as `probabilities`.

        The outcome of a uniform number u from [0, 1) is the first whose cumulative probability is greater than u.
        """
        sums = np.cumsum(self.probabilities, axis=2)
        later = np.cumsum(self.probabilities[..., ::-1], axis=2)[..., ::-1] - self.probabilities
        return np.where(later > 0.0, sums, 1.0)

    @cached_property
    def first_states(self) -> tuple[Integers, Floats]:
        """The states that an episode may start in, and the probability of one or one before it; (n,) each."""
        states = np.flatnonzero(self.starts > 0.0)
        sums = np.cumsum(self.starts[states])
        sums[-1] = 1.0
        return states, sums

    @cached_property
    def digest(self) -> str:
        """A digest of all numbers of the table."""
        content = sha256(repr((self.probabilities.shape, self.most_steps)).encode())
        for array in (self.probabilities, self.next_states, self.rewards, self.ended, self.starts):
            content.update(np.ascontiguousarray(array).astype(array.dtype.newbyteorder("<")).tobytes())
        return content.hexdigest()[:32]

    def transitions(self, state: int, action: int) -> dict[Transition, float]:
        """Return all that may follow an action in a state, and its probability."""
        at = state, action
        columns = zip(
            self.next_states[at].tolist(), self.rewards[at].tolist(), self.ended[at].tolist(), strict=True
        )
        probabilities = self.probabilities[at].tolist()
        return {
            Transition(*column): probability
            for column, probability in zip(columns, probabilities, strict=True)
            if probability > 0.0
        }


def has_table(environment: Any) -> bool:  # noqa: ANN401 - any environment
    """Return whether an environment, unwrapped, claims to have a table of transitions."""
    return getattr(environment, "P", None) is not None


def copied_table(environment: Any) -> TransitionTable:  # noqa: ANN401 - any environment
    """Return the table of an environment, unwrapped, without looking whether the environment keeps to it.

    Raises NoTable.
    """
    n_states = _discrete(environment, "observation_space", "observations")
    n_actions = _discrete(environment, "action_space", "actions")
    if n_states * n_actions > MOST_ENTRIES:
        raise NoTable(f"it has {n_states} states and {n_actions} actions: too many")
    rows = [
        [
            _merged(_outcomes(environment.P, state, action), state, action, n_states)
            for action in range(n_actions)
        ]
        for state in range(n_states)
    ]
    n_outcomes = max(len(outcomes) for row in rows for outcomes in row)
    if n_states * n_actions * n_outcomes > MOST_ENTRIES:
        raise NoTable(
            f"it has {n_states} states, {n_actions} actions and up to {n_outcomes} outcomes of each: too many"
        )
    return _table(rows, n_outcomes, _starts(environment, n_states))


def table_of(
    rows: Sequence[Sequence[Mapping[Transition, float]]], starts: Sequence[float]
) -> TransitionTable:
    """Return a table from the probabilities of transitions by state and action, and those of the first states."""
    n_outcomes = max(len(outcomes) for row in rows for outcomes in row)
    return _table(rows, n_outcomes, np.array(starts, np.float64))


def _discrete(environment: Any, name: str, what: str) -> int:  # noqa: ANN401 - any environment
    """Return the size of a Discrete space that begins with 0. Raises NoTable."""
    space = getattr(environment, name, None)
    size = getattr(space, "n", None)
    if not isinstance(size, int | np.integer) or size < 1:
        raise NoTable(f"its {what} are not the whole numbers of a Discrete space")
    if getattr(space, "start", 0) != 0:
        raise NoTable(f"its {what} do not begin with 0")
    return int(size)


def _outcomes(table: Any, state: int, action: int) -> Iterable[Sequence[Any]]:  # noqa: ANN401 - what P holds
    try:
        outcomes = table[state][action]
    except (KeyError, IndexError, TypeError):
        raise NoTable(f"its table has no action {action} in state {state}") from None
    if not isinstance(outcomes, Sequence | np.ndarray) or len(outcomes) == 0:
        raise NoTable(f"its table lists no outcomes of action {action} in state {state}")
    return outcomes


def _merged(
    outcomes: Iterable[Sequence[Any]], state: int, action: int, n_states: int
) -> dict[Transition, float]:
    """Return the probability of each different outcome, in the order of the first of its kind. Raises NoTable."""
    where = f"action {action} in state {state}"
    shares: dict[Transition, list[float]] = {}
    for outcome in outcomes:
        try:
            probability, next_state, reward, ended = outcome
            transition = Transition(int(next_state), float(reward), bool(ended))
            share = float(probability)
        except (TypeError, ValueError):
            raise NoTable(f"an outcome of {where} is not (probability, next state, reward, ended)") from None
        if not 0 <= transition.next_state < n_states or transition.next_state != next_state:
            raise NoTable(f"an outcome of {where} is none of the {n_states} states")
        if not isfinite(transition.reward):
            raise NoTable(f"a reward of {where} is not finite")
        if not 0.0 <= share <= 1.0 + TOLERANCE:
            raise NoTable(f"a probability of {where} is {share:g}")
        shares.setdefault(transition, []).append(share)
    merged = {transition: fsum(parts) for transition, parts in shares.items() if fsum(parts) > 0.0}
    total = fsum(merged.values())
    if abs(total - 1.0) > TOLERANCE:
        raise NoTable(f"the probabilities of {where} add up to {total:.12g}")
    return merged


def _starts(environment: Any, n_states: int) -> Floats:  # noqa: ANN401 - any environment
    """Return the probabilities of the states that an episode starts in. Raises NoTable."""
    try:
        starts = np.array(environment.initial_state_distrib, np.float64)
    except AttributeError:
        raise NoTable("it does not tell the states that it starts in (initial_state_distrib)") from None
    except (TypeError, ValueError):
        raise NoTable("its initial_state_distrib is not a list of probabilities") from None
    if starts.shape != (n_states,) or not (starts >= 0.0).all():
        raise NoTable(f"its initial_state_distrib is not a list of {n_states} probabilities")
    if abs(fsum(starts.tolist()) - 1.0) > TOLERANCE:
        raise NoTable(f"the probabilities of its first states add up to {fsum(starts.tolist()):.12g}")
    return starts


def _table(
    rows: Sequence[Sequence[Mapping[Transition, float]]], n_outcomes: int, starts: Floats
) -> TransitionTable:
    shape = (len(rows), len(rows[0]), n_outcomes)
    table = TransitionTable(
        np.zeros(shape), np.zeros(shape, np.int64), np.zeros(shape), np.zeros(shape, np.bool_), starts
    )
    for state, row in enumerate(rows):
        for action, outcomes in enumerate(row):
            for place, (transition, probability) in enumerate(outcomes.items()):
                at = state, action, place
                table.probabilities[at] = probability
                table.next_states[at], table.rewards[at], table.ended[at] = transition
    return table
