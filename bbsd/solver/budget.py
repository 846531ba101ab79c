"""The budget of a search that names none."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bbsd.compiler import Problem

LEAST, EACH_DECADE, MOST = 200_000, 25_000, 1_000_000
"""Episodes: for any task, for each power of ten of its designs, and at most.

With 400,000 the lifting task (10^8 designs) was within 0.2 of the best known return in each of ten seeds; the taxi
(10^131) needs 800,000, whatever its 300 cells multiply to, so there is a limit.
"""
UNIT = 10_000
STEPS_IN_PYTHON, FEWEST_IN_PYTHON = 5_000_000, 10_000
"""Where the environment is stepped in Python: robots' steps of a run in which no episode ends early, episodes at least.

Such steps take some 15 microseconds (CartPole) to 300 (spread), a thousand times what compiled ones do: a minute to
half an hour. A limit in seconds would give another budget, and so another design, on another day.
"""


def automatic_budget(problem: Problem) -> int:
    """Return the episodes of a run whose budget is automatic: by the number of designs, cells and orders together.

    Where the environment is stepped in Python, also by the steps of an episode.
    """
    episodes = min(MOST, LEAST + EACH_DECADE * problem.decades)
    if problem.is_stepped:
        environment = problem.meaning.spec.environment
        affordable = STEPS_IN_PYTHON / (environment.steps * environment.robots)
        episodes = min(episodes, max(FEWEST_IN_PYTHON, affordable))
    return round(episodes / UNIT) * UNIT
