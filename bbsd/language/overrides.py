"""Values given on the command line as PATH=VALUE: set in the plain data of a spec before it is validated."""

from __future__ import annotations

import re
from copy import deepcopy
from dataclasses import dataclass
from itertools import accumulate
from typing import TYPE_CHECKING

from bbsd.errors import Correction, Diagnosis, Edit, Place, SpecError, did_you_mean
from bbsd.language.keys import blocks_with, fields_at
from bbsd.language.validation import child, has, named
from bbsd.text import Source, read

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.scope import Path
    from bbsd.text import Data, Document

FILE = "--set"
NAMED = ("state", "world", "sensors", "definitions")
"""Blocks of the environment with names of the spec's own."""
SEGMENT = re.compile(r"\.?(?P<key>[^.\[\]=]+)|\[(?P<index>\d{1,6})\]")
ARGUMENT = re.compile(r"(?P<path>[^.\[\]=]+(?:\.[^.\[\]=]+|\[\d{1,6}\])*)=(?P<value>.*)", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Override:
    """An argument as read: the path that it sets, the value, and the document that knows the value's place."""

    path: Path
    value: Data
    document: Document
    columns: tuple[int, ...]
    """Where each segment of the path begins, counted from 1."""
    line: int

    def place(self, below: Path, offset: int | None, *, on_key: bool, length: int) -> Place:
        """Return the place of something in the value, as a document's `place`."""
        (key,) = self.document.data
        return self.document.place((key, *below), offset, on_key, length)


def overrides_source(arguments: Sequence[str]) -> Source:
    """Return the arguments as a text to show mistakes in: each begins a line."""
    return Source(FILE, "\n".join(arguments))


def read_overrides(arguments: Sequence[str]) -> tuple[Override, ...]:
    """Read arguments; raise SpecError with all that cannot be read."""
    lines = accumulate((argument.count("\n") + 1 for argument in arguments), initial=1)
    items = [_read(argument, line) for argument, line in zip(arguments, lines, strict=False)]
    diagnoses = [diagnosis for item in items if isinstance(item, tuple) for diagnosis in item]
    if diagnoses:
        raise SpecError(diagnoses, overrides_source(arguments))
    return tuple(item for item in items if isinstance(item, Override))


def _read(argument: str, line: int) -> Override | tuple[Diagnosis, ...]:
    match = ARGUMENT.fullmatch(argument)
    if match is None:
        advice = "write PATH=VALUE, such as design.coevolution.generations=10 or structure[0]=open"
        return (
            Diagnosis("BB028", "this is no PATH=VALUE", Place(FILE, line, 1, max(1, len(argument))), advice),
        )
    # A key as long as the path, less the blank after its colon, keeps every column of the value.
    key = "_" * (len(match["path"]) - 1) or "_"
    document = read(Source(FILE, "\n" * (line - 1) + f"{key}: {match['value']}"))
    if document.diagnoses:
        return document.diagnoses
    if document.data.keys() != {key}:
        place = document.place(
            next(path for path in ((other,) for other in document.data) if path != (key,)), on_key=True
        )
        return (
            Diagnosis("BB028", "one argument sets one value", place, "give each PATH=VALUE its own --set"),
        )
    segments = list(SEGMENT.finditer(match["path"]))
    path = tuple(int(segment["index"]) if segment["index"] else segment["key"] for segment in segments)
    columns = tuple(segment.start("index" if segment["index"] else "key") + 1 for segment in segments)
    return Override(path, document.data[key], document, columns, line)


def with_overrides(data: Data, overrides: Sequence[Override], arguments: Sequence[str]) -> Data:
    """Return the data with values set, in order; raise SpecError with all paths that lead nowhere."""
    data, diagnoses = deepcopy(data), []
    for override in overrides:
        diagnosis = _set(data, override)
        if diagnosis:
            diagnoses.append(diagnosis)
    if diagnoses:
        raise SpecError(diagnoses, overrides_source(arguments))
    return data


def _set(data: Data, override: Override) -> Diagnosis | None:
    """Set one value, and mappings above it that the language knows; null deletes; return a mistake in the path."""
    if override.path[0] == "extends":  # its file was read already
        place = Place(FILE, override.line, override.columns[0], len("extends"))
        return Diagnosis("BB028", "extends cannot be set", place, "write it in a spec of its own")
    *parents, last = override.path
    for depth, segment in enumerate(parents):
        if not _is_known(data, override.path[: depth + 1]):
            return _nothing_there(data, override, depth)
        if isinstance(data, dict) and data.get(str(segment)) is None:
            data[str(segment)] = {}
        data = child(data, segment)
    if not _is_known(data, override.path):
        return _nothing_there(data, override, len(parents))
    if isinstance(data, list):
        data[int(last) : int(last) + 1] = [] if override.value is None else [deepcopy(override.value)]
    elif isinstance(data, dict) and override.value is None:
        data.pop(str(last), None)
    elif isinstance(data, dict):
        data[str(last)] = deepcopy(override.value)
    return None


def _is_known(data: Data, path: Path) -> bool:
    """Return whether the path's last segment is in the data, or a key of the language that could be."""
    return has(data, path[-1]) or (isinstance(data, dict) and path[-1] in (fields_at(path[:-1]) or {}))


def paths_with(key: str, data: Data) -> list[str]:
    """Return the paths of a key in a spec's blocks: of the language's own, and of names that the spec gives."""
    own = [f"{block}.{key}" for block in blocks_with(key) if not block.startswith(("a ", "the "))]
    environment = child(data, "environment")
    blocks = [("constants", child(data, "constants")), ("reward", child(data, "reward"))]
    blocks += [(f"environment.{name}", child(environment, name)) for name in NAMED]
    return own or [f"{path}.{key}" for path, block in blocks if isinstance(block, dict) and key in block]


def _nothing_there(data: Data, override: Override, depth: int) -> Diagnosis:
    segment, parent = override.path[depth], override.path[:depth]
    place = Place(FILE, override.line, override.columns[depth], len(str(segment)))
    where = f" in {named(parent)}" if parent else ""
    if isinstance(segment, int):
        count = len(data) if isinstance(data, list) else 0
        return Diagnosis(
            "BB028", f"there is no item [{segment}]{where}", place, f"it has {count}, counted from 0"
        )
    if not parent and (paths := paths_with(segment, data)):
        hint = f'; did you mean "{paths[0]}"?' if len(paths) == 1 else f"; it is in {' and in '.join(paths)}"
        edit = Edit(place.line, place.column, place.line, place.column + place.length, paths[0])
        correction = Correction((edit,)) if len(paths) == 1 else None
        return Diagnosis("BB028", f'there is no "{segment}"{hint}', place, "give the whole path", correction)
    keys = [*(data if isinstance(data, dict) else ()), *(fields_at(parent) or ())]
    return Diagnosis("BB028", f'there is no "{segment}"{where}{did_you_mean(segment, keys)}', place)
