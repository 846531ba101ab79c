"""The meaning of specs that Hypothesis makes up."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hypothesis import assume

from bbsd.language.meaning import elaborate
from bbsd.language.models import Spec

if TYPE_CHECKING:
    from bbsd.language.meaning import Meaning
    from tests.interpreter.made_up import Block

MADE_UP_TOO = ("BB125", "BB135", "BB141")
"""Mistakes that made-up specs may have: a division by zero, an element that is set twice, a draw of nothing."""


def meaning_made_up(data: Block, seed: int) -> Meaning:
    """Return what a made-up spec means; one with a mistake that is made up too is another's example."""
    meaning, mistakes = elaborate(Spec.model_validate(data), seed)
    assume(all(mistake.code not in MADE_UP_TOO for _, mistake in mistakes))
    assert mistakes == ()
    assert meaning is not None
    return meaning
