"""Guesses at the name that was meant."""

from __future__ import annotations

from difflib import get_close_matches
from itertools import islice
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

LONGEST_GUESSED = 100  # difflib is quadratic, and no name is that long
MOST_COMPARED = 60  # difflib is slow, and a hostile file has thousands of names and hundreds of mistakes
MOST_KNOWN = 10_000  # cells of a partition, say


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return `; did you mean "..."?` with the known name nearest to the word, or '' if none is near.

    Where no spelling is near, one that abbreviates the other by its initials (dt and delta_t) is.
    """
    if len(word) > LONGEST_GUESSED:
        return ""
    names = _likely(word, list(islice(known, MOST_KNOWN)))
    near = get_close_matches(word, names, n=1) or [name for name in names if _is_short_for(name, word)]
    return f'; did you mean "{near[0]}"?' if near else ""


def _likely(word: str, names: list[str]) -> list[str]:
    """All names if they are few; else some of about the same length that begin or end alike."""
    if len(names) <= MOST_COMPARED:
        return names
    few, many = len(word) * 2 // 3, len(word) * 3 // 2 + 1
    first, last = word[:1], word[-2:]
    alike = [name for name in names if few <= len(name) <= many and (name[:1] == first or name[-2:] == last)]
    return alike[:MOST_COMPARED]


def _is_short_for(one: str, other: str) -> bool:
    return one == _initials(other) or other == _initials(one)


def _initials(name: str) -> str:
    return "".join(part[:1] for part in name.split("_")) if "_" in name else ""
