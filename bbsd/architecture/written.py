"""An architecture as a change of the spec that it was designed from: the blocks that fill its holes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.architecture.rules import rules_of
from bbsd.architecture.settled import settled_constants
from bbsd.spec.models import OPEN

if TYPE_CHECKING:
    from bbsd.architecture.architecture import Architecture
    from bbsd.spec.meaning import Meaning
    from bbsd.text import Data, DataPath


def spec_changes(meaning: Meaning, architecture: Architecture) -> dict[DataPath, Data]:
    """What to write where, so that the spec has no holes, needs no seed, and means this architecture.

    Only what is open is filled: rules of behaviors with open cells, a structure with open layers, and
    constants that were drawn.
    """
    return {
        **settled_constants(meaning),
        **_rules(meaning, architecture),
        **_structure(meaning, architecture),
    }


def _rules(meaning: Meaning, architecture: Architecture) -> dict[DataPath, Data]:
    modules = zip(meaning.episode.modules, architecture.tables, strict=True)
    return {
        ("behaviors", module.name, "rules"): [
            *rules_of(
                table, module.inputs, [*module.actions], meaning.spec.behaviors[module.name].rules or ()
            )
        ]
        for index, (module, table) in enumerate(modules)
        if module.table.is_open and meaning.structure.may_hold(index)
    }


def _structure(meaning: Meaning, architecture: Architecture) -> dict[DataPath, Data]:
    given = meaning.spec.structure
    if given is not None and OPEN not in given:
        return {}
    names = [*meaning.spec.behaviors]
    return {("structure",): [names[behavior] for behavior in reversed(architecture.structure.tolist())]}
