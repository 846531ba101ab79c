"""Generated kernels as modules: written into the user's cache and imported, compiled or as plain Python.

Numba is imported only when something is compiled.
"""

from __future__ import annotations

import sys
from hashlib import sha256
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import TYPE_CHECKING

from bbsd.kernel.cache import cache_folder, kernel_digest

if TYPE_CHECKING:
    from types import ModuleType


def load_kernel(source: str, name: str, functions: tuple[str, ...], compiled: bool) -> ModuleType:
    """Return the module that a source defines, its named functions compiled, or all of it as plain Python.

    The functions to compile are plain loops over numbers and over arrays given to them, as `jit_kernel` requires. The
    names of the file and the module are `name`, an identifier, and a hash of all that determines the compiled code:
    the same source is the same file, and numba finds what it compiled before.
    """
    digest = sha256(f"{kernel_digest()} {functions} {source}".encode()).hexdigest()
    stem = f"{name}_{digest[:32]}"
    module_name = stem if compiled else f"{stem}_plain"
    if module_name in sys.modules:
        return sys.modules[module_name]
    path = cache_folder("kernels") / f"{stem}.py"
    _write(path, source)
    module = _import_file(path, module_name)
    if compiled:
        _compile(module, functions)
    return module


def _write(path: Path, text: str) -> None:
    """Write a file whole or not at all, and not if it is there already."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    with NamedTemporaryFile("w", encoding="utf-8", dir=path.parent, suffix=".part", delete=False) as part:
        part.write(text)
    Path(part.name).replace(path)


def _import_file(path: Path, module_name: str) -> ModuleType:
    """Import a file under a name, registered before the file is executed, since numba's cache looks it up."""
    spec = spec_from_file_location(module_name, path)
    if spec is None or spec.loader is None:
        raise ImportError(f"{path} is not a module", path=str(path))
    module = module_from_spec(spec)
    sys.modules[module_name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[module_name]
        raise
    return module


def _compile(module: ModuleType, functions: tuple[str, ...]) -> None:
    from bbsd.kernel.jit import jit_kernel

    for function in functions:
        setattr(module, function, jit_kernel(getattr(module, function)))
