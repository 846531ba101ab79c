"""Where a spec does not fit its environment."""

from __future__ import annotations

from typing import NamedTuple

Path = tuple[str | int, ...]


class Misfit(NamedTuple):
    """A mistake in a spec that only its environment shows: the kind, the place, what is wrong, what to do."""

    code: str
    path: Path
    message: str
    advice: str = ""


class UnfitError(Exception):
    """A spec that does not fit its environment: at least one misfit."""

    def __init__(self, *misfits: Misfit) -> None:
        super().__init__(*misfits)
        self.misfits = misfits
