"""From a file to a spec and its meaning, or to all mistakes in it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from bbsd.errors import Diagnosis, Severity, SpecError
from bbsd.expression.syntax.mistakes import KEY, WHOLE, characters_of_key
from bbsd.language.lineage import read_lineage
from bbsd.language.meaning import Meaning, elaborate
from bbsd.language.validation import child, existing, form_mistakes, validate

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pydantic_core import ErrorDetails

    from bbsd.errors import Place
    from bbsd.expression.scope import Path
    from bbsd.expression.syntax.mistakes import Mistake
    from bbsd.language.lineage import Lineage
    from bbsd.language.meant.reading import Reading
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

        They are about the spec as it is written, without overrides. What stands in a file that it extends is told of
        that file alone.
        """
        if self.overrides:
            return self._warnings_as_written()
        from bbsd.language.warnings.extended import with_names_of_bases
        from bbsd.language.warnings.finding import warnings_of

        found = with_names_of_bases(warnings_of(self.meaning), self.lineage)
        diagnoses = _diagnoses([*self.noted, *found], self.lineage, self.data, ())
        return tuple(_capped([each for each in diagnoses if each.place.file == self.source.file]))

    def _warnings_as_written(self) -> tuple[Diagnosis, ...]:
        try:
            return _loaded(self.lineage, self.meaning.seed, ()).warnings
        except SpecError:
            return ()

    def __repr__(self) -> str:
        return f"<Loaded {self.source.file}: {self.spec.name}>"


class _Examined(NamedTuple):
    """What plain data mean, None where they have mistakes, what was found, and values that YAML need not explain."""

    meaning: Meaning | None = None
    found: tuple[LocatedMistake, ...] = ()
    explained: frozenset[Path] = frozenset()


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
    assignments, data = _overridden(files.data, overrides)
    is_small = files.characters <= MAX_EXAMINED_TWICE
    examined = _Examined()
    if files.is_readable and isinstance(data, dict):
        examined = _examine(data, files, seed, is_small=is_small)
    meaning = examined.meaning
    if meaning is None or files.mistakes:
        diagnoses = _diagnoses(examined.found, files, data, assignments, examined.explained)
        if in_overrides := [each for each in diagnoses if each.place.file not in files.names]:
            from bbsd.language.overrides import overrides_source

            raise SpecError(_capped(in_overrides), overrides_source(overrides))
        raise files.error(_capped(diagnoses))
    return Loaded(files.source, files, tuple(overrides), data, meaning.spec, meaning, examined.found)


def _overridden(data: dict[str, Data], overrides: Sequence[str]) -> tuple[tuple[Override, ...], Data]:
    """Return arguments PATH=VALUE as read, and the data with their values set. Raises SpecError for wrong ones."""
    if not overrides:
        return (), data
    from bbsd.language.overrides import read_overrides, with_overrides

    assignments = read_overrides(overrides)
    return assignments, with_overrides(data, assignments, overrides)


def check(source: Source, seed: int = 0, *, warnings: bool = False) -> tuple[Diagnosis, ...]:
    """Return the mistakes in a spec, in the order of its text, and after them the warnings if wanted; 50 at most."""
    try:
        loaded = load(source, seed=seed)
    except SpecError as error:
        return error.diagnoses if warnings else error.mistakes
    return loaded.warnings if warnings else ()


def _examine(data: dict[str, Data], files: Lineage, seed: int, *, is_small: bool) -> _Examined:
    """Return the meaning of plain data, and what was found: where they are large, of form alone.

    Where their form is wrong in a way of which is known what is meant, that is told, and all else is found in what is
    meant.
    """
    spec, errors = validate(data)
    found: tuple[LocatedMistake, ...] = ()
    if spec:
        meaning, found = elaborate(spec, seed)
        if meaning is not None:
            return _Examined(meaning, found)
    from bbsd.language.meant.understanding import (
        as_meant,
    )  # only mistakes need it, and it takes long to import

    reading = as_meant(data, files)
    if spec and not reading.told:
        return _Examined(None, found)
    if reading.told:
        spec, errors = validate(reading.data)
    if spec:
        further = elaborate(spec, seed)[1]
        mistakes = [each for each in further if _is_mistake(each[1])]
    else:
        mistakes = form_mistakes(errors, reading.data)
        mistakes += _mistakes_of_meaning(reading.data, errors, seed) if is_small else []
    elsewhere = (_as_written(path, mistake, reading, data) for path, mistake in mistakes)
    return _Examined(None, (*reading.told, *elsewhere), frozenset(reading.explained))


def _as_written(path: Path, mistake: Mistake, reading: Reading, data: Data) -> LocatedMistake:
    """Return a mistake and its place in the file; its span and correction only if the text is as in the file."""
    origin, before = reading.origin(path), data
    for segment in origin:
        before = child(before, segment)
    now = reading.at(path)
    if mistake.span in (KEY, WHOLE) or characters_of_key(mistake.span) is not None or now == before:
        return origin, mistake
    return origin, mistake._replace(span=WHOLE, correction=None)


def _is_mistake(found: Mistake) -> bool:
    from bbsd.errors.catalog import severity_of

    return severity_of(found.code) is Severity.MISTAKE


def _mistakes_of_meaning(data: Data, errors: Sequence[ErrorDetails], seed: int) -> list[LocatedMistake]:
    """Return the mistakes of meaning in data that have mistakes of form."""
    from bbsd.language.recovery import recover

    recovered = recover(data, errors)
    if recovered is None:
        return []
    _, found = elaborate(recovered.spec, seed, recovered.broken)
    return [
        (path, mistake)
        for path, mistake in found
        if mistake.code not in recovered.dependent and _is_mistake(mistake)
    ]


def _diagnoses(
    mistakes: Sequence[LocatedMistake],
    files: Lineage,
    data: Data,
    overrides: Sequence[Override],
    explained: Iterable[Path] = (),
) -> list[Diagnosis]:
    """Return all mistakes in the order of the text, then all warnings in that order.

    Where the reading of YAML already reported a mistake, there is no other.
    """
    if not mistakes and not files.mistakes:
        return []
    from bbsd.language.meant.edits.placing import Placing

    told = [each for each in files.mistakes if not _is_explained(each, files, explained)]
    better = _better_told(files) if told else {}
    unreadable = {_start(diagnosis.place) for diagnosis in told}
    diagnoses, placing = [better.get(each, each) for each in told], Placing(files)
    for path, mistake in mistakes:
        place = _place((path, mistake), files, data, overrides)
        starts = {_start(place), _start(files.place(existing(path, data)))}
        if unreadable.isdisjoint(starts) and not (mistake.code == "BB021" and _lacks_a_part(files)):
            nearest = existing(path, data)
            is_in_files = place.file in files.names
            correction = placing.placed(mistake.correction, nearest) if is_in_files else None
            message = mistake.message + _lines(mistake.seen_at, files, place.file)
            diagnoses.append(Diagnosis(mistake.code, message, place, mistake.advice, correction))
    return sorted(dict.fromkeys(diagnoses), key=lambda each: (each.severity is Severity.WARNING, each.place))


def _lines(paths: Iterable[Path], files: Lineage, file: str) -> str:
    """Return on which lines of a file values stand: ` (line 10)`; "" where they are not in it."""
    places = (files.place(path, None, on_key=True, length=1) for path in paths)
    numbers = sorted({place.line for place in places if place.file == file})
    shown = " and ".join(map(str, numbers[-2:]))
    shown = ", ".join([*map(str, numbers[:-2]), shown])
    return f" (line{'s' if len(numbers) > 1 else ''} {shown})" if numbers else ""


def _better_told(files: Lineage) -> dict[Diagnosis, Diagnosis]:
    """Return how mistakes of YAML are told, by how its reading told them."""
    from bbsd.language.meant.texts import refined

    pairs = (zip(each.diagnoses, refined(each), strict=True) for each in files.documents)
    return {before: after for pair in pairs for before, after in pair}


def _is_explained(diagnosis: Diagnosis, files: Lineage, explained: Iterable[Path]) -> bool:
    """Return whether a mistake of the reading of YAML is one in a value of which something better is told."""
    for path in explained:
        document = files.document(path)
        stretch = document.stretch(path)
        if stretch is not None and diagnosis.place.file == document.source.file:
            first, last = map(document.source.line_number, stretch)
            if first <= diagnosis.place.line <= last:
                return True
    return False


def _start(place: Place) -> tuple[str, int, int]:
    return place.file, place.line, place.column


def _lacks_a_part(files: Lineage) -> bool:
    """Return whether keys were not read: those that are merged, or that stand in a second document."""
    return any(diagnosis.code in ("BB007", "BB015") for diagnosis in files.mistakes)


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
