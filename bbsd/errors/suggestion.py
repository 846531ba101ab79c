"""Suggestions for a misspelled name."""

from __future__ import annotations

from difflib import get_close_matches
from itertools import islice
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

MAX_WORD = 100  # characters; difflib takes quadratic time, and no name is that long
MAX_COMPARED = (
    60  # names; difflib is slow, and a hostile file has thousands of names and hundreds of mistakes
)
MAX_KNOWN = 10_000  # names; the cells of a partition can be as many


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return `; did you mean "..."?` with the known name nearest to the word, or '' if none is near.

    Where no spelling is near, a name is if it or the word abbreviates the other by its initials (dt and delta_t).
    """
    near = nearest(word, known)
    return f'; did you mean "{near}"?' if near else ""


def nearest(word: str, known: Iterable[str]) -> str:
    """Return the known name nearest to the word, '' if none is near."""
    if len(word) > MAX_WORD:
        return ""
    names = _likely(word, list(islice(known, MAX_KNOWN)))
    near = get_close_matches(word, names, n=1) or [name for name in names if _is_short_for(name, word)]
    return near[0] if near else ""


def _likely(word: str, names: list[str]) -> list[str]:
    """Return all names if they are few; else some of about the word's length that begin or end as it does."""
    if len(names) <= MAX_COMPARED:
        return names
    shortest, longest = len(word) * 2 // 3, len(word) * 3 // 2 + 1
    first, last = word[:1], word[-2:]
    alike = [
        name
        for name in names
        if shortest <= len(name) <= longest and (name[:1] == first or name[-2:] == last)
    ]
    return alike[:MAX_COMPARED]


def _is_short_for(one: str, other: str) -> bool:
    """Say whether one of two names consists of the other's initials."""
    return one == _initials(other) or other == _initials(one)


def _initials(name: str) -> str:
    return "".join(part[:1] for part in name.split("_")) if "_" in name else ""
