"""Where an environment is from: what must be the same for its episodes to be the same."""

from __future__ import annotations

import inspect
import sys
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, packages_distributions, version
from pathlib import Path
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
    """Return the versions of the distributions that modules are from, and a digest of the environment's own file."""
    tops = dict.fromkeys(module.partition(".")[0] for module in modules)
    versions = {top: found for top in tops if (found := distribution_version(top)) is not None}
    return {**versions, "source": source_digest(environment)}


def distribution_version(top: str) -> str | None:
    """Return the version of the distribution that a module is from, else what the module says; None for neither."""
    try:
        return version(top)
    except PackageNotFoundError:
        pass
    names = packages_distributions().get(top, [])
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
