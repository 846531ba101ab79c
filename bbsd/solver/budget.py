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


def automatic_budget(problem: Problem) -> int:
    """Return the episodes of a run whose budget is automatic: by the number of designs, cells and orders together."""
    episodes = min(MOST, LEAST + EACH_DECADE * problem.decades)
    return round(episodes / UNIT) * UNIT
