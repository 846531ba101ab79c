"""The known designs that a command begins with, as texts that are kept, and as what the solver uses."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from bbsd.architecture.starting import UnfitStart, start_for
from bbsd.language.loading import load
from bbsd.solver.starts import starts_of
from bbsd.text import Source

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.architecture.starting import Start
    from bbsd.compiler import Problem
    from bbsd.language.loading import Loaded
    from bbsd.solver.starts import Starts


@dataclass(frozen=True, slots=True)
class Beginning:
    """A known design as a text in which nothing refers to a file, and what is set in it."""

    file: str
    """Where it was read, for messages."""
    text: str
    set: tuple[str, ...] = ()

    def plain(self) -> dict[str, Any]:
        """Return it as `run.json` holds it."""
        return {**asdict(self), "set": list(self.set)}


def beginning_of(loaded: Loaded) -> Beginning:
    """Return a design as it is kept, with all that it extends."""
    return Beginning(loaded.source.file, loaded.lineage.flat.source.text, loaded.overrides)


def beginning_of_plain(plain: Mapping[str, Any]) -> Beginning:
    """Return what `plain` returned. Raises TypeError for another thing."""
    file, text, values = plain.get("file"), plain.get("text"), plain.get("set")
    if not isinstance(file, str) or not isinstance(text, str) or not isinstance(values, list):
        raise TypeError("it is no start of a design")
    return Beginning(file, text, tuple(map(str, values)))


def starts_for(problem: Problem, beginnings: Sequence[Beginning], seed: int) -> tuple[Start, ...]:
    """Return designs in the terms of a problem's spec, the draws in their constants by a seed.

    Raises:
        UnfitStart: one has something that the spec does not have, or says nothing of what is open.
        SpecError: one has mistakes.
    """
    return tuple(_start(problem, each, seed) for each in beginnings)


def _start(problem: Problem, beginning: Beginning, seed: int) -> Start:
    loaded = load(Source(beginning.file, beginning.text), seed=seed, overrides=beginning.set)
    start = start_for(problem, loaded.meaning, beginning.file)
    if not start.says_something(problem):
        raise UnfitStart(f"{beginning.file} says nothing of what the spec leaves open")
    return start


def solver_starts(problem: Problem, beginnings: Sequence[Beginning], seed: int) -> Starts | None:
    """Return designs as the solver begins with them; None of none. Raises as `starts_for`."""
    return starts_of(starts_for(problem, beginnings, seed))
