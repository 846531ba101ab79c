"""Whole numbers and random orders from named streams, for compiled code."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.jit import jit
from bbsd.kernel.streams import fold, word_of

if TYPE_CHECKING:
    from numpy.typing import NDArray


@jit
def below(bits: int, n: int) -> int:
    """A whole number from 0 to n - 1 from 64 random bits; its probability is 1 / n within 2**-32."""
    return int(np.int64(((bits >> 32) * word_of(n)) >> 32))  # signed, to count with


@jit
def shuffle(key: int, cards: NDArray[np.int64], n_dealt: int) -> None:
    """Deal a uniformly random ordered selection of the cards to their front, in place (Fisher and Yates).

    Args:
        key: a word; uint64 in compiled code.
        cards: (n_cards,), changed.
        n_dealt: how many to deal, at most n_cards.
    """
    for place in range(n_dealt):
        other = place + below(fold(int(key), word_of(place)), len(cards) - place)
        cards[place], cards[other] = cards[other], cards[place]
