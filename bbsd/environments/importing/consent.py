"""Consent to import: which modules a user named on the command line, in a call, or in the own configuration file.

Importing a module runs its code. A spec is data, often somebody else's, so it can name an environment but never allow
its import; nor can a file beside it, an argument under `with`, a folder of a run, or an environment variable.
"""

from __future__ import annotations

import errno
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Iterable

MODULE = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*", re.ASCII)
INSTALLED_BY = {"gymnasium": 'pip install "bbsd[gymnasium]"', "pettingzoo": 'pip install "bbsd[pettingzoo]"'}
"""How packages are installed that bbsd has an extra for."""


class NotAModule(UsageError):
    """Consent to something that is not the name of a module."""

    advice = "give one name each time, such as --allow-import gymnasium --allow-import minigrid"


class ImportNotAllowed(UsageError):
    """A module that a spec's environment needs, and that nobody allowed to import."""


@dataclass(frozen=True, slots=True)
class Consent:
    """What may be imported: modules with all that is below them, also from some folders."""

    modules: tuple[str, ...] = ()
    folders: tuple[str, ...] = ()
    """Absolute paths of folders in which modules are looked for, after the installed environment."""

    def covers(self, module: str) -> bool:
        """Say whether a module may be imported: it is named, or one above it is."""
        return any(module == name or module.startswith(f"{name}.") for name in self.modules)

    def require(self, module: str, whose: str) -> None:
        """Raise ImportNotAllowed for a module that may not be imported; `whose` environment needs it."""
        if self.covers(module):
            return
        top = module.partition(".")[0]
        error = ImportNotAllowed(
            f"{whose} needs the module {module}, and importing a module runs its code; it was not imported"
        )
        error.advice = f"if you trust it: --allow-import {top} (in Python, allow_import=[{top!r}])"
        raise error


def consent(modules: Iterable[str], folders: Iterable[str | Path] = ()) -> Consent:
    """Return consent to these modules, from these folders.

    Raises:
        NotAModule: a text that cannot be a module's name.
        NotADirectoryError: a folder that is none.
    """
    names = tuple(dict.fromkeys(modules))
    for name in names:
        if not isinstance(name, str) or not MODULE.fullmatch(name):
            raise NotAModule(f"{name!r} is not the name of a module")
    return Consent(names, tuple(_folder(folder) for folder in folders))


def _folder(folder: str | Path) -> str:
    path = Path(folder).resolve()
    if not path.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), str(folder))
    return str(path)
