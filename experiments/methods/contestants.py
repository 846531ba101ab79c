"""What is compared: the methods, the paper's loop, and variants of `auto` that lack one of its ingredients."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from bbsd.solver.methods import auto
from bbsd.solver.methods.registry import METHODS

if TYPE_CHECKING:
    from collections.abc import Iterator

PAPER = "paper"
WITHOUT = "auto_without_"
BREEDING, FINISHING = "breeding", "finishing"
ABLATIONS = tuple(
    WITHOUT + name for name in (*(method.name for method, _ in auto.OPENINGS), BREEDING, FINISHING)
)
"""Without one of the searches, whose part of the budget breeding gets; without breeding; without climbs at the end.

With a budget so small that `auto` leaves out a search by itself, the variant without it is the same.
"""
RIVALS = ("random", "hill", "joint", "q")
ALL = (*METHODS, PAPER, *ABLATIONS)


@contextmanager
def method_of(name: str) -> Iterator[str]:
    """Yield the name of the method that a contestant is, made of its ingredients within the context."""
    if not name.startswith(WITHOUT):
        yield name
        return
    former = auto.OPENINGS, auto.FEW_OPENINGS, auto.BRED_UNTIL, auto.FEW_BRED_UNTIL
    lacking = name.removeprefix(WITHOUT)
    try:
        if lacking == BREEDING:
            auto.BRED_UNTIL = auto.FEW_BRED_UNTIL = 0.0
        elif lacking == FINISHING:
            auto.BRED_UNTIL = auto.FEW_BRED_UNTIL = 0.97
        else:
            fewer = [tuple(part for part in openings if part[0].name != lacking) for openings in former[:2]]
            auto.OPENINGS, auto.FEW_OPENINGS = fewer  # type: ignore[assignment]
        yield "auto"
    finally:
        auto.OPENINGS, auto.FEW_OPENINGS, auto.BRED_UNTIL, auto.FEW_BRED_UNTIL = former
