"""Write a design in fewer words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.api.specs import AnySpec, load
from bbsd.architecture.shorter import Shorter, shorter

if TYPE_CHECKING:
    from collections.abc import Sequence


def tidy(spec: AnySpec, *, overrides: Sequence[str] = ()) -> Shorter:
    """Return a design in fewer words that is proven to do the same in every joint cell; write nothing.

    Raises:
        SpecError: with all mistakes of the spec.
        HolesLeft: the spec has holes.
        TooLargeToProve: the joint space is too large to go through.
    """
    return shorter(load(spec, overrides=overrides))
