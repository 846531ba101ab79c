"""Q-learning on the steps of episodes that are over, from the last step to the first."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.kernel.jit import jit

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@jit
def learn_backwards(
    asked: NDArray[np.signedinteger],
    gains: NDArray[np.float64],
    steps_taken: NDArray[np.float64],
    possible: NDArray[np.bool_],
    values: NDArray[np.float64],
    counts: NDArray[np.int64],
    discount: float,
    trace: float,
    start: float,
    least: float,
) -> None:
    """Move the values of joint choices toward what followed them: Watkins's Q(lambda), episode after episode.

    What followed is what was earned and, of the next joint cell, the best value or, as far as `trace` says and the next
    choice was the one of the table, what followed that.

    Args:
        asked: twice the number of each pair of a joint cell and a choice, plus 1 where the robot strayed,
            (n_steps, n_robots, n_lanes).
        gains: what each robot earned, of the same shape; all of a team count the mean.
        steps_taken: of each lane, (n_lanes,).
        possible: which choices behaviors could make, (n_joint_cells, n_choices).
        values: changed, (n_joint_cells, n_choices).
        counts: how often each choice was learned about, counted on, of the same shape.
        discount: of what follows a step later.
        trace: lambda.
        start: after so many times a value moves by half of what it is off, before that by more, later by less.
        least: the part by which a value moves at least.
    """
    n_choices = values.shape[1]
    for lane in range(len(steps_taken)):
        for robot in range(asked.shape[1]):
            followed, ahead, strayed = 0.0, 0.0, True
            for step in range(int(steps_taken[lane]) - 1, -1, -1):
                earned = 0.0
                for mate in range(gains.shape[1]):
                    earned += gains[step, mate, lane]
                rest = ahead if strayed else (1.0 - trace) * ahead + trace * followed
                followed = earned / gains.shape[1] + discount * rest
                code = asked[step, robot, lane]
                cell, choice = (code >> 1) // n_choices, (code >> 1) % n_choices
                part = max(start / (start + counts[cell, choice]), least)
                values[cell, choice] += part * (followed - values[cell, choice])
                counts[cell, choice] += 1
                strayed = code & 1 == 1
                ahead = values[cell, 0]
                for other in range(1, n_choices):
                    if possible[cell, other] and values[cell, other] > ahead:
                        ahead = values[cell, other]
