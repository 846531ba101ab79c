"""From a file to a spec and its meaning, or to all mistakes in it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bbsd.errors import Diagnosis, SpecError
from bbsd.expression.syntax.mistakes import KEY, WHOLE
from bbsd.language.lineage import read_lineage
from bbsd.language.meaning import Meaning, elaborate
from bbsd.language.overrides import FILE as OVERRIDES
from bbsd.language.overrides import overrides_source, read_overrides, with_overrides
from bbsd.language.recovery import recover
from bbsd.language.validation import existing, form_mistakes, validate

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
MAX_EXAMINED_TWICE = 300_000
"""Characters up to which mistakes of meaning are reported beside those of form, which takes twice the time."""


@dataclass(frozen=True, slots=True)
class Loaded:
    """A spec without mistakes: its text, its files, its plain data after overrides, its model and its meaning."""

    source: Source
    lineage: Lineage
    overrides: tuple[str, ...]
    data: Data
    spec: Spec
    meaning: Meaning

    def __repr__(self) -> str:
        return f"<Loaded {self.source.file}: {self.spec.name}>"


def load(source: Source, *, seed: int = 0, overrides: Sequence[str] = ()) -> Loaded:
    """Read, validate and elaborate a spec, its constants drawn from the seed.

    `overrides` are arguments PATH=VALUE.

    Raises:
        SpecError: with all mistakes of the file in its order, 50 at most; or with those of the overrides alone, where
            there are any, and with a source that has an argument on each line.
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
    spec, meaning, mistakes = (
        _examine(data, seed, is_small=is_small) if files.is_readable else (None, None, [])
    )
    if spec is None or meaning is None or files.mistakes:
        diagnoses = _diagnoses(mistakes, files, data, assignments)
        if in_overrides := [diagnosis for diagnosis in diagnoses if diagnosis.place.file == OVERRIDES]:
            raise SpecError(_capped(in_overrides), overrides_source(overrides))
        raise files.error(_capped(diagnoses))
    return Loaded(files.source, files, tuple(overrides), data, meaning.spec, meaning)


def check(source: Source, seed: int = 0) -> tuple[Diagnosis, ...]:
    """Return the mistakes in a spec, in the order of its text, 50 at most."""
    try:
        load(source, seed=seed)
    except SpecError as error:
        return error.diagnoses
    return ()


def _examine(
    data: Data, seed: int, *, is_small: bool
) -> tuple[Spec | None, Meaning | None, list[LocatedMistake]]:
    """Return the model and the meaning of plain data, or their mistakes: those of form alone where they are large."""
    spec, errors = validate(data)
    if spec:
        meaning, mistakes = elaborate(spec, seed)
        return spec, meaning, list(mistakes)
    further = _mistakes_of_meaning(data, errors, seed) if is_small else []
    return None, None, [*form_mistakes(errors, data), *further]


def _mistakes_of_meaning(data: Data, errors: Sequence[ErrorDetails], seed: int) -> list[LocatedMistake]:
    """Return the mistakes of meaning in data that have mistakes of form."""
    recovered = recover(data, errors)
    if recovered is None:
        return []
    _, mistakes = elaborate(recovered.spec, seed, recovered.broken)
    return [(path, mistake) for path, mistake in mistakes if mistake.code not in recovered.dependent]


def _diagnoses(
    mistakes: Iterable[LocatedMistake], files: Lineage, data: Data, overrides: Sequence[Override]
) -> list[Diagnosis]:
    """Return all mistakes in the order of the text, without those where the reading of YAML already reported one."""
    unreadable = {_start(diagnosis.place) for diagnosis in files.mistakes}
    diagnoses = [*files.mistakes]
    for path, mistake in mistakes:
        place = _place((path, mistake), files, data, overrides)
        starts = {_start(place), _start(files.place(existing(path, data)))}
        if unreadable.isdisjoint(starts) and not (mistake.code == "BB021" and _has_merged(files)):
            diagnoses.append(Diagnosis(mistake.code, mistake.message, place, mistake.advice))
    return sorted(dict.fromkeys(diagnoses), key=lambda diagnosis: diagnosis.place)


def _start(place: Place) -> tuple[str, int, int]:
    return place.file, place.line, place.column


def _has_merged(files: Lineage) -> bool:
    return any(diagnosis.code == "BB007" for diagnosis in files.mistakes)


def _place(located: LocatedMistake, files: Lineage, data: Data, overrides: Sequence[Override]) -> Place:
    path, mistake = located
    nearest = existing(path, data)
    span = None if mistake.span in (KEY, WHOLE) or nearest != path else mistake.span
    on_key = mistake.span == KEY or any(isinstance(segment, str) for segment in path[len(nearest) :])
    offset, length = (span.start, span.length) if span else (None, 1)
    for override in reversed(overrides):
        if nearest[: len(override.path)] == override.path:
            return override.place(nearest[len(override.path) :], offset, on_key=on_key, length=length)
    return files.place(nearest, offset, on_key, length)


def _capped(diagnoses: Sequence[Diagnosis]) -> Sequence[Diagnosis]:
    """Return the first mistakes, the last of which says how many more there are."""
    hidden = len(diagnoses) - MAX_DIAGNOSES
    if hidden <= 0:
        return diagnoses
    *first, last = diagnoses[:MAX_DIAGNOSES]
    note = f"{hidden} more mistake{'s are' if hidden > 1 else ' is'} not shown"
    return [*first, replace(last, advice=f"{last.advice}; {note}" if last.advice else note)]
