"""An architecture as a change of the spec that it was designed from: the blocks that fill its holes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.architecture.drawn_constants import drawn_constants
from bbsd.architecture.rules import rules_of
from bbsd.language.meaning.tables.symbols import filled_text, text_of_table
from bbsd.language.models import OPEN
from bbsd.text.writing.patch import DELETE

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bbsd.architecture.architecture import Architecture
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.models import Behavior
    from bbsd.text import Data, DataPath
    from bbsd.text.writing.patch import Deletion

MOST_WORDS = 3000
"""Words of a behavior's rules: some five hundred rules, a tenth of a second to read; nobody reads more."""
NO_WORDS = -1
"""The limit that no rule keeps, not even one."""


def spec_changes(
    meaning: Meaning, architecture: Architecture, most_words: int = MOST_WORDS
) -> dict[DataPath, Data | Deletion]:
    """Return what to write at which path, so that the spec has no holes, needs no seed, and means this architecture.

    Only what is open is filled: behaviors with open cells, a structure with open layers, and constants that
    were drawn. What was given as a table stays one; other behaviors get rules, or a table where rules would
    have more than `most_words` decisions and named cells.
    """
    modules = zip(meaning.episode.modules, architecture.tables, strict=True)
    behaviors: dict[DataPath, Data | Deletion] = {}
    for index, (module, table) in enumerate(modules):
        if module.table.is_open and meaning.structure.may_hold(index):
            values = _cells(module, meaning.spec.behaviors[module.name], table, most_words)
            behaviors |= {("behaviors", module.name, key): value for key, value in values.items()}
    return {**drawn_constants(meaning), **behaviors, **_structure(meaning, architecture)}


def _cells(
    module: Module, behavior: Behavior, table: NDArray[np.uint8], most_words: int
) -> dict[str, Data | Deletion]:
    """Return what to write under a behavior's keys for its cells."""
    if behavior.table is not None:
        return {"table": filled_text(behavior.table, table.tolist())}
    rules = rules_of(table, module.inputs, [*module.actions], behavior.rules or (), most_words)
    if rules is not None:
        return {"rules": [*rules]}
    removed: dict[str, Data | Deletion] = {"rules": DELETE} if behavior.rules is not None else {}
    return removed | {"table": text_of_table(table.tolist(), module.inputs)}


def _structure(meaning: Meaning, architecture: Architecture) -> dict[DataPath, Data | Deletion]:
    given = meaning.spec.structure
    if given is not None and OPEN not in given:
        return {}
    names = [*meaning.spec.behaviors]
    return {("structure",): [names[behavior] for behavior in reversed(architecture.structure.tolist())]}
