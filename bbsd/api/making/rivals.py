"""Which rivals a design can have."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.api.given.arguments import BadArgument
from bbsd.errors import did_you_mean
from bbsd.runs.rivals import all_rivals

if TYPE_CHECKING:
    from collections.abc import Sequence


def known_rivals(names: Sequence[str], method: str) -> None:
    """Raise BadArgument for a rival that is no other method, or is named twice."""
    others = all_rivals(method)
    advice = f"the others are {', '.join(others)}"
    for index, name in enumerate(names):
        if name == method:
            raise BadArgument(f"rivals: {name} is the method of the design itself", advice)
        if name not in others:
            raise BadArgument(f"rivals: {name!r} is no method{did_you_mean(name, others)}", advice)
        if name in names[:index]:
            raise BadArgument(f"rivals: {name} is named twice")
