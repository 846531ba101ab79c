"""Generated kernels as modules: written into the user's cache and imported, compiled or as plain Python.

Nothing here imports numba before something is to be compiled.
"""

from __future__ import annotations

import atexit
import os
import shutil
import sys
from functools import cache
from hashlib import sha256
from importlib.metadata import version
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from tempfile import NamedTemporaryFile, mkdtemp
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import ModuleType

CACHE_VARIABLE = "BBSD_CACHE_DIR"


@cache
def kernel_digest() -> str:
    """What compiled code depends on beside its source: this package's text and numba's version; 16 digits."""
    texts = [path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py"))]
    return sha256(b"\0".join([version("numba").encode(), *texts])).hexdigest()[:16]


def cache_folder(name: str) -> Path:
    """The folder of that name in the user's cache, made where it is missing, for the user only (mode 0700).

    The cache is $BBSD_CACHE_DIR, or bbsd in $XDG_CACHE_HOME or ~/.cache. Where it cannot be written, or
    others could write it, one notice says so on standard error and a temporary folder takes its place, which
    lasts as long as this process and serves its children too.
    """
    root = cache_root()
    if not usable(root) or not usable(root / name):
        sys.stderr.write(
            f"bbsd: cannot keep compiled code in {root}; set {CACHE_VARIABLE} to a folder of your own\n"
        )
        root = Path(mkdtemp(prefix="bbsd-"))
        atexit.register(shutil.rmtree, root, ignore_errors=True)
        os.environ[CACHE_VARIABLE] = str(root)
        (root / name).mkdir(mode=0o700)
    return root / name


def load_kernel(source: str, name: str, functions: tuple[str, ...], compiled: bool) -> ModuleType:
    """The module that the source defines, its named functions compiled, or all of it as plain Python.

    Compiled functions are plain loops over numbers and arrays that they are given, as `jit_kernel` wants. The file
    and the module are called by `name`, an identifier, and a hash of all that decides what the compiled code does:
    the same source is the same file, and numba finds what it compiled before.
    """
    digest = sha256(f"{kernel_digest()} {functions} {source}".encode()).hexdigest()
    title = f"{name}_{digest[:32]}"
    module_name = title if compiled else f"{title}_plain"
    if module_name in sys.modules:
        return sys.modules[module_name]
    path = cache_folder("kernels") / f"{title}.py"
    _write(path, source)
    module = _import_file(path, module_name)
    if compiled:
        _compile(module, functions)
    return module


def cache_root() -> Path:
    """The user's cache: $BBSD_CACHE_DIR, or bbsd in $XDG_CACHE_HOME or ~/.cache."""
    if given := os.environ.get(CACHE_VARIABLE):
        return Path(given).absolute()
    home = os.environ.get("XDG_CACHE_HOME", "")
    return (Path(home) if Path(home).is_absolute() else Path.home() / ".cache") / "bbsd"


@cache
def usable(folder: Path) -> bool:
    """Whether the folder, made if need be, is the user's alone to write: what lies in a cache is executed."""
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        folder.mkdir(mode=0o700, exist_ok=True)
        NamedTemporaryFile(dir=folder).close()
        status = folder.stat()
    except OSError:
        return False
    return os.name == "nt" or (status.st_uid == os.geteuid() and not status.st_mode & 0o022)


def _write(path: Path, text: str) -> None:
    """Writes the file whole or not at all, and not when it is there already."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    with NamedTemporaryFile("w", encoding="utf-8", dir=path.parent, suffix=".part", delete=False) as part:
        part.write(text)
    Path(part.name).replace(path)


def _import_file(path: Path, module_name: str) -> ModuleType:
    """Imports a file under that name, which it has before it is executed: numba's cache looks it up."""
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
