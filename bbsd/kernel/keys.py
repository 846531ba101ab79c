"""Keys of many random streams at once, for lanes that run in lock-step."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from bbsd.kernel.streams import fold, unit

if TYPE_CHECKING:
    from numpy.typing import NDArray


def keys(key: int, first: int, count: int) -> NDArray[np.uint64]:
    """Return the keys of the streams called first, first + 1, ... within the stream of `key`; (count,)."""
    words = np.arange(first, first + count, dtype=np.uint64)
    return cast("NDArray[np.uint64]", fold(key, words))  # type: ignore[arg-type]  # the arithmetic is elementwise


def own_keys(key: int, n_owners: int, count: int) -> NDArray[np.uint64]:
    """Return `count` keys for each of several owners, no two the same; (n_owners, count)."""
    return keys(key, 0, n_owners * count).reshape(n_owners, count)


def folded(streams: NDArray[np.uint64], word: int) -> NDArray[np.uint64]:
    """Return the keys of the stream called `word` within each of the streams; (n,)."""
    return cast("NDArray[np.uint64]", fold(streams, word))  # type: ignore[arg-type]  # the arithmetic is elementwise


def units(streams: NDArray[np.uint64]) -> NDArray[np.float64]:
    """Return a number in [0, 1) for each stream, made of its key by `streams.unit`; (n,)."""
    return cast("NDArray[np.float64]", unit(streams))  # type: ignore[arg-type]  # the arithmetic is elementwise
