"""Compiled functions kept in files, each with a digest: a damaged one is removed and made anew.

Numba's own files are pickles: one that was cut short or changed ends the process that reads it.
"""

from __future__ import annotations

import os
import pickle
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numba.core.caching import FunctionCache, IndexDataCacheFile

from bbsd.kernel.cache import DIGEST_SIZE, cache_root, is_whole, trim, with_digest

if TYPE_CHECKING:
    from collections.abc import Callable

    from numba.core.dispatcher import Dispatcher


def keep_compiled(dispatcher: Dispatcher, function: Callable[..., Any]) -> None:
    """Let what is compiled of a function be kept in numba's present cache folder; without one that works, in memory."""
    try:
        vars(dispatcher)["_cache"] = _CheckedCache(function)
    except (OSError, RuntimeError) as error:  # RuntimeError: numba found no folder that it can write to
        _notice(str(error))


def checked_content(path: Path) -> bytes | None:
    """Return a file's content without its digest, or None where it is missing or damaged; a damaged one is removed."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    if is_whole(content):
        return content[:-DIGEST_SIZE]
    with suppress(OSError):
        path.unlink()
    return None


class _CheckedFile(IndexDataCacheFile):
    """The index of a function's compiled forms, and a file for each of them."""

    def _load_index(self) -> dict[Any, str]:
        path = Path(self._index_path)
        content = checked_content(path)
        if content is None:
            return {}
        version, stamp, overloads = pickle.loads(content)  # noqa: S301 - only the user can write in the cache
        if (version, stamp) != (self._version, self._source_stamp):
            return {}
        with suppress(OSError):
            os.utime(path)  # when it was last used
        return dict(overloads)

    def _save_index(self, overloads: dict[Any, str]) -> None:
        self._save(self._index_path, (self._version, self._source_stamp, overloads))

    def _load_data(self, name: str) -> object:
        content = checked_content(Path(self._data_path(name)))
        if content is None:
            raise FileNotFoundError(name)  # which the caller takes for one that is not there yet
        return pickle.loads(content)  # noqa: S301 - as above

    def _save_data(self, name: str, data: object) -> None:
        self._save(self._data_path(name), data)

    def _save(self, path: str, data: object) -> None:
        content = self._dump(data)
        with self._open_for_write(path) as file:
            file.write(with_digest(content))


class _CheckedCache(FunctionCache):
    """Numba's cache of one function, by checked files; what cannot be kept is compiled again another time."""

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)
        self._cache_file = _CheckedFile(
            self._cache_path, self._impl.filename_base, self._impl.locator.get_source_stamp()
        )

    def save_overload(self, sig: object, data: object) -> None:
        """Keep what was compiled for a signature, if the disk lets it."""
        try:
            super().save_overload(sig, data)
        except OSError as error:
            _notice(error.strerror or str(error))
        else:
            _trim_once()


@cache
def _trim_once() -> None:
    """Keep the cache within its bound, after the first thing that this process adds."""
    with suppress(OSError):
        trim(cache_root())


@cache
def _notice(reason: str) -> None:
    """Say once on standard error that compiled code is not kept, and why."""
    sys.stderr.write(f"bbsd: cannot keep compiled code in {cache_root()}: {reason}\n")
