"""Which episodes another program lives: those of an evaluation by their number, then others by chance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation.streams import evaluation_key
from bbsd.kernel.keys import keys

if TYPE_CHECKING:
    from numpy.random import Generator


def key_of(seed: int, number: int) -> np.uint64:
    """Return the key of an episode of `bbsd evaluate --seed`, by its number from 0 on."""
    key: np.uint64 = keys(evaluation_key(seed), number, 1)[0]
    return key


def drawn_key(generator: Generator) -> np.uint64:
    """Return the key of some episode."""
    return generator.integers(0, 2**64, dtype=np.uint64)
