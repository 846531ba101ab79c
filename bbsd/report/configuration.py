"""A spec with its defaults filled in, and where each value comes from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.language.base import Part
from bbsd.language.field_types import Expression
from bbsd.text.writing.writer import entry_lines

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.language.lineage import Lineage
    from bbsd.language.loading import Loaded
    from bbsd.text import Data
    from bbsd.text.nodes import DataPath

DEFAULT, OVERRIDE = "default", "--set"
WIDEST = 72
"""The column up to which comments are aligned."""


def configuration_text(loaded: Loaded) -> str:
    """Return a spec as YAML with nothing left to defaults, what it extends included.

    Comments say where each value comes from: file:line, default, or --set.
    """
    whole = _filled(loaded.spec, loaded.data)
    lines = list(_lines(whole, (), loaded.data, loaded.lineage))
    width = max((len(text) for text, origin in lines if origin and len(text) < WIDEST), default=0)
    return "".join(f"{text:<{width}}  # {origin}\n" if origin else f"{text}\n" for text, origin in lines)


def _filled(part: Part, data: Data) -> dict[str, Data]:
    """Return the data of a part, then what is not written there; empty defaults are left out."""
    written = data if isinstance(data, dict) else {}
    known = {key: _value(getattr(part, key), written.get(key)) for key in type(part).model_fields}
    free = {key: each for key, each in written.items() if key not in known}
    ordered = {key: known.get(key, free.get(key)) for key in (*written, *known)}
    return {key: each for key, each in ordered.items() if key in written or each not in (None, "", {}, [])}


def _value(value: object, data: Data) -> Data:
    """Return a value as it is written, or as it would be."""
    if isinstance(value, Part):
        return _filled(value, data)
    if isinstance(value, dict) and any(isinstance(each, Part) for each in value.values()):
        written = data if isinstance(data, dict) else {}
        return {str(key): _value(each, written.get(str(key))) for key, each in value.items()}
    if data is not None:
        return data
    return (
        value.text
        if isinstance(value, Expression)
        else value
        if isinstance(value, str | int | float)
        else None
    )


def _lines(value: dict[str, Data], path: DataPath, data: Data, lineage: Lineage) -> Iterator[tuple[str, str]]:
    """Yield lines of YAML, each with the origin that is to be noted on it, if any."""
    indent = 2 * len(path) * " "
    for key, each in value.items():
        here = (*path, key)
        if isinstance(each, dict) and each:
            yield from [("", "")] * (not path)
            yield f"{indent}{key}:", ""
            yield from _lines(each, here, data, lineage)
        else:
            yield from _leaf(key, each, indent, _origin(here, data, lineage))


def _leaf(key: str, value: Data, indent: str, origin: str) -> Iterator[tuple[str, str]]:
    """Yield the lines of an entry; a comment after the first of several would end a text that goes on."""
    lines = entry_lines(key, value, len(indent))
    noted = 0 if lines[0].endswith((":", "|", "|-", "|+")) else len(lines) - 1
    for number, line in enumerate(lines):
        yield indent + line, origin if number == noted else ""


def _origin(path: DataPath, data: Data, lineage: Lineage) -> str:
    asked, written = _at(data, path), _at(lineage.data, path)
    if asked is None:
        return DEFAULT
    if asked != written:
        return OVERRIDE
    place = lineage.place(path, on_key=True)
    return f"{place.file}:{place.line}"


def _at(data: Data, path: DataPath) -> Data:
    for segment in path:
        data = data.get(str(segment)) if isinstance(data, dict) else None
    return data
