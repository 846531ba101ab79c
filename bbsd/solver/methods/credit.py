"""Credit to single choices: episodes of practice read backwards, each choice compared with what was expected there.

It extends (13), learning in a lifetime, from pairs of a layer and a behavior to pairs of a cell and a choice. What was
expected comes from a critic, a value for each joint cell; returns are mixed over steps as in TD(lambda) (Sutton 1988).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.functions import exp, log, sqrt
from bbsd.kernel.jit import jit
from bbsd.kernel.streams import marked, unit
from bbsd.language.meaning.tables.table import OPEN_CELL

if TYPE_CHECKING:
    from numpy.typing import NDArray

SLOWEST = 0.01
"""The least step of the critic, so that it follows designs that get better."""
FADING = 0.95
"""What a round leaves of what was known: what is seldom tried counts as unknown again after some time."""
MOST_AT_ONCE = 20.0
"""Credits of a pair in one round that count in full: those of one round are alike."""


@jit
def credit_backwards(
    asked: NDArray[np.signedinteger],
    joint_cells: NDArray[np.int32],
    gains: NDArray[np.float64],
    steps_taken: NDArray[np.float64],
    critic: NDArray[np.float64],
    visits: NDArray[np.float64],
    sums: NDArray[np.float64],
    counts: NDArray[np.float64],
    discount: float,
    mixing: float,
) -> None:
    """Add up the credit of every choice of every behavior asked, No Action included, and let the critic learn.

    A choice's credit is the return from its step on minus what the critic expected. The return is cut where the robot
    strayed from its tables in the next step: what follows is then no consequence of the tables.

    Args:
        asked: as in `compiler.steps.Steps`, like the next two.
        joint_cells: (n_steps, n_robots, n_lanes).
        gains: what robots earned; each is credited with the mean of all.
        steps_taken: of the first lanes, those that count, (n,).
        critic: the return to be expected from each joint cell on, (n_joint_cells,), changed.
        visits: how often the critic learned of each, (n_joint_cells,), changed.
        sums: the sum of credits of each pair of a cell and a choice, (n_pairs,), changed.
        counts: their number, (n_pairs,), changed.
        discount: of what is earned a step later.
        mixing: lambda, 0 to trust the critic at the next step, 1 to trust what was earned.
    """
    _, n_robots, n_behaviors, _ = asked.shape
    returns, expected, strayed = np.empty(n_robots), np.empty(n_robots), np.empty(n_robots)
    for lane in range(len(steps_taken)):
        for robot in range(n_robots):  # behind the last step nothing is earned
            returns[robot], expected[robot], strayed[robot] = 0.0, 0.0, 1.0
        for step in range(int(steps_taken[lane]) - 1, -1, -1):
            gain = 0.0
            for robot in range(n_robots):
                gain += gains[step, robot, lane]
            gain /= n_robots
            for robot in range(n_robots):
                ahead = expected[robot]
                if strayed[robot] == 0.0:
                    ahead = (1.0 - mixing) * ahead + mixing * returns[robot]
                total = gain + discount * ahead
                cell = joint_cells[step, robot, lane]
                credit, by_chance = total - critic[cell], 0.0
                for behavior in range(n_behaviors):
                    code = asked[step, robot, behavior, lane]
                    if code >= 0:
                        sums[code >> 1] += credit
                        counts[code >> 1] += 1.0
                        if code & 1:
                            by_chance = 1.0
                if by_chance == 0.0 or visits[cell] == 0.0:
                    visits[cell] += 1.0
                    critic[cell] += credit * max(1.0 / sqrt(visits[cell]), SLOWEST)
                returns[robot], expected[robot], strayed[robot] = total, critic[cell], by_chance


@jit
def learn_values(
    credit: NDArray[np.float64],
    weight: NDArray[np.float64],
    sums: NDArray[np.float64],
    counts: NDArray[np.float64],
) -> float:
    """Let what is known of pairs (n_pairs,) fade, and add the credits of a round.

    Returns the mean size of a pair's mean credit in the round.

    Args:
        credit: the sum of weighted credits of each pair, changed.
        weight: the sum of their weights, changed.
        sums: the sum of credits in the round.
        counts: their number.
    """
    size, n_seen = 0.0, 0
    for pair in range(len(credit)):
        credit[pair] *= FADING
        weight[pair] *= FADING
        if counts[pair] > 0.0:
            mean, more = sums[pair] / counts[pair], min(counts[pair], MOST_AT_ONCE)
            credit[pair] += more * mean
            weight[pair] += more
            size, n_seen = size + abs(mean), n_seen + 1
    return size / n_seen if n_seen else 0.0


@jit
def perturbed_tables(
    credit: NDArray[np.float64],
    weight: NDArray[np.float64],
    first_pairs: NDArray[np.int64],
    given: NDArray[np.uint8],
    noise: float,
    lanes: NDArray[np.uint64],
    marks: NDArray[np.uint64],
) -> NDArray[np.uint8]:
    """Return for each lane the tables of the best choices after noise that gets smaller as choices are known better.

    Args:
        credit, weight: of pairs of a cell and a choice, as in `learn_values`, (n_pairs,).
        first_pairs: where each cell's pairs begin, and where the last one's end, (n_cells + 1,).
        given: the given choice of each cell, or OPEN_CELL, (n_cells,).
        noise: the standard deviation of the noise of a choice that was never tried, times the square root of 6.
        lanes: the keys of the lanes' random streams, (n,).
        marks: `draws.marks` of at least n_pairs.

    Returns:
        (n, n_cells).
    """
    n_cells = len(given)
    tables = np.empty((len(lanes), n_cells), np.uint8)
    values, spread = np.empty(len(credit)), np.empty(len(credit))
    for pair in range(len(credit)):
        values[pair] = credit[pair] / (weight[pair] + 1.0)
        spread[pair] = noise / sqrt(weight[pair] + 1.0)
    for lane in range(len(lanes)):
        for cell in range(n_cells):
            first = first_pairs[cell]
            best, highest = int(given[cell]), -np.inf
            if given[cell] == OPEN_CELL:
                for pair in range(first, first_pairs[cell + 1]):
                    bits = marked(int(lanes[lane]), int(marks[pair]))
                    triangular = ((bits >> 32) + (bits & 0xFFFFFFFF)) * 2.0**-32 - 1.0
                    score = values[pair] + spread[pair] * triangular
                    if score > highest:
                        best, highest = pair - first, score
            tables[lane, cell] = best
    return tables


@jit
def rates_between(low: float, high: float, lanes: NDArray[np.uint64]) -> NDArray[np.float64]:
    """Return a rate for each lane, uniform on a logarithmic scale, (n,)."""
    rates = np.empty(len(lanes))
    for lane in range(len(lanes)):
        rates[lane] = low * exp(log(high / low) * unit(int(lanes[lane])))
    return rates
