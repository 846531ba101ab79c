"""What the tool finds of itself on a machine: versions, cores, caches, and whether it computes as it should."""

from __future__ import annotations

import os
import platform
import sys
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING

from bbsd.kernel.cache import CACHE_VARIABLE, cache_root, usable
from bbsd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

PACKAGES = ("numba", "llvmlite", "numpy", "pydantic", "PyYAML", "yamlcore", "typer", "rich")
OLDEST_PYTHON = (3, 11)

KNOWN_SPEC = """\
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
KNOWN_RETURN = "0x1.a5c721413da6ep+1"
"""What the spec's first episode earns by the streams of key 0, on every machine."""


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that was looked at; `problem` says what is wrong with it and what to do, '' if nothing is."""

    name: str
    value: str
    problem: str = ""


def findings() -> Iterator[Finding]:
    """Yield all there is to say, fast: nothing is compiled."""
    yield Finding("bbsd", __version__)
    yield _python()
    for package in PACKAGES:
        yield _package(package)
    yield _figures()
    yield Finding("system", f"{platform.system()} on {platform.machine()}")
    yield Finding("cores", _cores())
    yield _compiler()
    yield _cache(cache_root())
    yield _self_check()


def _python() -> Finding:
    is_old = sys.version_info < OLDEST_PYTHON
    return Finding("Python", platform.python_version(), "Python 3.11 or newer is needed" if is_old else "")


def _package(name: str) -> Finding:
    try:
        return Finding(name, version(name))
    except PackageNotFoundError:
        return Finding(name, "missing", f"install it: python -m pip install {name}")


def _figures() -> Finding:
    """Without matplotlib all works but figures."""
    try:
        return Finding("matplotlib", version("matplotlib"))
    except PackageNotFoundError:
        return Finding("matplotlib", "missing, so there are no figures: python -m pip install 'bbsd[plot]'")


def _cores() -> str:
    allowed = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return f"{allowed} of {os.cpu_count()} may be used; a design uses as many as --jobs says, one by default"


def _compiler() -> Finding:
    given = {name: value for name, value in sorted(os.environ.items()) if name.startswith("NUMBA_")}
    value = ", ".join(f"{name}={value}" for name, value in given.items()) or "numba as it comes"
    if given.get("NUMBA_DISABLE_JIT", "0") not in ("0", ""):
        return Finding(
            "compiler", value, "nothing is compiled, and designs take hours: unset NUMBA_DISABLE_JIT"
        )
    return Finding("compiler", value)


def _cache(root: Path) -> Finding:
    if not (usable(root) and usable(root / "kernels") and usable(root / "compiled")):
        advice = (
            f"set {CACHE_VARIABLE} to a folder that only you can write; without it each command compiles anew"
        )
        return Finding("cache", str(root), f"it cannot be used: {advice}")
    files = [path for path in root.rglob("*") if path.is_file()]
    size = sum(path.stat().st_size for path in files) / 1e6
    return Finding("cache", f"{root}, writable, {len(files):,} files, {size:.1f} MB")


def _self_check() -> Finding:
    """Live one episode as plain Python, and compare with what it earns everywhere."""
    try:
        found = known_return()
    except Exception as error:  # noqa: BLE001 - whatever is wrong with an installation is to be told
        return Finding("self-check", "failed", f"{type(error).__name__}: {error}")
    if found != KNOWN_RETURN:
        return Finding(
            "self-check", found, f"an episode should earn {KNOWN_RETURN}: designs differ from others'"
        )
    return Finding("self-check", "an episode earns what it should, to the last bit")


def known_return() -> str:
    """Return what an episode of the known spec earns, all its digits."""
    import numpy as np

    from bbsd.architecture import given_architecture
    from bbsd.compiler import compile_meaning
    from bbsd.evaluation import agents_of, returns_of
    from bbsd.language.loading import load
    from bbsd.text import Source

    problem = compile_meaning(load(Source("known", KNOWN_SPEC)).meaning, compiled=False)
    agents = agents_of([given_architecture(problem)])
    return float(returns_of(problem, agents, np.zeros(1, np.uint64), 1)[0, 0]).hex()
