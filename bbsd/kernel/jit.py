"""The only module that compiles: how numba is imported, where its cache lies, the options of every function."""

from __future__ import annotations

import os
from contextlib import contextmanager
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

from bbsd.kernel import functions, streams
from bbsd.kernel.cache import kernel_digest, version_folder

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

Function = TypeVar("Function", bound="Callable[..., Any]")

CONFIG_FILE = ".numba_config.yaml"


@contextmanager
def _config_file_hidden() -> Iterator[None]:
    """Hide numba's configuration file: the current folder must not decide what numba does."""
    is_file = os.path.isfile
    vars(os.path)["isfile"] = lambda path: path != CONFIG_FILE and is_file(path)
    try:
        yield
    finally:
        vars(os.path)["isfile"] = is_file


with _config_file_hidden():
    import numba
    from numba.core import config
    from numba.core.codegen import get_host_cpu_features
    from numba.core.dispatcher import Dispatcher
    from numba.core.event import TimingListener, register

    from bbsd.kernel import intrinsics
    from bbsd.kernel.compiled_files import keep_compiled
    from bbsd.kernel.pipeline import KernelCompiler

# numba looks for the file again at every compilation; and someone else may have imported numba before.
SETTINGS = vars(config)
SETTINGS["_config_fname"] = os.devnull
SETTINGS["reload_config"]()


def with_widest_vectors(host: str) -> str:
    """Return a processor's features, changed so that LLVM uses the widest vectors that the processor has.

    For some of Intel's processors LLVM prefers vectors of half the width, as wide ones once slowed the clock; a kernel
    is a fifth slower by that.
    """
    return f"{host},-prefer-256-bit" if "+avx512f" in host.split(",") else host


if SETTINGS["CPU_FEATURES"] is None:  # else the user has set them
    SETTINGS["CPU_FEATURES"] = with_widest_vectors(get_host_cpu_features())  # type: ignore[no-untyped-call]  # numba has no types

COMPILING = TimingListener()  # type: ignore[no-untyped-call]  # numba has no types
"""Measures how long is spent on compiling; what is found in the cache takes no time here."""
register("numba:compile", COMPILING)  # type: ignore[no-untyped-call]

OPTIONS: Any = {"error_model": "numpy", "nogil": True, "no_cfunc_wrapper": True}
# Inlined, since a call would keep a loop over lanes scalar; never called from outside, so without wrappers.
LIBRARY_OPTIONS: Any = {
    "error_model": "numpy",
    "forceinline": True,
    "no_cfunc_wrapper": True,
    "no_cpython_wrapper": True,
}


def _library() -> list[Dispatcher]:
    """Compile the library's functions, so that compiled code can call them; the caller must keep the result.

    Each has its own entry in the cache on disk; otherwise a kernel would compile anew all those that it calls.
    """
    intrinsics.register()
    library = []
    with _cached_in(version_folder("compiled") / "library"):
        for function in functions.COMPILABLE + streams.COMPILABLE:
            library.append(numba.njit(**LIBRARY_OPTIONS)(function))
            keep_compiled(library[-1], function)
            intrinsics.offer(function, library[-1])
    return library


@contextmanager
def _cached_in(folder: Path) -> Iterator[None]:
    """Let numba cache in a folder what is declared meanwhile."""
    before = SETTINGS["CACHE_DIR"]
    SETTINGS["CACHE_DIR"] = str(folder)
    try:
        yield
    finally:
        SETTINGS["CACHE_DIR"] = before


LIBRARY = _library()


def jit(function: Function, **more: object) -> Function:
    """Return a function that is compiled when called, with strict floating point, without the GIL, cached on disk.

    numba's cache depends on the text of the function's own file; the folder's name on everything else that matters.
    """
    options: Any = {**OPTIONS, **more}
    with _cached_in(version_folder("compiled") / _stamp(function)):
        compiled = numba.njit(**options)(function)
        keep_compiled(compiled, function)
    return cast("Function", compiled)


def jit_kernel(function: Function) -> Function:
    """Return a function compiled as by `jit`, in less time; it must be plain loops that make and keep no arrays."""
    return jit(function, _nrt=False, pipeline_class=KernelCompiler)


def _stamp(function: Callable[..., Any]) -> str:
    """Return a digest of all that is compiled into a function: this package, files of callees, constants."""
    digest = sha256(kernel_digest().encode())
    for file, numbers in sorted(_compiled_in(function, {}).items()):
        digest.update(f"{_text_digest(file)}{numbers}".encode())
    return digest.hexdigest()[:16]


def _compiled_in(function: Callable[..., Any], numbers_by_file: dict[str, str]) -> dict[str, str]:
    """Return, by file, the numbers among the globals of the modules of a function and of its callees."""
    names = function.__globals__
    numbers = {name: value for name, value in names.items() if isinstance(value, int | float)}
    numbers_by_file[function.__code__.co_filename] = repr(sorted(numbers.items()))
    for value in list(names.values()):
        if isinstance(value, Dispatcher) and value.py_func.__code__.co_filename not in numbers_by_file:
            _compiled_in(value.py_func, numbers_by_file)
    return numbers_by_file


@cache
def _text_digest(file: str) -> str:
    return sha256(Path(file).read_bytes()).hexdigest()
