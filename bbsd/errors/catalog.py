"""All kinds of mistakes by their stable codes; each layer lists the kinds that it finds in one module."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors.text_kinds import TEXT_KINDS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.errors.kind import Kind

KINDS: Mapping[str, Kind] = {kind.code: kind for kind in (*TEXT_KINDS,)}


def describe(code: str) -> Kind:
    """Return the kind of mistake of a code, in either case; raises KeyError if there is no such code."""
    return KINDS[code.upper()]
