"""An examination of the installation: versions, cores, caches, and a test result."""

from __future__ import annotations

import os
import platform
import sys
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING

from bbsd.kernel.cache import CACHE_VARIABLE, FOLDERS, cache_root, is_of_this_version, is_whole, usable
from bbsd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

PACKAGES = ("numba", "llvmlite", "numpy", "pydantic", "PyYAML", "yamlcore", "typer", "rich")
OLDEST_PYTHON = (3, 11)
COMPILED = (".nbi", ".nbc")
"""The endings of files with compiled code."""

SELF_CHECK_SPEC = """\
bbsd: 1
name: known
environment:
  steps: 3
  state:
    x: uniform(0, 1)
  dynamics:
    x: exp(sin(x)) / 2
behaviors:
  wait: {actions: {stay: {x: x}}, rules: [otherwise: stay]}
structure: [wait]
reward: {height: x}
"""
SELF_CHECK_RETURN = "0x1.a5c721413da6ep+1"
"""The return of the test spec's episode with key 0, on every machine."""


@dataclass(frozen=True, slots=True)
class Finding:
    """A value that was examined; `problem` says what is wrong with it and what to do, or is ''."""

    name: str
    value: str
    problem: str = ""


def examine() -> Iterator[Finding]:
    """Yield all findings; the last one compiles, which takes some seconds where the cache is empty."""
    yield Finding("bbsd", __version__)
    yield _python()
    for package in PACKAGES:
        yield _package(package)
    yield _figures()
    yield Finding("system", f"{platform.system()} on {platform.machine()}")
    yield Finding("cores", _cores())
    yield _compiler()
    yield _cache(cache_root())
    yield _self_check("self-check", compiled=False)
    yield _self_check("compiled", compiled=True)


def _python() -> Finding:
    is_old = sys.version_info < OLDEST_PYTHON
    return Finding("Python", platform.python_version(), "Python 3.11 or newer is needed" if is_old else "")


def _package(name: str) -> Finding:
    try:
        return Finding(name, version(name))
    except PackageNotFoundError:
        return Finding(name, "missing", f"install it: python -m pip install {name}")


def _figures() -> Finding:
    """Return the version of matplotlib, without which all works except figures."""
    try:
        return Finding("matplotlib", version("matplotlib"))
    except PackageNotFoundError:
        return Finding("matplotlib", "missing, so there are no figures: python -m pip install 'bbsd[plot]'")


def _cores() -> str:
    allowed = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return f"{allowed} of {os.cpu_count()} available; a design uses as many as --jobs says, one by default"


def _compiler() -> Finding:
    given = {name: value for name, value in sorted(os.environ.items()) if name.startswith("NUMBA_")}
    value = ", ".join(f"{name}={value}" for name, value in given.items()) or "numba with default settings"
    if given.get("NUMBA_DISABLE_JIT", "0") not in ("0", ""):
        return Finding(
            "compiler", value, "nothing is compiled, so designs take hours: unset NUMBA_DISABLE_JIT"
        )
    return Finding("compiler", value)


def _cache(root: Path) -> Finding:
    if not (usable(root) and usable(root / "kernels") and usable(root / "compiled")):
        advice = f"set {CACHE_VARIABLE} to a folder that only you can write; without it each command compiles again"
        return Finding("cache", str(root), f"it cannot be used: {advice}")
    files = [path for name in FOLDERS for path in (root / name).rglob("*") if path.is_file()]
    others = [path for path in files if not is_of_this_version(path, root)]
    damaged = [path for path in files if path not in {*others} and _is_damaged(path)]
    value = f"{root}, writable, {_size_text(files)}"
    if damaged:
        value += f"; {_size_text(damaged)} damaged: made anew when needed"
    if others:
        value += (
            f"; {_size_text(others)} of other versions of bbsd or numba, which this one does not use: "
            "bbsd doctor --clean empties the cache"
        )
    return Finding("cache", value)


def _size_text(files: Sequence[Path]) -> str:
    size = sum(path.stat().st_size for path in files) / 1e6
    return f"{len(files):,} {'file' if len(files) == 1 else 'files'}, {size:.1f} MB"


def _is_damaged(path: Path) -> bool:
    """Say whether a file is compiled code that is not what was written."""
    try:
        return path.suffix in COMPILED and not is_whole(path.read_bytes())
    except OSError:
        return True


def _self_check(name: str, *, compiled: bool) -> Finding:
    """Run one episode, compiled or as plain Python, and compare its return with the known one."""
    try:
        result = self_check_return(compiled=compiled)
    except Exception as error:  # noqa: BLE001 - any defect of an installation is shown
        advice = "; if it lasts: bbsd doctor --clean" if compiled else ""
        return Finding(name, "failed", f"{type(error).__name__}: {error}{advice}")
    if result != SELF_CHECK_RETURN:
        problem = (
            f"the test episode should return {SELF_CHECK_RETURN}: designs differ from those on other machines"
        )
        return Finding(name, result, problem)
    return Finding(name, "the test episode has the right return, to the last bit")


def self_check_return(*, compiled: bool = False) -> str:
    """Return the return of an episode of the test spec, with all its digits."""
    import numpy as np

    from bbsd.architecture import given_architecture
    from bbsd.compiler import compile_meaning
    from bbsd.evaluation import agents_of, returns_of
    from bbsd.language.loading import load
    from bbsd.text import Source

    problem = compile_meaning(load(Source("known", SELF_CHECK_SPEC)).meaning, compiled=compiled)
    agents = agents_of([given_architecture(problem)])
    return float(returns_of(problem, agents, np.zeros(1, np.uint64), 1)[0, 0]).hex()
