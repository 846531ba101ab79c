"""Guesses at the name that was meant."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

LONGEST_GUESSED = 100  # difflib is quadratic, and no name is that long


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return `; did you mean "..."?` with the known name nearest to the word, or '' if none is near."""
    if len(word) > LONGEST_GUESSED:
        return ""
    near = get_close_matches(word, list(known), n=1)
    return f'; did you mean "{near[0]}"?' if near else ""
