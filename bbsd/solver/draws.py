"""Whole numbers and random orders from named streams, for compiled code."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.jit import jit
from bbsd.kernel.streams import mark, marked, word_of

if TYPE_CHECKING:
    from numpy.typing import NDArray


@jit
def below(bits: int, n: int) -> int:
    """Return a whole number from 0 to n - 1 from 64 random bits; its probability is 1 / n within 2**-32."""
    return int(np.int64(((bits >> 32) * word_of(n)) >> 32))  # signed, to count with


@jit
def marks(count: int) -> NDArray[np.uint64]:
    """Return the marks of the words 0, 1, ..., (count,): many streams have parts with these names."""
    of_words = np.empty(count, np.uint64)
    for word in range(count):
        of_words[word] = mark(word_of(word))
    return of_words


@jit
def shuffle(key: int, cards: NDArray[np.int64], n_dealt: int, places: NDArray[np.uint64]) -> None:
    """Deal a uniformly random ordered selection of the cards to their front, in place (Fisher and Yates).

    Args:
        key: names the stream; uint64 in compiled code.
        cards: (n_cards,), changed.
        n_dealt: how many to deal, at most n_cards.
        places: `marks` of at least n_dealt.
    """
    for place in range(n_dealt):
        other = place + below(marked(int(key), int(places[place])), len(cards) - place)
        cards[place], cards[other] = cards[other], cards[place]
