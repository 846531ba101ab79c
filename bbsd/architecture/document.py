"""The text of a design: the designer's file with its holes filled, and whether it could be too large to write."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.architecture import Architecture
from bbsd.architecture.spec_changes import MOST_WORDS, NO_WORDS, spec_changes
from bbsd.errors import Diagnosis
from bbsd.language.meaning.structure import OPEN_LAYER
from bbsd.language.meaning.tables.table import OPEN_CELL
from bbsd.text.writing.modeline import without_relative_modeline
from bbsd.text.writing.patch import TooLargeError, differences, read_back, replace_blocks, with_change
from bbsd.text.writing.writer import write

if TYPE_CHECKING:
    from bbsd.language.loading import Loaded
    from bbsd.language.meaning import Meaning
    from bbsd.text import Data, DataPath
    from bbsd.text.writing.patch import Deletion

WORD_LIMITS = (MOST_WORDS, MOST_WORDS // 10, NO_WORDS)
"""Words of a behavior's rules, one limit after another until the file is not too large; in the end none, but tables."""


def designed_text(loaded: Loaded, architecture: Architecture) -> str:
    """Return the designer's file with overrides set and holes filled, and all else as it was.

    Only a comment that names an editor's schema by a relative path is left out: in a run's folder that leads nowhere.
    Raises TooLargeError, but never after `require_writable`.
    """
    for most_words in WORD_LIMITS[:-1]:
        with suppress(TooLargeError):
            return _text(loaded, architecture, most_words)
    return _text(loaded, architecture, WORD_LIMITS[-1])


def require_writable(loaded: Loaded) -> None:
    """Raise SpecError if a design of the spec could be too large to write, even with all tables as text."""
    largest = _largest(loaded.meaning)
    try:
        if not (loaded.lineage.flat and _fits(loaded, largest)):
            _text(loaded, largest, NO_WORDS)
    except TooLargeError as error:
        raise loaded.lineage.error([_too_large(loaded, error.path)]) from None


def _fits(loaded: Loaded, largest: Architecture) -> bool:
    """Return whether the data can be written anew as a whole, the last resort of `replace_blocks`."""
    data: Data = loaded.data
    for path, value in spec_changes(loaded.meaning, largest, NO_WORDS).items():
        data = with_change(data, path, value)
    return isinstance(data, dict) and read_back(loaded.source.file, write(data)) is not None


def _text(loaded: Loaded, architecture: Architecture, most_words: int) -> str:
    changes: dict[DataPath, Data | Deletion] = {
        **dict(differences(loaded.lineage.data, loaded.data)),
        **spec_changes(loaded.meaning, architecture, most_words),
    }
    return without_relative_modeline(replace_blocks(loaded.lineage.flat, changes, after="behaviors"))


def _largest(meaning: Meaning) -> Architecture:
    """Return an architecture that takes the most characters: last actions, and behaviors with long names."""
    modules, structure = meaning.episode.modules, meaning.structure
    tables = (np.full(module.n_cells, len(module.actions), np.uint8) for module in modules)
    n_open = structure.layers.count(OPEN_LAYER)
    longest = sorted(structure.candidates, key=lambda index: -len(modules[index].name.encode()))[:n_open]
    return Architecture(tuple(tables), np.array([*filter(_is_given, structure.layers), *longest], np.int64))


def _is_given(layer: int) -> bool:
    return layer != OPEN_LAYER


def _too_large(loaded: Loaded, path: DataPath) -> Diagnosis:
    """Return the diagnosis of a spec whose designs could not be written because of the value at a path."""
    filling, advice = "what fills the holes", "make it smaller"
    if len(path) == 3 and path[-1] == "table":
        table = next(module.table for module in loaded.meaning.episode.modules if module.name == path[1])
        filling, advice = (
            f"the {table.given.count(OPEN_CELL):,} open cells of {path[1]}",
            "cut the inputs more coarsely",
        )
    message = f"with {filling}, a design would have more than 1 MB or 50 000 keys and values and could not be written"
    return Diagnosis("BB048", message, loaded.lineage.place(path[:2], on_key=True), advice)
