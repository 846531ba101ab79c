"""Generated kernels as modules: written into the user's cache and imported, compiled or as plain Python.

Numba is imported only when something is compiled.
"""

from __future__ import annotations

import sys
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from tempfile import NamedTemporaryFile
from types import ModuleType

from bbsd.kernel.cache import cache_root, kernel_digest, version_folder


def load_kernel(source: str, name: str, functions: tuple[str, ...], compiled: bool) -> ModuleType:
    """Return the module that a source defines, its named functions compiled, or all of it as plain Python.

    The functions to compile are plain loops over numbers and over arrays given to them, as `jit_kernel` requires. The
    names of the file and the module are `name`, an identifier, and a hash of all that determines the compiled code:
    the same source is the same file, and numba finds what it compiled before.
    """
    stem = _stem(source, name, functions)
    module_name = stem if compiled else f"{stem}_plain"
    if module_name in sys.modules:
        return sys.modules[module_name]
    path = version_folder("kernels") / f"{stem}.py"
    _write(path, source)
    module = _executed(source, path, module_name)
    if compiled:
        _compile(module, functions)
    return module


def not_compiled(source: str, name: str, functions: tuple[str, ...]) -> list[str]:
    """Return those functions of a source that are neither in memory nor in the cache: they will be compiled."""
    stem = _stem(source, name, functions)
    loaded, folder = sys.modules.get(stem), cache_root() / "compiled" / kernel_digest()
    return [
        each
        for each in functions
        if not getattr(getattr(loaded, each, None), "signatures", None)
        and next(folder.glob(f"*/*/{stem}.{each}-*.nbi"), None) is None
    ]


def _stem(source: str, name: str, functions: tuple[str, ...]) -> str:
    digest = sha256(f"{kernel_digest()} {functions} {source}".encode()).hexdigest()
    return f"{name}_{digest[:32]}"


def _write(path: Path, text: str) -> None:
    """Write a file whole or not at all, and not if it is there already."""
    with suppress(FileNotFoundError):
        if path.read_bytes() == text.encode():
            return
    with NamedTemporaryFile("wb", dir=path.parent, suffix=".part", delete=False) as part:
        part.write(text.encode())
    Path(part.name).replace(path)


def _executed(source: str, path: Path, module_name: str) -> ModuleType:
    """Return a source as a module that says it is of a file.

    It is registered before it is executed, since numba's cache looks it up. Python's own cache of modules is left out:
    it takes what is damaged for good.
    """
    module = ModuleType(module_name)
    module.__file__ = str(path)
    sys.modules[module_name] = module
    try:
        exec(compile(source, path, "exec"), vars(module))  # noqa: S102 - written by bbsd, from a spec
    except BaseException:
        del sys.modules[module_name]
        raise
    return module


def _compile(module: ModuleType, functions: tuple[str, ...]) -> None:
    from bbsd.kernel.jit import jit_kernel

    for function in functions:
        setattr(module, function, jit_kernel(getattr(module, function)))
