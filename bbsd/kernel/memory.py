"""The working memory of a kernel: one array, and views of its parts.

The functions are plain NumPy here and a few instructions in compiled code (`kernel.intrinsics`); NumPy's own views
would be compiled anew for every kernel. Kernels do not allocate, so nothing in them is reference-counted or freed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

Array = np.ndarray[tuple[int], np.dtype[Any]]

CACHE_LINE = 64
"""In bytes. Loading a vector that lies across two lines takes twice the time."""


def zeros(size: int) -> NDArray[np.float64]:
    """Return new memory that begins at a cache line, (size,); not for compiled code."""
    numbers = np.zeros(size + CACHE_LINE // 8)
    address, _ = numbers.__array_interface__["data"]
    return part(numbers, -address % CACHE_LINE // 8, size)


def part(array: Array, first: int, size: int) -> Array:
    """Return a view of `size` elements from `first` on, (size,); compiled code does not check that they exist."""
    return array[first : first + size]


def as_words(numbers: NDArray[np.float64]) -> NDArray[np.uint64]:
    """Return the same memory as keys of streams, (size,)."""
    return numbers.view(np.uint64)


def as_integers(numbers: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the same memory as whole numbers, (size,)."""
    return numbers.view(np.int64)
