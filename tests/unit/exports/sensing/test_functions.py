import math
import random
import re
from pathlib import Path

import numba
import numpy as np
import pytest

from bbsd.exports.sensing import functions
from bbsd.exports.sensing.functions import IN_MATH_H, function_of, functions_text
from bbsd.exports.sensing.text import INFIX
from bbsd.exports.verification.compilers import STRICT
from bbsd.exports.verification.tools import folder_of, run_in
from bbsd.expression.operations import OPERATIONS
from bbsd.kernel import functions as kernel
from bbsd.kernel import jit
from tests.unit.exports.designs import tool
from tests.unit.kernel.test_functions import SPECIAL

ONE = ("acos", "asin", "atan", "ceil", "cos", "degrees", "exp", "floor", "log", "log10", "log2", "radians")
ONE += ("round_half_even", "sign", "sin", "sqrt", "tan", "tanh", "abs", "wrap")
TWO = ("atan2", "floor_divide", "hypot", "maximum", "minimum", "modulo", "power")
WHOLE = ("clamp_index", "whole_power")
ALL = (*ONE, *TWO, *WHOLE)
NEAR = [
    math.pi,
    math.pi / 2,
    -math.pi / 4,
    math.sqrt(0.5),
    math.nextafter(1, 0),
    1023.0,
    1024.0,
    -1023.0,
    710.1,
]
NUMBERS = (*SPECIAL, *NEAR)

DRIVER = """
#include <math.h>
#include <stdint.h>
#include <string.h>
#include <stdio.h>
{functions}
int main(void)
{{
    double row[3], out[{n}];
    FILE *rows = fopen("rows", "rb");
    FILE *answers = fopen("answers", "wb");
    if (rows == NULL || answers == NULL) {{
        return 1;
    }}
    while (fread(row, sizeof(double), 3, rows) == 3) {{
{calls}
        if (fwrite(out, sizeof(double), {n}, answers) != {n}) {{
            return 1;
        }}
    }}
    return fclose(answers) == 0 && fclose(rows) == 0 ? 0 : 1;
}}
"""


def in_c(rows, *flags):
    """What the functions give in C, (n_rows, n_functions), for rows of two numbers and a whole one."""
    arguments = {**dict.fromkeys(ONE, "row[0]"), **dict.fromkeys(TWO, "row[0], row[1]")}
    arguments |= dict.fromkeys(WHOLE, "row[0], (int)row[2]")
    called = [f"{function_of(name)}({arguments[name]})" for name in ALL]
    calls = "\n".join(f"        out[{place}] = (double){call};" for place, call in enumerate(called))
    text = "\n".join(functions_text(map(function_of, ALL)))
    driver = DRIVER.format(functions=text, calls=calls, n=len(ALL))
    with folder_of({"driver.c": driver}) as folder:
        (folder / "rows").write_bytes(np.array(rows, np.float64).tobytes())
        run_in(folder, tool("gcc"), *STRICT, *flags, "-o", "driver", "driver.c", "-lm")
        run_in(folder, folder / "driver")
        return np.frombuffer((folder / "answers").read_bytes()).reshape(len(rows), len(ALL))


def of_kernel(name):
    return abs if name == "abs" else getattr(kernel, name)


def same(found, expected):
    return (found.view(np.int64) == expected.view(np.int64)) | (np.isnan(found) & np.isnan(expected))


def drawn(rng):
    ways = (rng.uniform(-10, 10), rng.gauss(0, 1) * 10.0 ** rng.randint(-12, 12), float(rng.randint(-40, 40)))
    return rng.choice((*ways, rng.uniform(-800, 800), rng.randint(-2000, 2000) / 2))


def some_rows():
    rng = random.Random(7)
    pairs = [(x, y) for x in NUMBERS for y in NUMBERS] + [(drawn(rng), drawn(rng)) for _ in range(1500)]
    return [(x, y, float(rng.randint(1, 1023))) for x, y in pairs]


@pytest.mark.parametrize(
    "flags",
    [("-O2", "-ffp-contract=off"), ("-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")],
    ids=["optimized", "sanitized"],
)
def test_every_function_has_the_bits_of_the_kernels(flags):
    rows = some_rows()
    found = in_c(rows, *flags)
    for place, name in enumerate(ALL):
        function = of_kernel(name)
        if name in WHOLE:
            expected = [function(x, int(n)) for x, _, n in rows]
        else:
            expected = [function(x) if name in ONE else function(x, y) for x, y, _ in rows]
        equal = same(found[:, place].copy(), np.array(expected, np.float64))
        assert equal.all(), (name, rows[int(np.flatnonzero(~equal)[0])])


@pytest.mark.slow
def test_every_function_has_the_bits_of_compiled_kernels_on_many_numbers():
    rng, n = np.random.default_rng(3), 200_000
    rows = rng.normal(size=(n, 3)) * 10.0 ** rng.integers(-6, 6, (n, 3))
    rows[: n // 4, :2] = rng.integers(0, 2**64, (n // 4, 2), np.uint64).view(np.float64)
    rows[n // 4 : n // 2, :2] = rng.integers(-60, 60, (n // 4, 2)) / 2
    rows[:, 2] = rng.integers(1, 1024, n)
    found = in_c(rows, "-O2", "-ffp-contract=off")
    for place, name in enumerate(ALL):
        equal = same(found[:, place].copy(), compiled(name)(rows))
        assert equal.all(), (name, rows[np.flatnonzero(~equal)[0]])


def compiled(name):
    """A function of rows, compiled as the kernels are."""
    if name == "abs":
        return lambda rows: np.abs(rows[:, 0])
    function = of_kernel(name)
    arguments = "rows[k, 0]" if name in ONE else "rows[k, 0], rows[k, 1]"
    arguments = "rows[k, 0], int(rows[k, 2])" if name in WHOLE else arguments
    text = f"def run(rows, out):\n    for k in range(len(rows)):\n        out[k] = function({arguments})\n"
    scope = {"function": function}
    exec(text, scope)
    run = numba.njit(**jit.OPTIONS)(scope["run"])

    def answers(rows):
        out = np.empty(len(rows))
        run(rows, out)
        return out

    return answers


def test_every_operation_of_graphs_is_written_in_c():
    text = Path(functions.__file__).with_name("elementary.h").read_text()
    defined = set(re.findall(r"^static inline \w+ (bbsd_\w+)\(", text, re.MULTILINE))
    forms = {
        "select",
        "negate",
        "not",
        "cell_of",
        "tangent_slack",
        "quick_modulo",
    }  # the last two occur in kernels alone
    for operation in OPERATIONS.keys() - INFIX.keys() - forms:
        assert operation in IN_MATH_H or f"bbsd_{operation}" in defined
    assert {f"bbsd_{name}" for name in (*ONE, *TWO, *WHOLE) if name not in IN_MATH_H} <= defined


def test_only_what_is_used_is_defined():
    names = re.findall(r"static inline \w+ (\w+)\(", "".join(functions_text(["bbsd_log2", "fabs"])))
    assert names == [
        "bbsd_bits",
        "bbsd_from_bits",
        "bbsd_shifted",
        "bbsd_exponent_and_fraction",
        "bbsd_series_of_logarithm",
        "bbsd_with_poles",
        "bbsd_log2",
    ]
    assert functions_text([]) == []
