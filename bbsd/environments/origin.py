"""Where an environment is from: what must be the same for its episodes to be the same."""

from __future__ import annotations

import inspect
import sys
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, packages_distributions, version
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from bbsd.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


class NotPortable(UsageError):
    """A class that another process cannot import."""

    advice = "put it into a module of its own and import it from there, or use one job"


DIGITS = 16
"""Digits of a digest that are kept."""


def origin_of(environment: Any, modules: Sequence[str]) -> dict[str, str]:  # noqa: ANN401 - whatever environment
    """Return the versions of all distributions that an environment is made of, and a digest of its own file.

    These are what the modules are from, the classes that it inherits from, and what its file imports.
    """
    kinds = {type(environment), type(getattr(environment, "unwrapped", environment))}
    homes = [kind.__module__ for each in kinds for kind in each.__mro__]
    own = [name for each in kinds for name in _imported_by(sys.modules.get(each.__module__))]
    tops = sorted({name.partition(".")[0] for name in (*modules, *homes, *own)} - sys.stdlib_module_names)
    versions = {top: found for top in tops if (found := distribution_version(top)) is not None}
    return {**versions, "source": source_digest(environment)}


def _imported_by(module: ModuleType | None) -> list[str]:
    """Return the names of the modules that a module has imported as such."""
    values = vars(module).values() if module is not None else ()
    return [value.__name__ for value in values if isinstance(value, ModuleType)]


def distribution_version(top: str) -> str | None:
    """Return the version of the distribution that a module is from, else what the module says; None for neither."""
    try:
        return version(top)
    except PackageNotFoundError:
        pass
    names = sorted(packages_distributions().get(top, []))
    if names:
        return version(names[0])
    said = getattr(sys.modules.get(top), "__version__", None)
    return said if isinstance(said, str) else None


def source_digest(environment: Any) -> str:  # noqa: ANN401 - whatever environment
    """Return a digest of the text that the class of an environment, without wrappers, is written in."""
    kind = type(getattr(environment, "unwrapped", environment))
    try:
        content = Path(inspect.getfile(kind)).read_bytes()
    except (OSError, TypeError):
        try:
            content = inspect.getsource(kind).encode()
        except (OSError, TypeError):
            return "unknown"
    return sha256(content).hexdigest()[:DIGITS]


def importable(kind: Callable[..., Any]) -> tuple[str, str]:
    """Return a class as module:Class, and the folder in which its top module is found.

    Raises NotPortable for a class that is in no module's file, or inside of something else.
    """
    name, module = getattr(kind, "__qualname__", ""), getattr(kind, "__module__", "")
    home = sys.modules.get(module)
    file = getattr(home, "__file__", None)
    if file is None or module == "__main__" or getattr(home, name, None) is not kind:
        raise NotPortable(f"the class {name} of {module} cannot be imported by another process")
    return f"{module}:{name}", str(Path(file).resolve().parents[_depth(module, file)])


def _depth(module: str, file: str) -> int:
    """Return how many folders the file of a module lies below the one in which its top module is found."""
    return module.count(".") + (Path(file).stem == "__init__")
