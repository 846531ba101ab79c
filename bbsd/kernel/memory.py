"""The working memory of a kernel: one array, and views of its parts. Plain NumPy here, a few instructions compiled.

`kernel.intrinsics` gives compiled code the views; NumPy's own would be compiled anew for every kernel. Kernels do not
allocate, so nothing in them is counted or freed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

Array = np.ndarray[tuple[int], np.dtype[Any]]

CACHE_LINE = 64
"""Bytes. A vector that lies across two lines is loaded in twice the time."""


def zeros(size: int) -> NDArray[np.float64]:
    """New memory that begins with a line of the cache, (size,). Not for compiled code."""
    numbers = np.zeros(size + CACHE_LINE // 8)
    address, _ = numbers.__array_interface__["data"]
    return part(numbers, -address % CACHE_LINE // 8, size)


def part(array: Array, first: int, size: int) -> Array:
    """A view of so many elements, (size,); compiled code does not look whether there are as many."""
    return array[first : first + size]


def as_words(numbers: NDArray[np.float64]) -> NDArray[np.uint64]:
    """The same memory as keys of streams, (size,)."""
    return numbers.view(np.uint64)


def as_integers(numbers: NDArray[np.float64]) -> NDArray[np.int64]:
    """The same memory as whole numbers, (size,)."""
    return numbers.view(np.int64)
