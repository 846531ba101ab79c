"""Explain a design: what it does, from its tables alone, without a compiler."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.api.specs import AnySpec, load
from bbsd.architecture import architecture_of
from bbsd.explanation import Explanation, explain_architecture

if TYPE_CHECKING:
    from collections.abc import Sequence


def explain(spec: AnySpec, *, seed: int = 0, overrides: Sequence[str] = ()) -> Explanation:
    """Describe in words what the design of a spec does, layer by layer.

    Raises:
        SpecError: with all mistakes of the spec.
        HolesLeft: the spec has holes.
    """
    meaning = load(spec, seed=seed, overrides=overrides).meaning
    return explain_architecture(meaning, architecture_of(meaning))
