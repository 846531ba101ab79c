"""The user's cache of kernels: where it is, whether it is safe to use, and what compiled code depends on.

Nothing here imports numba.
"""

from __future__ import annotations

import atexit
import os
import shutil
import sys
from functools import cache
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from tempfile import NamedTemporaryFile, mkdtemp

CACHE_VARIABLE = "BBSD_CACHE_DIR"


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
