"""Tabular Q-learning: one table over the joint partition, of which the behaviors take over what they can.

What is learned is which action controls in each joint cell, whoever's it is. Behaviors and layers can seldom do just
that; the projections that lose the least become candidates, and the joint policy stays as a reference beside them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation import Agents, returns_of
from bbsd.evaluation.sums import row_means
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.champions import no_champions
from bbsd.solver.methods.method import Method, SearchState, with_champions
from bbsd.solver.methods.nomination import begun
from bbsd.solver.methods.q_learning.backup import learn_backwards
from bbsd.solver.methods.q_learning.projection import projection
from bbsd.solver.space import Designs, uniforms
from bbsd.stopping import raise_if_stopped

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler.joint_control import JointControl
    from bbsd.compiler.steps import Steps
    from bbsd.solver.arena import Arena

LEARNING, NOISE, RATES, CHECKED, ORDERS = (
    name_word(name) for name in ("learning", "noise", "rates", "checked", "orders")
)

CAPACITY = 1000
MOST_VALUES = 1_000_000
"""Joint cells times joint choices: a table of values takes 8 MB, and is written into every checkpoint."""
DISCOUNT, TRACE = 0.99, 0.9
START, LEAST = 20.0, 0.01
"""How values move, see `learn_backwards`."""
EPISODES = 200
"""Episodes of a round that learns, where the budget is small; else it is divided into so many rounds:"""
ROUNDS = 400
TABLES = 8
"""Tables that the episodes of a round follow, each the best by values with noise of its own."""
WIDE_RATES = (1.0, 0.5, 0.5, 0.25, 0.25, 0.25)
RATES_LATER = (0.25, 0.125, 0.0625, 0.03125, 0.015625, 0.0)
"""How often robots stray from a table, in the first part of the budget and later."""
WIDE_PART = 0.15
CHECK_EVERY = 10
"""Rounds that learn from one check of what was learned to the next."""
MOST_ORDERS = 64
"""Random orders whose projections are compared by what they lose."""
PROJECTIONS, CHECK_EPISODES = 4, 50
"""The best projections that are tried, and common episodes of these and the joint policy."""
FORGETTING = 0.95
"""What the joint cells met in one round weigh beside those of the next."""


class TooManyJointCells(ValueError):
    """A joint partition too fine for a table of values."""


@dataclass(frozen=True, eq=False, kw_only=True)
class QState(SearchState):
    """What Q-learning keeps."""

    values: NDArray[np.float64]
    """What each joint choice is worth in each joint cell, (n_joint_cells, n_choices)."""
    counts: NDArray[np.int64]
    """How often each was learned about."""
    weights: NDArray[np.float64]
    """How often each joint cell was met lately, (n_joint_cells,)."""
    joint_table: NDArray[np.uint8]
    """The best joint policy so far, (n_joint_cells,): a reference, no design."""
    joint_mean: float = float("nan")
    """Its mean return in the episodes of the last check."""
    projected_mean: float = float("nan")
    """That of the best projection of the last check, in the same episodes."""
    loss: float = float("nan")
    """What the choices of the projection that loses least are worth less than the best, for each choice."""


def has_room(arena: Arena) -> bool:
    """Tell whether the joint partition is small enough for a table of values."""
    partition = arena.joint_control.partition
    return partition.is_exact and partition.n_cells * arena.joint_control.n_choices <= MOST_VALUES


def begin(arena: Arena, key: int, budget: int) -> QState:
    """Return the state before the first round.

    Raises:
        TooManyJointCells: the joint partition is too fine for a table.
    """
    del key, budget
    control = arena.joint_control
    if not has_room(arena):
        raise TooManyJointCells("the joint partition is too fine for a table of values of every joint choice")
    shape = (control.partition.n_cells, control.n_choices)
    return QState(
        champions=no_champions(arena.problem, CAPACITY),
        values=np.zeros(shape),
        counts=np.zeros(shape, np.int64),
        weights=np.zeros(shape[0]),
        joint_table=np.zeros(shape[0], np.uint8),
    )


def advance(state: QState, arena: Arena, key: int, budget: int) -> QState:
    """Learn from episodes; every few rounds, and at last, check what was learned instead."""
    state = begun(state, arena, key, budget)
    stream, left = fold(key, word_of(state.round)), budget - state.spent
    last_check = min((PROJECTIONS + 2) * CHECK_EPISODES, budget // 3)
    if state.round % (CHECK_EVERY + 1) == CHECK_EVERY or left <= max(1, last_check):
        return _checked(state, arena, stream, budget)
    count = min(max(EPISODES, budget // ROUNDS), left - last_check)
    control = arena.joint_control
    pool = _noisy_tables(state, control, fold(stream, NOISE))
    members = (np.arange(count) % len(pool))[:, np.newaxis]
    rates = np.array(WIDE_RATES if state.spent < WIDE_PART * budget else RATES_LATER)
    drawn = rates[(uniforms(fold(stream, RATES), (count,)) * len(rates)).astype(np.int64)]
    values, counts = state.values.copy(), state.counts.copy()

    def learn(steps: Steps, steps_taken: NDArray[np.float64]) -> None:
        raise_if_stopped()
        asked = steps.asked[:, :, 0, :]
        learn_backwards(
            asked, steps.gains, steps_taken, control.possible, values, counts, DISCOUNT, TRACE, START, LEAST
        )

    team = control.joint_problem.assemble((pool,), members, arena.generation)
    team.practice(
        keys(fold(stream, LEARNING), 0, count),
        np.zeros((count, 1), np.int64),
        drawn,
        np.ones(len(values), np.uint8),
        learn,
    )
    met = (counts - state.counts).sum(axis=1)
    return replace(
        state,
        round=state.round + 1,
        spent=state.spent + count,
        values=values,
        counts=counts,
        weights=FORGETTING * state.weights + met,
    )


def _noisy_tables(state: QState, control: JointControl, stream: int) -> NDArray[np.uint8]:
    """Return the best joint choices by values with noise, the less the more often a choice was learned about.

    In joint cells that were never met, nobody controls.
    """
    met = np.flatnonzero(state.counts.any(axis=1))
    shape = (TABLES, len(met), control.n_choices)
    noise = uniforms(stream, shape) + uniforms(fold(stream, NOISE), shape) - 1
    noise[0] = 0
    noisy = state.values[met] + noise * _spread(state, control) / np.sqrt(1.0 + state.counts[met])
    tables = np.zeros((TABLES, len(state.counts)), np.uint8)
    tables[:, met] = np.where(control.possible[met], noisy, -np.inf).argmax(axis=2)
    return tables


def _spread(state: QState, control: JointControl) -> float:
    """Return how far the values that are known lie apart."""
    known = state.values[control.possible & (state.counts > 0)]
    return float(known.max() - known.min()) if len(known) else 1.0


def _known_values(state: QState, control: JointControl) -> NDArray[np.float64]:
    """Return the values, in which a choice that is impossible or was never tried is the worst of all."""
    known = control.possible & (state.counts > 0)
    worst = state.values[known].min() if known.any() else 0.0
    return np.where(known, state.values, worst - 1)


def _checked(state: QState, arena: Arena, stream: int, budget: int) -> QState:
    """Return the state after the joint policy and its best projections ran in common episodes."""
    space, control = arena.space, arena.joint_control
    values = _known_values(state, control)
    orders = np.unique(space.random_orders(fold(stream, ORDERS), MOST_ORDERS), axis=0)
    if len(state.champions.structures):
        near = [state.champions.structures[0], *space.neighboring_orders(state.champions.structures[0])]
        orders = np.unique(np.concatenate([orders, near]), axis=0)
    found = [projection(control, space.given, values, state.weights, order) for order in orders]
    losses = np.array([each.loss for each in found])
    few = max(1, min(PROJECTIONS, budget - state.spent - 1))
    best = np.argsort(losses, kind="stable")[:few]
    designs = Designs(np.stack([found[index].table for index in best]), orders[best])
    count = min(CHECK_EPISODES, (budget - state.spent) // len(designs))
    episodes = fold(stream, CHECKED)
    means = arena.means(designs, episodes, count)
    state = replace(
        state,
        round=state.round + 1,
        spent=state.spent + count * len(designs),
        champions=with_champions(state.champions, designs, means),
        projected_mean=float(means.max()),
        loss=float(losses[best[0]]),
    )
    policies = np.stack([state.joint_table, values.argmax(axis=1).astype(np.uint8)])
    if state.spent + 2 * count > budget:
        return state
    joint_means = _joint_means(arena, policies, episodes, count)
    better = int(np.argmax(joint_means))
    return replace(
        state,
        spent=state.spent + 2 * count,
        joint_table=policies[better],
        joint_mean=float(joint_means[better]),
    )


def _joint_means(arena: Arena, policies: NDArray[np.uint8], stream: int, count: int) -> NDArray[np.float64]:
    """Return the mean return of each joint policy in the same episodes of a stream, (n_policies,)."""
    members = np.arange(len(policies))[:, np.newaxis]
    agents = Agents((policies,), members, np.zeros((len(policies), 1), np.int64))
    return row_means(
        returns_of(arena.joint_control.joint_problem, agents, keys(stream, 0, count), arena.generation)
    )


METHOD = Method("q", begin, advance)
