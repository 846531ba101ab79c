"""A spec with its defaults filled in, and the origin of each value."""

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
LAST_COMMENT_COLUMN = 72
"""The last column at which comments are aligned; a longer line has its comment right behind it."""


def configuration_text(loaded: Loaded) -> str:
    """Return a spec, with those that it extends and with all defaults, as YAML.

    A comment says where each value comes from: file:line, default, or --set.
    """
    data = _with_defaults(loaded.spec, loaded.data)
    lines = list(_lines(data, (), loaded.data, loaded.lineage))
    width = max(
        (len(text) for text, origin in lines if origin and len(text) < LAST_COMMENT_COLUMN), default=0
    )
    return "".join(f"{text:<{width}}  # {origin}\n" if origin else f"{text}\n" for text, origin in lines)


def _with_defaults(part: Part, data: Data) -> dict[str, Data]:
    """Return the data of a part, followed by its defaults for keys that are not written, unless they are empty."""
    written = data if isinstance(data, dict) else {}
    fields = {key: _value(value, written.get(key)) for key, value in part.values_by_key().items()}
    others = {key: value for key, value in written.items() if key not in fields}
    ordered = {key: fields.get(key, others.get(key)) for key in (*written, *fields)}
    return {key: value for key, value in ordered.items() if key in written or value not in (None, "", {}, [])}


def _value(value: object, data: Data) -> Data:
    """Return the data of a value as it is written, or as its default would be written."""
    if isinstance(value, Part):
        return _with_defaults(value, data)
    if isinstance(value, dict) and any(isinstance(part, Part) for part in value.values()):
        written = data if isinstance(data, dict) else {}
        return {str(key): _value(part, written.get(str(key))) for key, part in value.items()}
    if data is not None:
        return data
    return (
        value.text
        if isinstance(value, Expression)
        else value
        if isinstance(value, str | int | float)
        else None
    )


def _lines(block: dict[str, Data], path: DataPath, data: Data, lineage: Lineage) -> Iterator[tuple[str, str]]:
    """Yield lines of YAML, each with the origin for its comment, or ""."""
    indent = 2 * len(path) * " "
    for key, value in block.items():
        value_path = (*path, key)
        if isinstance(value, dict) and value:
            yield from [("", "")] * (not path)
            yield f"{indent}{key}:", ""
            yield from _lines(value, value_path, data, lineage)
        else:
            yield from _leaf(key, value, indent, _origin(value_path, data, lineage))


def _leaf(key: str, value: Data, indent: str, origin: str) -> Iterator[tuple[str, str]]:
    """Yield the lines of an entry; its comment is on the last one, since it would end a text of several lines."""
    lines = entry_lines(key, value, len(indent))
    commented = 0 if lines[0].endswith((":", "|", "|-", "|+")) else len(lines) - 1
    for number, line in enumerate(lines):
        yield indent + line, origin if number == commented else ""


def _origin(path: DataPath, data: Data, lineage: Lineage) -> str:
    value, written = _at(data, path), _at(lineage.data, path)
    if value is None:
        return DEFAULT
    if value != written:
        return OVERRIDE
    place = lineage.place(path, on_key=True)
    return f"{place.file}:{place.line}"


def _at(data: Data, path: DataPath) -> Data:
    for segment in path:
        data = data.get(str(segment)) if isinstance(data, dict) else None
    return data
