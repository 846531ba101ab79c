"""C compiled by gcc into a temporary folder."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from benchmarks.lifting import BEHAVIORS, Lived

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from benchmarks.lifting import Floats, Workload
    from benchmarks.mobile import Wandering

OPTIONS = ("-O3", "-march=native", "-ffp-contract=off", "-shared", "-fPIC")


def prepare_scalar(workload: Workload) -> Callable[[], Lived]:
    """One episode at a time with libm's hypot and arctangent."""
    return _prepare("scalar.c", workload)


def prepare_tuned(workload: Workload) -> Callable[[], Lived]:
    """The same with a plain square root and a table of roots."""
    return _prepare("scalar.c", workload, "-DTUNED")


def prepare_simd(workload: Workload) -> Callable[[], Lived]:
    """Explicit vectors with bbsd's arctangent."""
    return _prepare("simd.c", workload)


def prepare_mobile(wandering: Wandering) -> Callable[[], Floats]:
    """The mobile robot, one episode at a time, with libm."""
    return _prepare_mobile(wandering)


def prepare_mobile_own(wandering: Wandering) -> Callable[[], Floats]:
    """The same with bbsd's sine, cosine, arctangent and logarithm."""
    return _prepare_mobile(wandering, "-DOWN")


def _prepare_mobile(wandering: Wandering, *options: str) -> Callable[[], Floats]:
    wander = _compiled(Path(__file__).with_name("mobile_robot.c"), options).wander
    count = len(wandering.keys)
    returns, credit = np.empty(count), np.empty((count, wandering.structures.shape[1] + 1))
    arrays = [np.ascontiguousarray(each) for each in wandering] + [returns, credit]
    arguments = [ctypes.c_int64(count), *(ctypes.c_void_p(array.ctypes.data) for array in arrays)]

    def live() -> Floats:
        wander(*arguments)
        return arrays[-2].copy()

    return live


def _prepare(source: str, workload: Workload, *options: str) -> Callable[[], Lived]:
    lift = _compiled(Path(__file__).with_name(source), options).lift
    returns, credit = np.empty(len(workload)), np.empty((len(workload), BEHAVIORS + 1))
    arrays = (workload.heights, workload.tables, workload.structures, returns, credit)
    arguments = [ctypes.c_int64(len(workload)), *(ctypes.c_void_p(array.ctypes.data) for array in arrays)]

    def live() -> Lived:
        lift(*arguments)
        return Lived(returns, credit)

    return live


def _compiled(source: Path, options: Sequence[str]) -> ctypes.CDLL:
    """Raises OSError where there is no gcc or the machine lacks what the source needs."""
    compiler = shutil.which("gcc")
    if compiler is None:
        raise OSError("no gcc")
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "lift.so"
        done = subprocess.run(
            [compiler, *OPTIONS, *options, str(source), "-o", str(library), "-lm"],
            check=False,
            capture_output=True,
            text=True,
        )
        if done.returncode:
            raise OSError(f"gcc: {done.stderr.strip().splitlines()[-1]}")
        return ctypes.CDLL(str(library))
