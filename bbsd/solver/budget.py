"""The budget of a search that names none."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bbsd.compiler import Problem

DEFAULT = 300_000
"""Episodes."""


def automatic_budget(problem: Problem) -> int:
    """Return the episodes of a run whose budget is automatic."""
    del problem
    return DEFAULT
