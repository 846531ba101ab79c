"""The keys that a spec may have in each of its blocks."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, get_args

from bbsd.language.base import Part
from bbsd.language.models import Behavior, Otherwise, Spec, When

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from pydantic.fields import FieldInfo

    from bbsd.expression.scope import Path


def fields_at(path: Path) -> Mapping[str, FieldInfo] | None:
    """Return the keys that may stand below a path; None where they are not the language's own."""
    match path:
        case ("behaviors", _):
            return Behavior.fields_by_key()
        case ("behaviors", _, "rules", int()):
            return {**When.fields_by_key(), **Otherwise.fields_by_key()}
    part: type[Part] | None = Spec
    for segment in path:
        fields = part.fields_by_key() if part else {}
        part = next(_parts(fields[str(segment)].annotation), None) if segment in fields else None
    return part.fields_by_key() if part else None


def field_at(path: Path) -> FieldInfo | None:
    """Return the key that a path ends with; None where it is not one of the language's own."""
    return (fields_at(path[:-1]) or {}).get(str(path[-1])) if path else None


def blocks_with(key: str) -> list[str]:
    """Return the blocks that have a key of this name, as paths; a spec itself is the top level."""
    return [name for name, keys in _blocks() if key in keys]


@cache
def _blocks() -> list[tuple[str, frozenset[str]]]:
    """Return all blocks, each with its keys; looked up once, since a spec may have thousands of unexpected keys."""
    blocks: list[tuple[str, type[Part]]] = [
        ("the top level", Spec),
        ("a behavior", Behavior),
        ("a rule", When),
    ]
    for name, part in blocks:  # it grows while it is read
        prefix = "" if part is Spec else f"{name}."
        blocks += [
            (f"{prefix}{inner_key}", inner)
            for inner_key, field in part.fields_by_key().items()
            for inner in _parts(field.annotation)
        ]
    return [(name, frozenset(part.fields_by_key())) for name, part in blocks]


def _parts(annotation: object) -> Iterator[type[Part]]:
    """Yield the parts of a spec that a key may hold itself, not in a mapping or a list."""
    if isinstance(annotation, type):
        if issubclass(annotation, Part):
            yield annotation
    elif not isinstance(annotation, type(dict[str, str])):
        for argument in get_args(annotation):
            yield from _parts(argument)
