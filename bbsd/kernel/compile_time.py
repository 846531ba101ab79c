"""How long this process has compiled; Numba need not be imported to ask."""

from __future__ import annotations

import sys


def seconds_compiling() -> float:
    """Return how many seconds this process has spent on compiling kernels, those of other processes not included."""
    jit = sys.modules.get("bbsd.kernel.jit")
    return jit.COMPILING.duration if jit is not None and jit.COMPILING.done else 0.0
