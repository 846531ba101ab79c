"""A file to a spec and its meaning, or to everything that is wrong with it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bbsd.errors import Diagnosis, SpecError
from bbsd.expression.mistakes import KEY, WHOLE
from bbsd.language.lineage import lineage
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

MAX_SHOWN = 50
MAX_EXAMINED_TWICE = 300_000
"""Characters up to which mistakes of meaning are looked for beside those of form, which takes twice the time."""


@dataclass(frozen=True, slots=True)
class Loaded:
    """A spec without mistakes: its text, its files, its plain data after overrides, its model, what it means."""

    source: Source
    lineage: Lineage
    data: Data
    spec: Spec
    meaning: Meaning


def load(source: Source, *, seed: int = 0, overrides: Sequence[str] = ()) -> Loaded:
    """Read, validate and elaborate a spec, its constants drawn from the seed.

    `overrides` are arguments PATH=VALUE. Raises SpecError with all mistakes of the file in its order, 50 at most; or
    with those of the overrides alone, where there are any: their source has an argument on each line.
    """
    files = lineage(source)
    given = read_overrides(overrides)
    data = with_overrides(files.data, given, overrides)
    small = files.characters <= MAX_EXAMINED_TWICE
    spec, meaning, told = _examined(data, seed, small=small) if files.is_readable else (None, None, [])
    if spec is None or meaning is None or files.mistakes:
        diagnoses = _diagnoses(told, files, data, given)
        if own := [each for each in diagnoses if each.place.file == OVERRIDES]:
            raise SpecError(_capped(own), overrides_source(overrides))
        raise files.error(_capped(diagnoses))
    return Loaded(source, files, data, spec, meaning)


def check(source: Source, seed: int = 0) -> tuple[Diagnosis, ...]:
    """Everything that is wrong with a spec, in the order of its text, 50 mistakes at most."""
    try:
        load(source, seed=seed)
    except SpecError as error:
        return error.diagnoses
    return ()


def _examined(
    data: Data, seed: int, *, small: bool = True
) -> tuple[Spec | None, Meaning | None, list[LocatedMistake]]:
    """The model and the meaning of plain data, or their mistakes: those of the form alone where they are large."""
    spec, errors = validate(data)
    if spec:
        meaning, told = elaborate(spec, seed)
        return spec, meaning, list(told)
    return (
        None,
        None,
        [*form_mistakes(errors, data), *(_mistakes_in_the_rest(data, errors, seed) if small else ())],
    )


def _mistakes_in_the_rest(data: Data, errors: Sequence[ErrorDetails], seed: int) -> list[LocatedMistake]:
    rest = recover(data, errors)
    if rest is None:
        return []
    _, told = elaborate(rest.spec, seed, rest.broken)
    return [(path, mistake) for path, mistake in told if mistake.code not in rest.dependent]


def _diagnoses(
    told: Iterable[LocatedMistake], files: Lineage, data: Data, overrides: Sequence[Override]
) -> list[Diagnosis]:
    """All mistakes in the order of the text; what YAML itself already stumbled over is said once."""
    stumbled = {_start(each.place) for each in files.mistakes}
    found = [*files.mistakes]
    for path, mistake in told:
        place = _place((path, mistake), files, data, overrides)
        places = {_start(place), _start(files.place(existing(path, data)))}
        if stumbled.isdisjoint(places) and not (mistake.code == "BB021" and _has_merged(files)):
            found.append(Diagnosis(mistake.code, mistake.message, place, mistake.advice))
    return sorted(dict.fromkeys(found), key=lambda each: each.place)


def _start(place: Place) -> tuple[str, int, int]:
    return place.file, place.line, place.column


def _has_merged(files: Lineage) -> bool:
    return any(each.code == "BB007" for each in files.mistakes)


def _place(told: LocatedMistake, files: Lineage, data: Data, overrides: Sequence[Override]) -> Place:
    path, mistake = told
    there = existing(path, data)
    span = None if mistake.span in (KEY, WHOLE) or there != path else mistake.span
    on_key = mistake.span == KEY or any(isinstance(segment, str) for segment in path[len(there) :])
    offset, length = (span.start, span.length) if span else (None, 1)
    for override in reversed(overrides):
        if there[: len(override.path)] == override.path:
            return override.place(there[len(override.path) :], offset, on_key=on_key, length=length)
    return files.place(there, offset, on_key, length)


def _capped(diagnoses: Sequence[Diagnosis]) -> Sequence[Diagnosis]:
    """The first mistakes, the last of which says how many more there are."""
    hidden = len(diagnoses) - MAX_SHOWN
    if hidden <= 0:
        return diagnoses
    *first, last = diagnoses[:MAX_SHOWN]
    note = f"{hidden} more mistake{'s are' if hidden > 1 else ' is'} not shown"
    return [*first, replace(last, advice=f"{last.advice}; {note}" if last.advice else note)]
