"""How long a design takes, and how much of that is compiling."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

from bbsd.kernel.compile_time import seconds_compiling


@dataclass(frozen=True, slots=True)
class Stopwatch:
    """Measures from when it is made."""

    _began: float = field(default_factory=time.monotonic)
    _compiled: float = field(default_factory=seconds_compiling)

    def read(self) -> tuple[float, float]:
        """Return the seconds since then without those of compiling, and those."""
        compiling = seconds_compiling() - self._compiled
        return time.monotonic() - self._began - compiling, compiling
