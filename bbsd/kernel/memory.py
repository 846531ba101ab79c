"""The working memory of a kernel: one array, and views of its parts. Plain NumPy here, a few instructions compiled.

`kernel.intrinsics` gives compiled code the views; NumPy's own would be compiled anew for every kernel.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

Array = np.ndarray[tuple[int], np.dtype[Any]]


def zeros(size: int) -> NDArray[np.float64]:
    """New memory, (size,)."""
    return np.zeros(size, np.float64)


def part(array: Array, first: int, size: int) -> Array:
    """A view of so many elements, (size,); compiled code does not look whether there are as many."""
    return array[first : first + size]


def as_words(numbers: NDArray[np.float64]) -> NDArray[np.uint64]:
    """The same memory as keys of streams, (size,)."""
    return numbers.view(np.uint64)


def as_integers(numbers: NDArray[np.float64]) -> NDArray[np.int64]:
    """The same memory as whole numbers, (size,)."""
    return numbers.view(np.int64)


COMPILABLE = (zeros,)
