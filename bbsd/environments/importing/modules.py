"""Importing the modules that a user allowed: from the installed environment, or from folders that were named.

Python looks for modules in the current folder too, where a stranger's spec may lie beside a stranger's `gymnasium.py`.
So while a module is imported, and an environment is made of it, neither the current folder nor that of the spec nor
one that only PYTHONPATH names is searched, unless `--import-from` names it.
"""

from __future__ import annotations

import os
import sys
import warnings
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.environments.failures import EnvironmentFailed, failure_text
from bbsd.environments.importing.consent import INSTALLED_BY
from bbsd.errors import UsageError, escape

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from types import ModuleType

    from bbsd.environments.importing.consent import Consent

    Announce = Callable[[str, str], None]
    """Called with the name of a module and its file before it is imported."""


class NoSuchModule(UsageError):
    """A module that is not installed, or not where it is looked for."""


@contextmanager
def searching(consent: Consent, closed: Sequence[str]) -> Iterator[None]:
    """Let modules be found in the installed environment and in the folders of a consent alone, inside.

    Afterwards the folders of the consent stay in Python's path, at its end: what comes from there may import more.

    Args:
        consent: its folders are searched last, so that none of their files stands for an installed module.
        closed: folders that are not searched unless the consent names them, such as that of the spec.
    """
    before = list(sys.path)
    sys.path[:] = [*installed(before, closed), *consent.folders]
    try:
        yield
    finally:
        sys.path[:] = [*before, *(folder for folder in consent.folders if folder not in before)]


def installed(path: Sequence[str], closed: Sequence[str] = ()) -> list[str]:
    """Return the entries of a search path that belong to the installed environment.

    None are the current folder, the closed ones, and those of PYTHONPATH.
    """
    refused = {_real(folder) for folder in ("", *closed, *_python_path())}
    return [entry for entry in path if entry and _real(entry) not in refused]


def imported(module: str, consent: Consent, whose: str, announce: Announce | None = None) -> ModuleType:
    """Import a module that a consent covers, with the packages above it, and return it.

    To be called inside `searching`. The file of the top module is announced before anything of it runs.

    Raises:
        ImportNotAllowed: the consent does not cover it.
        NoSuchModule: there is none.
        EnvironmentFailed: it raised an error.
    """
    consent.require(module, whose)
    top = module.partition(".")[0]
    if top not in sys.modules:
        found = find_spec(top)
        if found is None:
            raise _missing(top, whose)
        if announce is not None:
            announce(top, found.origin or ", ".join(found.submodule_search_locations or ()) or "built in")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # as an error, Box2D's ends the process
            return import_module(module)
    except ModuleNotFoundError as error:
        if error.name is not None and (module == error.name or module.startswith(f"{error.name}.")):
            raise _missing(error.name, whose) from None
        raise _needs_more(module, error) from None
    except ImportError as error:
        raise _cannot(module, error) from None
    except (Exception, SystemExit) as error:  # noqa: BLE001 - all that somebody else's code may raise
        if type(error).__name__ == "DependencyNotInstalled":  # Gymnasium's, which is no ImportError
            raise _cannot(module, error) from None
        raise EnvironmentFailed(failure_text(f"the import of {module}", error)) from None


def _missing(name: str, whose: str) -> NoSuchModule:
    top = name.partition(".")[0]
    error = NoSuchModule(f"{whose} needs the module {name}, which is not installed")
    error.advice = INSTALLED_BY.get(name, f"install the package that has it (often: pip install {top})")
    nearby = _nearby(top)
    if nearby is not None:
        error = NoSuchModule(
            f"{whose} needs the module {name}; {nearby} is there, but nothing is imported from that folder by itself"
        )
        error.advice = f"if you trust it: --import-from {nearby.parent}"
    return error


def _nearby(top: str) -> Path | None:
    """Return the file or folder of a module in a folder that is not searched: the current one, or PYTHONPATH's."""
    for folder in ("", *_python_path()):
        for path in (Path(_real(folder)) / f"{top}.py", Path(_real(folder)) / top):
            if path.exists():
                return path
    return None


def _needs_more(module: str, error: ModuleNotFoundError) -> NoSuchModule:
    needed = (error.name or "").partition(".")[0]
    missing = NoSuchModule(f"{module} imports {error.name}, which is not installed")
    missing.advice = INSTALLED_BY.get(needed, f"install what {module} needs (often: pip install {needed})")
    return missing


def _cannot(module: str, error: BaseException) -> NoSuchModule:
    said = escape(" ".join(str(error).split()))
    missing = NoSuchModule(f"{module} cannot be imported: {said}")
    missing.advice = "install what is missing, in the Python that runs bbsd"
    return missing


def _python_path() -> list[str]:
    return [entry for entry in os.environ.get("PYTHONPATH", "").split(os.pathsep) if entry]


def _real(folder: str) -> str:
    return os.path.realpath(folder or os.curdir)
