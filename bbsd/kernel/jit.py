"""The one place that compiles: how numba is imported, where its cache lies, the options of every function."""

from __future__ import annotations

import os
from contextlib import contextmanager
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from bbsd.kernel import functions, streams
from bbsd.kernel.cache import cache_folder, kernel_digest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

Function = TypeVar("Function", bound="Callable[..., Any]")

CONFIG_FILE = ".numba_config.yaml"


@contextmanager
def _config_file_unseen() -> Iterator[None]:
    """Hides numba's configuration file: a folder that is only visited must not decide what numba does."""
    seen = os.path.isfile
    vars(os.path)["isfile"] = lambda path: path != CONFIG_FILE and seen(path)
    try:
        yield
    finally:
        vars(os.path)["isfile"] = seen


with _config_file_unseen():
    import numba
    from numba.core import config
    from numba.core.codegen import get_host_cpu_features
    from numba.core.dispatcher import Dispatcher

    from bbsd.kernel import intrinsics
    from bbsd.kernel.pipeline import KernelCompiler

# numba looks for the file again at every compilation; and someone else may have imported numba before.
SETTINGS = vars(config)
SETTINGS["_config_fname"] = os.devnull
SETTINGS["reload_config"]()


def with_widest_vectors(host: str) -> str:
    """A processor's features such that LLVM uses the widest vectors there are.

    For some of Intel's it prefers half of them, as wide ones once slowed the clock; a kernel is a fifth slower by that.
    """
    return f"{host},-prefer-256-bit" if "+avx512f" in host.split(",") else host


if SETTINGS["CPU_FEATURES"] is None:  # else it is the user's wish
    SETTINGS["CPU_FEATURES"] = with_widest_vectors(get_host_cpu_features())  # type: ignore[no-untyped-call]  # numba has no types

OPTIONS: Any = {"error_model": "numpy", "nogil": True, "no_cfunc_wrapper": True}
# A function that is called and not inlined would keep a loop over lanes scalar.
# Nor is it called from outside, so it needs no wrappers.
LIBRARY_OPTIONS: Any = {
    "error_model": "numpy",
    "forceinline": True,
    "no_cfunc_wrapper": True,
    "no_cpython_wrapper": True,
}


def _library() -> list[Dispatcher]:
    """Makes the library's functions callable in compiled code; whoever calls this has to keep them.

    Each is kept on disk by itself, for otherwise a kernel would compile all those anew that it calls.
    """
    intrinsics.register()
    found = []
    with _cached_in(cache_folder("compiled") / kernel_digest()):
        for function in functions.COMPILABLE + streams.COMPILABLE:
            found.append(numba.njit(cache=True, **LIBRARY_OPTIONS)(function))
            intrinsics.offer(function, found[-1])
    return found


@contextmanager
def _cached_in(folder: Path) -> Iterator[None]:
    """What is made to be compiled meanwhile is kept there."""
    kept = SETTINGS["CACHE_DIR"]
    SETTINGS["CACHE_DIR"] = str(folder)
    try:
        yield
    finally:
        SETTINGS["CACHE_DIR"] = kept


LIBRARY = _library()


def jit(function: Function, **more: object) -> Function:
    """The function, compiled when it is called, with strict floating point, without the GIL, cached on disk.

    numba's cache knows the text of the function's own file; its folder is named by all else that counts.
    """
    options: Any = {**OPTIONS, **more}
    with _cached_in(cache_folder("compiled") / _stamp(function)):
        compiled: Function = numba.njit(cache=True, **options)(function)
    return compiled


def jit_kernel(function: Function) -> Function:
    """The same for plain loops over numbers, which compile faster: functions that make no arrays and keep none."""
    return jit(function, _nrt=False, pipeline_class=KernelCompiler)


def _stamp(function: Callable[..., Any]) -> str:
    """A name for all that is compiled into the function: this package, files of callees, constants."""
    known = sha256(kernel_digest().encode())
    for file, numbers in sorted(_compiled_in(function, {}).items()):
        known.update(f"{_text_digest(file)}{numbers}".encode())
    return known.hexdigest()[:16]


def _compiled_in(function: Callable[..., Any], found: dict[str, str]) -> dict[str, str]:
    """By file, the numbers among the globals of the function's module and of those its callees come from."""
    names = function.__globals__
    numbers = {name: value for name, value in names.items() if isinstance(value, int | float)}
    found[function.__code__.co_filename] = repr(sorted(numbers.items()))
    for value in list(names.values()):
        if isinstance(value, Dispatcher) and value.py_func.__code__.co_filename not in found:
            _compiled_in(value.py_func, found)
    return found


@cache
def _text_digest(file: str) -> str:
    return sha256(Path(file).read_bytes()).hexdigest()
