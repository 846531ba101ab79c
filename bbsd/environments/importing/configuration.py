"""The user's own configuration file, in which modules can be allowed once and for all.

It is looked for where the system says that the user's home is, never where an environment variable says so: whoever
can set a variable must not be able to allow an import.
"""

from __future__ import annotations

import os
import stat
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.environments.importing.consent import MODULE
from bbsd.errors import Diagnosis, SpecError, did_you_mean
from bbsd.language.field_types import kind_of
from bbsd.text import Source, read

if TYPE_CHECKING:
    from bbsd.text import Document

KEY = "allow_import"
NAME = "config.yaml"
OTHERS_WRITE = stat.S_IWGRP | stat.S_IWOTH


def configuration_file() -> Path | None:
    """Return where the user's configuration file is, whether or not it is there; None where the user has no home."""
    folder = _platform_folder()
    return None if folder is None else folder / "bbsd" / NAME


def allowed_by_configuration(path: Path | None) -> tuple[str, ...]:
    """Return the modules that a configuration file allows to import; none where there is no file.

    Raises SpecError where it is not understood, or others than the user and the system may write it.
    """
    if path is None or not path.exists():
        return ()
    source = Source.read(path)
    if _others_may_write(path):
        advice = f"take the right from them: chmod go-w {path} {path.parent}"
        raise _refused(
            source, "others than its owner may write this file, so it cannot allow anything", advice
        )
    document = read(source)
    if document.root is None or document.diagnoses:
        raise SpecError(document.diagnoses, source)
    return _modules(document)


def _modules(document: Document) -> tuple[str, ...]:
    mistakes = []
    for key in document.data:
        if key != KEY:
            message = f"there is no setting {key!r}{did_you_mean(key, [KEY])}"
            mistakes.append(
                Diagnosis("BB123", message, document.place((key,), on_key=True), f"only {KEY} is known")
            )
    names = document.data.get(KEY)
    advice = f"write {KEY}: [gymnasium, mpe2]"
    if not isinstance(names, list | None):
        message = f"{KEY} is a list of modules, not {kind_of(names)}"
        mistakes.append(Diagnosis("BB123", message, document.place((KEY,)), advice))
        names = []
    for index, name in enumerate(names or []):
        if not isinstance(name, str) or not MODULE.fullmatch(name):
            shown = repr(name) if isinstance(name, str) else kind_of(name)
            place = document.place((KEY, index))
            mistakes.append(Diagnosis("BB123", f"{shown} is not the name of a module", place, advice))
    if mistakes:
        raise SpecError(mistakes, document.source)
    return tuple(map(str, names or []))


def _refused(source: Source, message: str, advice: str) -> SpecError:
    return SpecError([Diagnosis("BB123", message, source.place(0), advice)], source)


def _others_may_write(path: Path) -> bool:
    """Say whether the file or its folder belongs to somebody else, or may be written by others."""
    if os.name != "posix":
        return False
    trusted = (os.getuid(), 0)
    for each in (path, path.parent):
        found = each.stat()
        if found.st_uid not in trusted or found.st_mode & OTHERS_WRITE:
            return True
    return False


def _platform_folder() -> Path | None:
    """Return the folder in which the system keeps the configuration of this user's programs."""
    if sys.platform == "win32":
        return _windows_folder()
    import pwd

    try:
        home = Path(pwd.getpwuid(os.getuid()).pw_dir)
    except KeyError:
        return None
    return home / ("Library/Application Support" if sys.platform == "darwin" else ".config")


def _windows_folder() -> Path | None:
    import ctypes

    roaming, length = 0x1A, 260  # CSIDL_APPDATA, MAX_PATH
    buffer = ctypes.create_unicode_buffer(length)
    windll = getattr(ctypes, "windll", None)
    if windll is None or windll.shell32.SHGetFolderPathW(None, roaming, None, 0, buffer):
        return None
    return Path(buffer.value)
