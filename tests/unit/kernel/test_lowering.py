"""What KernelLower makes of variables, elements of arrays and calls."""

import re
from collections.abc import Callable
from inspect import signature
from pathlib import Path

import numba
import numpy as np
import pytest

from bbsd.kernel import functions
from bbsd.kernel.jit import LIBRARY_OPTIONS
from bbsd.kernel.lowering import KernelLower
from bbsd.kernel.modules import load_kernel

ODD = """
from bbsd.kernel.functions import atan, exp, hypot, modulo, select, whole_power
from bbsd.kernel.memory import as_integers, part

def odd(numbers, table, n):
    cells = as_integers(numbers)
    first = part(numbers, 0, 4)
    last = part(cells, 4, 4)
    total = 0.0
    for step in range(n):
        for lane in range(4):
            value = first[lane] + table[step % 2, lane]
            first[lane] = value * 0.5
        for lane in range(4):
            value = first[lane]
            last[-1 - lane] = select(value > 1.0, lane, step)
            table[1, lane] = atan(value) + exp(-value) + hypot(value, 2.0) + modulo(value, 0.3)
        if step > 2:
            total = total + value
        else:
            value = whole_power(total, 2)
            total = total - value
        if total > 20.0:
            break
    return total + value
"""


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BBSD_CACHE_DIR", str(tmp_path))


def outcome(n: int, *, compiled: bool) -> tuple[float, list[float], list[float]]:
    numbers, table = np.linspace(0.0, 9.0, 8), np.linspace(-1.0, 2.0, 8).reshape(2, 4)
    total = load_kernel(ODD, "odd", ("odd",), compiled).odd(numbers, table, n)
    return total, numbers.view(np.int64).tolist(), table.tolist()


@pytest.mark.parametrize("n", [1, 2, 4, 30])
def test_variables_that_change_on_some_ways_and_elements_from_the_end_are_as_in_python(n: int) -> None:
    assert outcome(n, compiled=True) == outcome(n, compiled=False)


def instructions_of(value: str, monkeypatch: pytest.MonkeyPatch) -> str:
    """Return what LLVM gets for ten loops over lanes that each store a value."""
    loop = f"    for lane in range(40):\n        array[lane] = {value}\n"
    source = (
        "from bbsd.kernel.functions import atan, hypot\nfrom bbsd.kernel.memory import part\n\n"
        f"def many(numbers):\n    array = part(numbers, 0, 80)\n{loop * 10}"
    )
    texts = list[str]()
    lower = KernelLower.lower

    def kept(self: KernelLower) -> None:
        lower(self)
        texts.append(str(self.module))

    monkeypatch.setattr(KernelLower, "lower", kept)
    load_kernel(source, "many", ("many",), True).many(np.ones(80))
    return texts[-1]


def test_no_array_has_a_place_on_the_stack_and_no_call_a_branch(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = instructions_of("hypot(atan(array[lane]), array[40 + lane])", monkeypatch)
    sums = instructions_of("array[lane] + array[40 + lane]", monkeypatch)
    assert calls.count(" call ") == sums.count(" call ") + 20
    assert calls.count(" br ") == sums.count(" br ")
    assert not re.search(r"alloca \{i8\*, i8\*, i64, i64", calls)


@pytest.mark.slow
@pytest.mark.parametrize("function", functions.COMPILABLE, ids=lambda function: function.__name__)
def test_no_function_of_the_library_raises(function: Callable[..., object]) -> None:
    parameters = signature(function).parameters.values()
    kinds = [numba.int64 if each.annotation == "int" else numba.float64 for each in parameters]
    compiled = numba.njit(**LIBRARY_OPTIONS)(function)
    compiled.compile(tuple(kinds))
    (form,) = compiled.overloads.values()
    name = re.escape(form.fndesc.llvm_func_name)
    body = re.search(
        rf'^define [^\n]*@"?{name}"?\(.*?^}}', form.library.get_llvm_str(), re.MULTILINE | re.DOTALL
    )
    assert body
    assert set(re.findall(r"^ *ret (.*)$", body[0], re.MULTILINE)) == {"i32 0"}
