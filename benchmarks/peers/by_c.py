"""C compiled by gcc into a temporary folder."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from benchmarks.workloads.lifting import BEHAVIORS, Earnings

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy.typing as npt

    from benchmarks.workloads import lifting, mobile_robot
    from benchmarks.workloads.arrays import Floats

OPTIONS = ("-O3", "-march=native", "-ffp-contract=off", "-shared", "-fPIC")


def prepare_scalar(workload: lifting.Workload) -> Callable[[], Earnings]:
    """Prepare lifting, one episode at a time, with libm's hypot and arctangent."""
    return _prepare("scalar.c", workload)


def prepare_tuned(workload: lifting.Workload) -> Callable[[], Earnings]:
    """Prepare the same with a plain square root and a table of roots."""
    return _prepare("scalar.c", workload, "-DTUNED")


def prepare_simd(workload: lifting.Workload) -> Callable[[], Earnings]:
    """Prepare lifting with explicit vectors and bbsd's arctangent."""
    return _prepare("simd.c", workload)


def prepare_mobile(workload: mobile_robot.Workload) -> Callable[[], Floats]:
    """Prepare the mobile robot, one episode at a time, with libm."""
    return _prepare_mobile(workload)


def prepare_mobile_same_functions(workload: mobile_robot.Workload) -> Callable[[], Floats]:
    """Prepare the same with bbsd's sine, cosine, arctangent and logarithm."""
    return _prepare_mobile(workload, "-DBBSD_FUNCTIONS")


def _prepare(source: str, workload: lifting.Workload, *options: str) -> Callable[[], Earnings]:
    earnings = Earnings(np.empty(len(workload)), np.empty((len(workload), BEHAVIORS + 1)))
    arrays = (workload.heights, workload.tables, workload.structures, *earnings)
    lift = partial(_compiled(source, options).lift, *_arguments(len(workload), arrays))

    def run() -> Earnings:
        lift()
        return earnings

    return run


def _prepare_mobile(workload: mobile_robot.Workload, *options: str) -> Callable[[], Floats]:
    count, n_layers = workload.structures.shape
    returns, credit = np.empty(count), np.empty((count, n_layers + 1))
    wander = partial(
        _compiled("mobile_robot.c", options).wander, *_arguments(count, (*workload, returns, credit))
    )

    def run() -> Floats:
        wander()
        return returns.copy()

    return run


def _arguments(count: int, arrays: Sequence[npt.NDArray[Any]]) -> list[Any]:
    """Return a count and pointers to contiguous arrays, as a function in C takes them; they keep the arrays alive."""
    contiguous = map(np.ascontiguousarray, arrays)
    return [ctypes.c_int64(count), *(array.ctypes.data_as(ctypes.c_void_p) for array in contiguous)]


def _compiled(source: str, options: Sequence[str]) -> ctypes.CDLL:
    """Compile a source beside this file; raise OSError where there is no gcc or the machine lacks what it needs."""
    compiler = shutil.which("gcc")
    if compiler is None:
        raise OSError("no gcc")
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "lift.so"
        path = Path(__file__).with_name(source)
        done = subprocess.run(
            [compiler, *OPTIONS, *options, str(path), "-o", str(library), "-lm"],
            check=False,
            capture_output=True,
            text=True,
        )
        if done.returncode:
            raise OSError(f"gcc: {done.stderr.strip().splitlines()[-1]}")
        return ctypes.CDLL(str(library))
