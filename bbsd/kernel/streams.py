"""Counter-based random streams: a draw is a pure function of its key and of the word that names it.

A key is folded from what the draw belongs to (seed, generation, agent, episode, purpose), never from how many
draws were made before, so the result is the same for any number of lanes, workers and any order. The
functions are plain Python on integers below 2**64; `kernel.jit` makes the same source available to compiled
code, where words are uint64.

The mixing function is the finalizer of SplitMix64 (Steele, Lea and Flood 2014), with the constants of
Stafford's variant 13.
"""

from __future__ import annotations

from hashlib import blake2b
from math import pi
from types import MappingProxyType
from typing import TYPE_CHECKING

from bbsd.kernel.functions import cos, floor, log, maximum, minimum, sqrt
from bbsd.kernel.primitives import MASK, word_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

__all__ = [
    "COMPILABLE",
    "DISTRIBUTIONS",
    "chance",
    "fold",
    "integers",
    "mark",
    "marked",
    "mix64",
    "name_word",
    "normal",
    "uniform",
    "unit",
    "word_of",
]

GOLDEN = 0x9E3779B97F4A7C15
MULTIPLIER_1 = 0xBF58476D1CE4E5B9
MULTIPLIER_2 = 0x94D049BB133111EB
UNIT = 2.0**-53


def name_word(name: str) -> int:
    """Return the word that stands for a name: a purpose, or a place in a spec; not for compiled code."""
    return int.from_bytes(blake2b(name.encode(), digest_size=8).digest(), "little")


def mix64(word: int) -> int:
    """Map a 64-bit word to another, one to one: every input bit changes every output bit with probability near 1/2."""
    word = ((word ^ (word >> 30)) * MULTIPLIER_1) & MASK
    word = ((word ^ (word >> 27)) * MULTIPLIER_2) & MASK
    return word ^ (word >> 31)


def mark(word: int) -> int:
    """Return the mark of a word, by which it is folded into a key; a loop over many keys needs it once."""
    return mix64((word + GOLDEN) & MASK)


def marked(key: int, mark: int) -> int:
    """Return the key of the stream within the stream of `key` whose word has that mark."""
    return mix64(key ^ mark)


def fold(key: int, word: int) -> int:
    """Return the key of the stream called `word` within the stream of `key`."""
    return marked(key, mark(word))


def unit(bits: int) -> float:
    """Return a number in [0, 1), a multiple of 2**-53, made of 64 random bits."""
    return (bits >> 11) * UNIT


def uniform(key: int, word: int, low: float, high: float) -> float:
    """Draw uniformly from low to high; high itself only where the sum is rounded to it."""
    return low + (high - low) * unit(fold(key, word))


def integers(key: int, word: int, first: float, last: float) -> float:
    """Draw a whole number from first to last, both included; `first` where last < first."""
    span = maximum(last - first + 1.0, 1.0)
    return first + minimum(floor(unit(fold(key, word)) * span), span - 1.0)


def chance(key: int, word: int, probability: float) -> bool:
    """Return True with the given probability."""
    return unit(fold(key, word)) < probability


def normal(key: int, word: int, mean: float, sd: float) -> float:
    """Draw from a normal distribution by Box and Muller (1958), the two uniforms from two streams of the word."""
    bits = fold(key, word)
    radius = sqrt(-2.0 * log(1.0 - unit(bits)))
    return mean + sd * (radius * cos(2.0 * pi * unit(mix64(bits ^ GOLDEN))))


DISTRIBUTIONS: Mapping[str, Callable[..., float]] = MappingProxyType(
    {"chance": chance, "integers": integers, "normal": normal, "uniform": uniform}
)
"""The distributions of the language by their names there: functions of (key, word, *parameters)."""

COMPILABLE = (mix64, mark, marked, fold, unit, uniform, integers, chance, normal)
