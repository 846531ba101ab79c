"""The known designs that a design begins with: as they are given, or as the folder that is resumed has kept them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING

from bbsd.api.given.arguments import BadArgument
from bbsd.api.given.sources import is_path, path_of
from bbsd.api.results import Designed
from bbsd.api.specs import AnySpec, load
from bbsd.errors import SpecError, UsageError, escape
from bbsd.language.loading import Loaded
from bbsd.runs.beginnings import Beginning, beginning_of, solver_starts, starts_for

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from bbsd.compiler import Problem
    from bbsd.runs.storage.folder import Folder


def starts(name: str, value: object) -> tuple[AnySpec, ...]:
    """Take one design, or several in a list, as several."""
    several = tuple(value) if isinstance(value, list | tuple) else (value,)
    for each in several:
        if not isinstance(each, str | os.PathLike | Mapping | Loaded | Designed):
            raise BadArgument(f"{name} is a design or a list of designs, not {each!r:.60}")
    return several


def beginnings_of(
    given: Sequence[AnySpec], problem: Problem, seed: int, note: Callable[[str], object] | None
) -> tuple[Beginning, ...]:
    """Return designs to begin with, and say what of them is set aside.

    Raises:
        UnfitStart: one has something that the spec does not have.
        SpecError: one has mistakes.
        NoDesign: a folder that is no run, or a run without an answer.
    """
    found = tuple(beginning_of(load(each, seed=seed)) for each in given)
    for beginning, start in zip(found, starts_for(problem, found, seed), strict=True):
        cells, layers = start.set_aside
        parts = [_counted(cells, "cell"), _counted(layers, "layer")]
        if note is not None and any(parts):
            what = " and ".join(filter(None, parts))
            note(
                f"{escape(beginning.file)} has {what} that the spec gives otherwise; they stay as the spec gives them"
            )
    return found


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}" if number else ""


def resumed_beginnings(
    given: Sequence[AnySpec],
    folder: Folder,
    problem: Problem,
    seed: int,
    note: Callable[[str], object] | None,
) -> tuple[Beginning, ...]:
    """Return the designs that the design in a folder began with, whatever became of their files.

    Raises BadArgument where it began with none, and starts are given.
    """
    kept = folder.beginnings()
    if given and not kept:
        raise BadArgument(
            f"the design in {folder.path} began without a start", "leave out the start, or begin anew with it"
        )
    if given and note is not None and _differ(given, kept, problem, seed):
        names = " and ".join(escape(str(path_of(each))) if is_path(each) else "the start" for each in given)
        note(
            f"{names} is not what the design in {folder.path} began with; it goes on with what it began with"
        )
    return kept


def _differ(designs: Sequence[AnySpec], kept: Sequence[Beginning], problem: Problem, seed: int) -> bool:
    """Return whether designs that are given are others than those that were kept, or cannot be read any more."""
    try:
        given = solver_starts(problem, [beginning_of(load(each, seed=seed)) for each in designs], seed)
    except (SpecError, UsageError, OSError):
        return True
    before = solver_starts(problem, kept, seed)
    return given is None or before is None or given.digest != before.digest
