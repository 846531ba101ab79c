"""From a file to a spec and its meaning, or to all mistakes in it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from bbsd.errors import Diagnosis, Severity, SpecError
from bbsd.errors.catalog import severity_of
from bbsd.expression.syntax.mistakes import KEY, WHOLE, characters_of_key
from bbsd.language.correcting import placed
from bbsd.language.lineage import read_lineage
from bbsd.language.meaning import Meaning, elaborate
from bbsd.language.overrides import FILE as OVERRIDES
from bbsd.language.overrides import overrides_source, read_overrides, with_overrides
from bbsd.language.recovery import recover
from bbsd.language.validation import existing, form_mistakes, validate
from bbsd.language.warnings.finding import warnings_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pydantic_core import ErrorDetails

    from bbsd.errors import Place
    from bbsd.language.lineage import Lineage
    from bbsd.language.models import Spec
    from bbsd.language.overrides import Override
    from bbsd.language.validation import LocatedMistake
    from bbsd.text import Data, Source

MAX_DIAGNOSES = 50
"""Mistakes and warnings that are told of one spec at most."""
MAX_EXAMINED_TWICE = 300_000
"""Characters up to which mistakes of meaning are reported beside those of form, which takes twice the time."""


@dataclass(frozen=True)
class Loaded:
    """A spec without mistakes: its text, its files, its plain data after overrides, its model and its meaning.

    `noted` are warnings that were found on the way to its meaning.
    """

    source: Source
    lineage: Lineage
    overrides: tuple[str, ...]
    data: Data
    spec: Spec
    meaning: Meaning
    noted: tuple[LocatedMistake, ...] = ()

    @cached_property
    def warnings(self) -> tuple[Diagnosis, ...]:
        """What can be used, but probably does not say what was meant, in the order of the text, 50 at most.

        What stands in a file that the spec extends is told of that file alone, and nothing is told of overrides.
        """
        found = [*self.noted, *warnings_of(self.meaning)]
        diagnoses = _diagnoses(found, self.lineage, self.data, read_overrides(self.overrides))
        return tuple(_capped([each for each in diagnoses if each.place.file == self.source.file]))

    def __repr__(self) -> str:
        return f"<Loaded {self.source.file}: {self.spec.name}>"


def load(source: Source, *, seed: int = 0, overrides: Sequence[str] = ()) -> Loaded:
    """Read, validate and elaborate a spec, its constants drawn from the seed.

    `overrides` are arguments PATH=VALUE.

    Raises:
        SpecError: with all mistakes of the file in its order, and after them warnings about single expressions, 50 at
            most; or with those of the overrides alone, where there are any, and with a source that has an argument on
            each line.
    """
    return _loaded(read_lineage(source), seed, overrides)


def loaded_again(loaded: Loaded, *, seed: int = 0, overrides: Sequence[str] = ()) -> Loaded:
    """Return a loaded spec with its constants drawn from this seed, and further overrides after its own; as `load`."""
    if seed == loaded.meaning.seed and not overrides:
        return loaded
    return _loaded(loaded.lineage, seed, (*loaded.overrides, *overrides))


def _loaded(files: Lineage, seed: int, overrides: Sequence[str]) -> Loaded:
    assignments = read_overrides(overrides)
    data = with_overrides(files.data, assignments, overrides)
    is_small = files.characters <= MAX_EXAMINED_TWICE
    spec, meaning, found = _examine(data, seed, is_small=is_small) if files.is_readable else (None, None, [])
    if spec is None or meaning is None or files.mistakes:
        diagnoses = _diagnoses(found, files, data, assignments)
        if in_overrides := [diagnosis for diagnosis in diagnoses if diagnosis.place.file == OVERRIDES]:
            raise SpecError(_capped(in_overrides), overrides_source(overrides))
        raise files.error(_capped(diagnoses))
    return Loaded(files.source, files, tuple(overrides), data, meaning.spec, meaning, tuple(found))


def check(source: Source, seed: int = 0, *, warnings: bool = False) -> tuple[Diagnosis, ...]:
    """Return the mistakes in a spec, in the order of its text, and after them the warnings if wanted; 50 at most."""
    try:
        loaded = load(source, seed=seed)
    except SpecError as error:
        return error.diagnoses if warnings else error.mistakes
    return loaded.warnings if warnings else ()


def _examine(
    data: Data, seed: int, *, is_small: bool
) -> tuple[Spec | None, Meaning | None, list[LocatedMistake]]:
    """Return the model and the meaning of plain data, and what was found: where they are large, of form alone."""
    spec, errors = validate(data)
    if spec:
        meaning, found = elaborate(spec, seed)
        return spec, meaning, list(found)
    further = _mistakes_of_meaning(data, errors, seed) if is_small else []
    return None, None, [*form_mistakes(errors, data), *further]


def _mistakes_of_meaning(data: Data, errors: Sequence[ErrorDetails], seed: int) -> list[LocatedMistake]:
    """Return the mistakes of meaning in data that have mistakes of form."""
    recovered = recover(data, errors)
    if recovered is None:
        return []
    _, found = elaborate(recovered.spec, seed, recovered.broken)
    return [
        (path, mistake)
        for path, mistake in found
        if mistake.code not in recovered.dependent and severity_of(mistake.code) is Severity.MISTAKE
    ]


def _diagnoses(
    mistakes: Iterable[LocatedMistake], files: Lineage, data: Data, overrides: Sequence[Override]
) -> list[Diagnosis]:
    """Return all mistakes in the order of the text, then all warnings in that order.

    Where the reading of YAML already reported a mistake, there is no other.
    """
    unreadable = {_start(diagnosis.place) for diagnosis in files.mistakes}
    diagnoses = [*files.mistakes]
    for path, mistake in mistakes:
        place = _place((path, mistake), files, data, overrides)
        starts = {_start(place), _start(files.place(existing(path, data)))}
        if unreadable.isdisjoint(starts) and not (mistake.code == "BB021" and _has_merged(files)):
            correction = None if place.file == OVERRIDES else placed(mistake.correction, path, files)
            diagnoses.append(Diagnosis(mistake.code, mistake.message, place, mistake.advice, correction))
    return sorted(dict.fromkeys(diagnoses), key=lambda each: (each.severity is Severity.WARNING, each.place))


def _start(place: Place) -> tuple[str, int, int]:
    return place.file, place.line, place.column


def _has_merged(files: Lineage) -> bool:
    return any(diagnosis.code == "BB007" for diagnosis in files.mistakes)


def _place(located: LocatedMistake, files: Lineage, data: Data, overrides: Sequence[Override]) -> Place:
    path, mistake = located
    nearest = existing(path, data)
    in_key = characters_of_key(mistake.span)
    span = None if mistake.span in (KEY, WHOLE) or nearest != path else in_key or mistake.span
    on_key = (
        mistake.span == KEY
        or in_key is not None
        or any(isinstance(segment, str) for segment in path[len(nearest) :])
    )
    offset, length = (span.start, span.length) if span else (None, 1)
    for override in reversed(overrides):
        if nearest[: len(override.path)] == override.path:
            return override.place(nearest[len(override.path) :], offset, on_key=on_key, length=length)
    return files.place(nearest, offset, on_key, length)


def _capped(diagnoses: Sequence[Diagnosis]) -> Sequence[Diagnosis]:
    """Return the first mistakes and warnings, the last of which says how many more there are."""
    hidden = diagnoses[MAX_DIAGNOSES:]
    if not hidden:
        return diagnoses
    *first, last = diagnoses[:MAX_DIAGNOSES]
    words = {Severity.MISTAKE: "mistake", Severity.WARNING: "warning"}
    kinds = [words[severity] for severity in words if any(each.severity is severity for each in hidden)]
    note = f"{len(hidden)} more {'s and '.join(kinds)}{'s are' if len(hidden) > 1 else ' is'} not shown"
    return [*first, replace(last, advice=f"{last.advice}; {note}" if last.advice else note)]
