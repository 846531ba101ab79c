"""Behaviors of a spec that extends another, with misspelled names: they are those of the base."""

from __future__ import annotations

from pathlib import Path as FilePath
from typing import TYPE_CHECKING

from bbsd.errors import nearest
from bbsd.expression.syntax.mistakes import KEY
from bbsd.language.meant.edits.layout import correction
from bbsd.language.validation import child
from bbsd.text.nodes import Scalar, Sequence

if TYPE_CHECKING:
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

BEHAVIORS: Path = ("behaviors",)
STRUCTURE: Path = ("structure",)


def behaviors_of_the_base(reading: Reading) -> None:
    """Read a behavior without actions, which the base does not have, as the one of the base with nearly its name."""
    own, *bases = reading.files.documents
    based = {name: base for base in reversed(bases) for name in _names(base.data)}
    written = _names(own.data)
    for name in [each for each in written if each not in based]:
        path = (*BEHAVIORS, name)
        value = reading.at(path)
        if not isinstance(value, dict) or "actions" in value or not reading.mapping(BEHAVIORS):
            continue
        near = nearest(name, [each for each in based if each not in written])
        if not near:
            continue
        key, document = reading.key(path), reading.document(path)
        edits = [] if key is None else [document.source.edit(key.start, key.end, near)]
        layers = own.node(STRUCTURE)
        edits += [
            document.source.edit(layer.start, layer.end, near)
            for layer in (layers.items if edits and isinstance(layers, Sequence) else ())
            if isinstance(layer, Scalar) and layer.text == name
        ]
        file = FilePath(based[near].source.file).name
        message = f'{file} has no behavior "{name}"; did you mean "{near}"?'
        advice = "a behavior of its own needs actions; one of the base keeps those that it has there"
        reading.tell(path, "BB020", message, advice, correction(document, edits), KEY)
        _lay(reading, path, (*BEHAVIORS, near))
        structure = reading.data.get("structure")
        if isinstance(structure, list):
            reading.data["structure"] = [near if each == name else each for each in structure]


def _names(data: Data) -> list[str]:
    behaviors = child(data, "behaviors")
    return [*behaviors] if isinstance(behaviors, dict) else []


def _lay(reading: Reading, over: Path, base: Path) -> None:
    """Lay a mapping over another, level by level, and take it away."""
    for key, value in [*reading.mapping(over).items()]:
        if isinstance(value, dict) and isinstance(reading.at((*base, key)), dict):
            _lay(reading, (*over, key), (*base, key))
        else:
            reading.move((*over, key), (*base, key))
    reading.remove(over)
