"""The user's cache of kernels: where it is, whether it is safe to use, and what compiled code depends on.

Nothing here imports numba.
"""

from __future__ import annotations

import atexit
import os
import shutil
import sys
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from tempfile import NamedTemporaryFile, mkdtemp

CACHE_VARIABLE = "BBSD_CACHE_DIR"
MOST_BYTES = 500_000_000
"""What the cache holds at most, some hundred specs; what was not used for the longest time is removed first."""
DIGEST_SIZE = sha256().digest_size
FOLDERS = ("compiled", "kernels")
"""What the cache holds: compiled code, and the texts of kernels; in each a folder for each `kernel_digest`."""


def with_digest(content: bytes) -> bytes:
    """Return a content as a file of compiled code holds it, from which it can be told whether it is whole."""
    return content + sha256(content).digest()


def is_whole(content: bytes) -> bool:
    """Say whether what a file of compiled code holds is what was written."""
    return sha256(content[:-DIGEST_SIZE]).digest() == content[-DIGEST_SIZE:]


@cache
def kernel_digest() -> str:
    """Return a digest, 16 digits, of what all compiled code depends on: the text of this package, numba's version."""
    texts = [path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py"))]
    return sha256(b"\0".join([version("numba").encode(), *texts])).hexdigest()[:16]


def cache_folder(name: str) -> Path:
    """Return a folder of the user's cache by its name, made where it is missing, for the user only (mode 0700).

    Where the cache cannot be written, or others could write it, one notice on standard error says so, and a temporary
    folder takes its place, which lasts as long as this process and serves its children too.
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


def version_folder(name: str) -> Path:
    """Return the folder of what this version keeps in a folder of the cache, made where it is missing."""
    folder = cache_folder(name) / kernel_digest()
    folder.mkdir(mode=0o700, exist_ok=True)
    return folder


def is_of_this_version(path: Path, root: Path) -> bool:
    """Say whether a file of the cache is one that this version of bbsd and numba can use."""
    return path.relative_to(root).parts[1:2] == (kernel_digest(),)


def cache_root() -> Path:
    """Return the root of the user's cache: $BBSD_CACHE_DIR, or bbsd in $XDG_CACHE_HOME or ~/.cache."""
    if given := os.environ.get(CACHE_VARIABLE):
        return Path(given).absolute()
    home = os.environ.get("XDG_CACHE_HOME", "")
    return (Path(home) if Path(home).is_absolute() else Path.home() / ".cache") / "bbsd"


@cache
def usable(folder: Path) -> bool:
    """Say whether only the user can write to a folder, made if need be: what lies in a cache is executed."""
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        folder.mkdir(mode=0o700, exist_ok=True)
        NamedTemporaryFile(dir=folder).close()
        status = folder.stat()
    except OSError:
        return False
    return os.name == "nt" or (status.st_uid == os.geteuid() and not status.st_mode & 0o022)


def trim(root: Path, most: int = MOST_BYTES) -> None:
    """Remove what was not used for the longest time, until the cache holds no more than so many bytes.

    Compiled code is looked at by the kernel that it is of, and goes with the text of that kernel.
    """
    compiled = [_Compiled.read(folder) for folder in (root / "compiled").glob("*/*") if folder.is_dir()]
    kernels = {path: path.stat().st_size for path in (root / "kernels").rglob("*.py")}
    size = sum(each.size for each in compiled) + sum(kernels.values())
    for each in sorted(compiled, key=lambda each: each.used):
        if size <= most:
            return
        shutil.rmtree(each.folder, ignore_errors=True)
        with suppress(OSError):  # where other folders are in it
            each.folder.parent.rmdir()
        size -= each.size
        for path in [path for path in kernels if path.stem in each.kernels]:
            path.unlink(missing_ok=True)
            size -= kernels.pop(path)


@dataclass(frozen=True, slots=True)
class _Compiled:
    """A folder of compiled code, its size in bytes, when it was last used, and the kernels that it is of."""

    folder: Path
    size: int
    used: float
    kernels: frozenset[str]

    @classmethod
    def read(cls, folder: Path) -> _Compiled:
        files = {path: path.stat() for path in folder.rglob("*") if path.is_file()}
        return cls(
            folder,
            sum(status.st_size for status in files.values()),
            max((status.st_mtime for status in files.values()), default=0.0),
            frozenset(path.name.partition(".")[0] for path in files),
        )


def clean(root: Path) -> int:
    """Remove all that is in the cache, and return how many bytes that were."""
    folders = [root / name for name in FOLDERS]
    size = sum(path.stat().st_size for folder in folders for path in folder.rglob("*") if path.is_file())
    for folder in folders:
        shutil.rmtree(folder, ignore_errors=True)
    return size
