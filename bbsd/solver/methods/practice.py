"""Practice: exploring episodes give credit to every single choice, and the best choices make a design.

Where no whole design earns anything there is nothing to select by; choices that vary within an episode still meet the
first reward. Several orders practice side by side, and the worse half of them is dropped at each rung.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation.sums import mean as mean_of
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.champions import no_champions
from bbsd.solver.draws import marks
from bbsd.solver.methods.credit import credit_backwards, learn_values, perturbed_tables, rates_between
from bbsd.solver.methods.method import Method, SearchState, with_champions
from bbsd.solver.methods.nomination import CAPACITY, EPISODES, NOMINATION, begun, with_rest_spent
from bbsd.solver.space import Designs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler.steps import Steps
    from bbsd.solver.arena import Arena

ORDERS, NOISE, STRAYING, EPISODE = (name_word(name) for name in ("orders", "noise", "rates", "episodes"))

PUPILS = 8
"""Orders that practice side by side."""
DRAWN = 64
"""Random orders of which the first different ones are taken."""
RUNGS = (0.15, 0.3, 0.6)
"""Of the budget, what is spent when the worse half of the orders is dropped."""
FEWEST, MOST = 25, 1000
"""Episodes of a round."""
ROUND_SHARE = 1 / 800
"""Of the budget, what a round spends where that is neither too few nor too many episodes."""
MOST_PAIRS, MOST_CELLS = 4_000_000, 20_000_000
"""Pairs of a cell and a choice of all pupils, and cells of all tables of a round, so that memory holds them."""
EVERY = 10
"""Rounds of an order after which its best tables are measured."""
DISCOUNT, MIXING = 0.99, 0.6
RATES = 0.1, 1.0
"""The lowest and the highest rate of straying: many strays show what else there is, few what comes of the tables."""
BEST_PART, PROMISE_STEP = 4, 0.2
"""One part in so many of a round's episodes says what an order promises; how far a round moves that."""
NOISE_SIZE = 1.2
"""Noise of a choice that was never tried, in units of the mean size of credits."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Pupil:
    """What one order has learned."""

    structure: NDArray[np.int64]
    """Lowest layer first, (n_layers,)."""
    credit: NDArray[np.float64]
    """The weighted credits of each pair of a cell and a choice, (n_pairs,)."""
    weight: NDArray[np.float64]
    """The sum of their weights, (n_pairs,)."""
    critic: NDArray[np.float64]
    """The return to be expected from each joint cell on, (n_joint_cells,)."""
    visits: NDArray[np.float64]
    """How often the critic learned of each joint cell, (n_joint_cells,)."""
    size: float = 1.0
    """The mean size of credits in the latest round."""
    rounds: int = 0
    promise: float = -np.inf
    """What the best part of its exploring episodes earned in the latest rounds."""
    standing: float = -np.inf
    """The mean return of the best tables when they were last measured."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PracticeState(SearchState):
    """The orders that practice, and which of them still do."""

    planned: int
    """Episodes that the search was begun with."""
    pupils: tuple[Pupil, ...]
    running: NDArray[np.int64]
    """The indices of the pupils that still practice, (n,)."""


def begin(arena: Arena, key: int, budget: int) -> PracticeState:
    """Return the state before the first round."""
    orders = arena.space.random_orders(fold(key, ORDERS), DRAWN)
    if arena.starts is not None:
        orders = np.concatenate([arena.starts.structures, orders])
    _, first = np.unique(orders, axis=0, return_index=True)
    n_pairs, n_joint = int(arena.space.first_pairs[-1]), arena.problem.kernels.joint.n_cells
    n_pupils = min(PUPILS, max(1, MOST_PAIRS // n_pairs))
    pupils = tuple(
        Pupil(
            structure=orders[index],
            credit=np.zeros(n_pairs),
            weight=np.zeros(n_pairs),
            critic=np.zeros(n_joint),
            visits=np.zeros(n_joint),
        )
        for index in np.sort(first)[:n_pupils]
    )
    return PracticeState(
        champions=no_champions(arena.problem, CAPACITY),
        planned=max(1, budget),
        pupils=pupils,
        running=np.arange(len(pupils)),
    )


def advance(state: PracticeState, arena: Arena, key: int, budget: int) -> PracticeState:
    """Let one order practice for a round and now and then measure its best tables; at a rung drop the worse orders."""
    state = begun(state, arena, key, budget)
    left = budget - state.spent
    rungs = sum(state.spent >= rung * state.planned for rung in RUNGS)
    kept = max(1, PUPILS >> rungs)
    if kept < len(state.running) and left >= len(state.running) * EPISODES:
        return _dropped(measured(state, arena, key, state.running), kept)
    most = min(MOST, max(FEWEST, MOST_CELLS // len(arena.space.given)))
    count = min(max(int(state.planned * ROUND_SHARE), FEWEST), most, left - EPISODES)
    if count < FEWEST // 2:
        return with_rest_spent(state, arena, key, left)
    which = int(state.running[state.round % len(state.running)])
    pupil = practiced(state.pupils[which], arena, fold(key, word_of(state.round)), count)
    state = replace(
        state, round=state.round + 1, spent=state.spent + count, pupils=_with(state.pupils, which, pupil)
    )
    is_last = budget - state.spent < EPISODES + FEWEST // 2
    if pupil.rounds % EVERY == 0 or is_last:
        return measured(state, arena, key, np.array([which]))
    return state


def measured(state: PracticeState, arena: Arena, key: int, which: NDArray[np.int64]) -> PracticeState:
    """Return the state after the best tables of some orders were run in common episodes, and became champions."""
    designs, pupils = [greedy(state.pupils[index], arena) for index in which], state.pupils
    best = designs[0].joined(*designs[1:])
    means = arena.means(best, fold(key, NOMINATION), EPISODES)
    for index, mean in zip(which.tolist(), means.tolist(), strict=True):
        pupils = _with(pupils, index, replace(pupils[index], standing=mean))
    champions = with_champions(state.champions, best, means)
    return replace(state, champions=champions, spent=state.spent + len(which) * EPISODES, pupils=pupils)


def _with(pupils: tuple[Pupil, ...], which: int, pupil: Pupil) -> tuple[Pupil, ...]:
    return (*pupils[:which], pupil, *pupils[which + 1 :])


def _dropped(state: PracticeState, kept: int) -> PracticeState:
    """Return the state with so many of the orders: half of them stand best, the others promise most."""
    pupils = [state.pupils[index] for index in state.running]
    standing = np.argsort([-pupil.standing for pupil in pupils], kind="stable").tolist()
    promising = np.argsort([-pupil.promise for pupil in pupils], kind="stable").tolist()
    best = standing[: -(-kept // 2)]
    best += [index for index in promising if index not in best][: kept - len(best)]
    return replace(state, running=state.running[sorted(best)], round=state.round + 1)


def practiced(pupil: Pupil, arena: Arena, stream: int, count: int) -> Pupil:
    """Return a pupil after so many exploring episodes."""
    space, lanes = arena.space, keys(fold(stream, NOISE), 0, count)
    tables = perturbed_tables(
        pupil.credit, pupil.weight, space.first_pairs, space.given, NOISE_SIZE * pupil.size, lanes,
        marks(len(pupil.credit)),
    )  # fmt: skip
    designs = Designs(tables, np.tile(pupil.structure, (count, 1)))
    pupil = replace(
        pupil,
        credit=pupil.credit.copy(),
        weight=pupil.weight.copy(),
        critic=pupil.critic.copy(),
        visits=pupil.visits.copy(),
    )
    sums, counts = np.zeros_like(pupil.credit), np.zeros_like(pupil.credit)

    def learn(steps: Steps, steps_taken: NDArray[np.float64]) -> None:
        credit_backwards(
            steps.asked, steps.joint_cells, steps.gains, steps_taken, pupil.critic, pupil.visits, sums, counts,
            DISCOUNT, MIXING,
        )  # fmt: skip

    rates = rates_between(*RATES, keys(fold(stream, STRAYING), 0, count))
    returns = arena.practice(designs, fold(stream, EPISODE), rates, learn)
    size = learn_values(pupil.credit, pupil.weight, sums, counts)
    promise = mean_of(np.sort(returns)[-max(1, count // BEST_PART) :])
    if pupil.rounds:
        promise = pupil.promise + (promise - pupil.promise) * PROMISE_STEP
    return replace(pupil, size=size, rounds=pupil.rounds + 1, promise=promise)


def greedy(pupil: Pupil, arena: Arena) -> Designs:
    """Return the design of the best choices."""
    space, silent = arena.space, np.zeros(1, np.uint64)
    tables = perturbed_tables(
        pupil.credit, pupil.weight, space.first_pairs, space.given, 0.0, silent, marks(len(pupil.credit))
    )
    return Designs(tables, pupil.structure[np.newaxis])


METHOD = Method("practice", begin, advance)
