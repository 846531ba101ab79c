"""Names of a spec as identifiers of other languages: ASCII, unlike their words, and all different."""

from __future__ import annotations

import re
import unicodedata
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection

SIGNED = re.compile(r"(?<![0-9A-Za-z.)\]])-(?=[0-9.])")
"""The sign of a number, as in `-1 to 2`."""


def words_of(text: str) -> str:
    """Return a text as letters, digits and single underscores; accents are dropped, other letters become their codes.

    What an identifier needs besides, a letter at its start, `Names` sees to.
    """
    plain = unicodedata.normalize("NFKD", SIGNED.sub("minus ", text))
    kept = "".join(each for each in plain if not unicodedata.combining(each))
    coded = "".join(
        each if each.isascii() else f"_u{ord(each):x}_" if each.isalnum() else "_" for each in kept
    )
    return re.sub(r"[^0-9A-Za-z]+", "_", coded).strip("_")


class Names:
    """Gives out identifiers, each once.

    Args:
        reserved: Words that cannot be identifiers.
        prefix: What all of them begin with; a name that would begin with a digit without it gets an underscore.
    """

    def __init__(self, reserved: Collection[str], prefix: str = "") -> None:
        self._taken = set(reserved)
        self._prefix = prefix

    def new(self, text: str, *, upper: bool = False, lower: bool = False) -> str:
        """Return an identifier for a text; where it is taken, a number follows it."""
        words = self._prefix + (words_of(text) or "unnamed")
        words = words.upper() if upper else words.lower() if lower else words
        words = f"_{words}" if words[0].isdigit() else words
        name, count = words, 1
        while name in self._taken:
            count += 1
            name = f"{words}_{count}"
        self._taken.add(name)
        return name
