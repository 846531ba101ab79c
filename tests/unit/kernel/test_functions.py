import math
import random
import re
from collections.abc import Callable, Iterator
from functools import cache
from types import ModuleType

import mpmath
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from bbsd.kernel import functions as f
from bbsd.kernel.modules import load_kernel

LANES = 40
INF, NAN = math.inf, math.nan
SPECIAL = (
    0.0,
    -0.0,
    5e-324,
    -2.3e-308,
    1e-300,
    0.5,
    -0.5,
    1.0,
    -1.0,
    1.5,
    2.5,
    -2.5,
    3.0,
    100.0,
    -746.0,
    709.9,
    2.0**31,
    1e6,
    2.0**51,
    4503599627370495.5,
    -1e17,
    1e300,
    -1.7e308,
    INF,
    -INF,
    NAN,
)

Sampler = Callable[[random.Random], float]


def span(low: float, high: float) -> Sampler:
    return lambda generator: generator.uniform(low, high)


def magnitude(low: float, high: float) -> Sampler:
    return lambda generator: math.exp(generator.uniform(math.log(low), math.log(high)))


def near_one(sampler: Sampler) -> Sampler:
    return lambda generator: 1.0 - sampler(generator)


def multiples_of_half_pi(generator: random.Random) -> float:
    return generator.randint(-600_000, 600_000) * math.pi / 2


def ulps(got: float, exact: mpmath.mpf) -> float:
    """Return the error in units of the last place of the exact value."""
    _, exponent = mpmath.frexp(exact)
    return float(abs(mpmath.mpf(got) - exact) / mpmath.mpf(2) ** max(int(exponent) - 53, -1074))


ACCURACY: list[
    tuple[Callable[[float], float], Callable[[mpmath.mpf], mpmath.mpf], float, tuple[Sampler, ...]]
] = [
    (f.exp, mpmath.exp, 1.0, (span(-745, 709.7), span(-1, 1), magnitude(1e-20, 1))),
    (f.tanh, mpmath.tanh, 2.0, (span(-2, 2), span(-22, 22), magnitude(1e-300, 1))),
    (f.log, mpmath.log, 1.0, (magnitude(5e-324, 1e308), span(0.5, 2), near_one(magnitude(1e-16, 0.5)))),
    (
        f.log2,
        lambda x: mpmath.log(x, 2),
        2.0,
        (magnitude(5e-324, 1e308), span(0.5, 2), near_one(magnitude(1e-16, 0.5))),
    ),
    (f.log10, mpmath.log10, 2.0, (magnitude(5e-324, 1e308), span(0.1, 10), near_one(magnitude(1e-16, 0.5)))),
    (f.sin, mpmath.sin, 1.5, (span(-7, 7), span(-1e6, 1e6), multiples_of_half_pi, magnitude(1e-300, 1))),
    (f.cos, mpmath.cos, 1.5, (span(-7, 7), span(-1e6, 1e6), multiples_of_half_pi)),
    (f.tan, mpmath.tan, 2.0, (span(-7, 7), span(-1e6, 1e6), multiples_of_half_pi, magnitude(1e-300, 1))),
    (f.atan, mpmath.atan, 2.0, (span(-1, 1), span(-4, 4), span(0.41, 0.52), magnitude(1e-300, 1e300))),
    (f.asin, mpmath.asin, 1.5, (span(-1, 1), span(0.49, 0.55), near_one(magnitude(1e-16, 1)))),
    (f.acos, mpmath.acos, 1.5, (span(-1, 1), span(-0.55, -0.49), near_one(magnitude(1e-16, 1)))),
    (f.degrees, mpmath.degrees, 1.5, (span(-7, 7),)),
    (f.radians, mpmath.radians, 1.5, (span(-400, 400),)),
]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("function", "exact", "bound", "samplers"), ACCURACY, ids=lambda value: getattr(value, "__name__", "")
)
def test_is_within_the_stated_ulp(
    function: Callable[[float], float],
    exact: Callable[[mpmath.mpf], mpmath.mpf],
    bound: float,
    samplers: tuple[Sampler, ...],
) -> None:
    generator = random.Random(20)
    points = [sampler(generator) for sampler in samplers for _ in range(1200)]
    with mpmath.workprec(200):
        worst = max(points, key=lambda x: ulps(function(x), exact(mpmath.mpf(x))))
        assert ulps(function(worst), exact(mpmath.mpf(worst))) <= bound, worst


def test_atan2_is_within_two_ulp() -> None:
    generator = random.Random(21)
    small, wide = span(-3, 3), magnitude(1e-140, 1e140)
    points = [(sampler(generator), sampler(generator)) for sampler in (small, wide) for _ in range(1500)]
    with mpmath.workprec(200):
        assert max(ulps(f.atan2(y, x), mpmath.atan2(y, x)) for y, x in points) <= 2.0


def test_hypot_is_within_the_stated_ulp() -> None:
    generator = random.Random(22)
    points = [
        (sampler(generator), sampler(generator))
        for sampler in (span(-3, 3), magnitude(1e-145, 1e153))
        for _ in range(1500)
    ]
    with mpmath.workprec(200):
        assert max(ulps(f.hypot(x, y), mpmath.hypot(x, y)) for x, y in points) <= 1.5


def test_general_power_is_within_the_stated_error() -> None:
    generator = random.Random(23)
    points = [(generator.uniform(0.001, 1000), generator.uniform(-9, 9)) for _ in range(1500)]
    with mpmath.workprec(200):
        assert all(ulps(f.power(x, y), mpmath.power(x, y)) <= 2 + 2 * abs(y * math.log(x)) for x, y in points)


def test_wrapped_angles_are_exact() -> None:
    generator = random.Random(25)
    samplers = (
        span(-7, 7),
        span(-1e6, 1e6),
        multiples_of_half_pi,
        magnitude(1e-300, 1e16),
        span(-4e15, 4e15),
    )
    turn = mpmath.mpf(2 * math.pi)
    with mpmath.workprec(200):
        for angle in (sampler(generator) for sampler in samplers for _ in range(1200)):
            exact = mpmath.mpf(angle) - turn * mpmath.floor(mpmath.mpf(angle) / turn + mpmath.mpf(0.5))
            assert mpmath.mpf(f.wrap(angle)) == exact, angle
            assert -math.pi <= f.wrap(angle) < math.pi


def test_whole_power_is_within_the_stated_error() -> None:
    generator = random.Random(24)
    points = [
        (generator.uniform(0.5, 2), generator.choice((-1, 1)) * generator.randint(1, 1000))
        for _ in range(1500)
    ]
    with mpmath.workprec(200):
        assert all(ulps(f.whole_power(x, n), mpmath.power(x, n)) <= abs(n) for x, n in points)


@given(st.integers(-200, 200), st.integers(0, 6))
def test_whole_powers_of_whole_numbers_are_exact(base: int, exponent: int) -> None:
    assert f.power(float(base), float(exponent)) == base**exponent


@given(st.floats(0.0, allow_infinity=False))
def test_power_of_a_half_is_the_square_root(x: float) -> None:
    assert f.power(x, 0.5) == math.sqrt(x)


def test_logarithms_of_powers_of_their_base_are_exact() -> None:
    assert [f.log2(2.0**n) for n in range(-1074, 1024)] == list(range(-1074, 1024))
    assert [f.log10(10.0**n) for n in range(23)] == list(range(23))


@given(
    st.floats(-1e9, 1e9).filter(lambda x: x == 0.0 or abs(x) > 1e-200),
    st.floats(-1e9, 1e9).filter(lambda y: abs(y) > 1e-5),
)
def test_division_with_a_whole_quotient_is_python_s(dividend: float, divisor: float) -> None:
    got = f.floor_divide(dividend, divisor), f.modulo(dividend, divisor)
    assert got == (dividend // divisor, dividend % divisor)
    assert math.copysign(1.0, got[1]) == math.copysign(1.0, dividend % divisor)
    assert f.bits_of(f.quick_modulo(dividend, divisor)) == f.bits_of(got[1])


FINITE = st.floats(allow_nan=False, allow_infinity=False)


@given(FINITE, FINITE.filter(bool))
@example(1e300, 3.0)
@example(-(2.0**53 + 2), 7.0)
@example(5e-324, -1.7976931348623157e308)
@example(1.7976931348623157e308, 5e-324)
@example(-5e-324, 3.0)
def test_remainders_of_all_numbers_are_python_s(dividend: float, divisor: float) -> None:
    assert f.bits_of(f.modulo(dividend, divisor)) == f.bits_of(dividend % divisor)


@given(st.floats(-(2.0**51), 2.0**51), st.floats(1e-270, 1e270), st.booleans())
def test_quick_remainders_are_those_of_all_numbers(ratio: float, size: float, negative: bool) -> None:
    divisor = -size if negative else size
    dividend = ratio * divisor
    assert f.bits_of(f.quick_modulo(dividend, divisor)) == f.bits_of(f.modulo(dividend, divisor))


@given(st.integers(-(10**15), 10**15), st.integers(-(10**15), 10**15).filter(bool))
def test_whole_numbers_divide_exactly(dividend: int, divisor: int) -> None:
    assert (f.floor_divide(dividend, divisor), f.modulo(dividend, divisor)) == divmod(dividend, divisor)


@pytest.mark.parametrize("dividend", [0.0, 2.0, -2.0, INF, NAN])
@pytest.mark.parametrize("divisor", [0.0, -0.0, INF, -INF, NAN])
def test_division_by_zero_and_infinity_is_numpy_s(dividend: float, divisor: float) -> None:
    with np.errstate(all="ignore"):
        expected = (
            np.divide(dividend, divisor),
            np.floor_divide(dividend, divisor),
            np.remainder(dividend, divisor),
        )
    got = f.divide(dividend, divisor), f.floor_divide(dividend, divisor), f.modulo(dividend, divisor)
    np.testing.assert_array_equal(got, expected)


@pytest.mark.parametrize(
    ("got", "expected"),
    [
        (f.log(0.0), -INF),
        (f.log(-1.0), NAN),
        (f.log(INF), INF),
        (f.log(1.0), 0.0),
        (f.log2(-0.0), -INF),
        (f.log10(NAN), NAN),
        (f.sqrt(-1.0), NAN),
        (f.sqrt(INF), INF),
        (f.sqrt(-0.0), -0.0),
        (f.exp(710.0), INF),
        (f.exp(INF), INF),
        (f.exp(-INF), 0.0),
        (f.exp(NAN), NAN),
        (f.exp(0.0), 1.0),
        (f.exp(-745.1), 5e-324),
        (f.tanh(INF), 1.0),
        (f.tanh(-INF), -1.0),
        (f.tanh(-0.0), -0.0),
        (f.tanh(NAN), NAN),
        (f.sin(INF), NAN),
        (f.cos(-INF), NAN),
        (f.tan(NAN), NAN),
        (f.sin(1e300), NAN),
        (f.sin(0.0), 0.0),
        (f.cos(0.0), 1.0),
        (f.atan(INF), math.pi / 2),
        (f.atan(-INF), -math.pi / 2),
        (f.atan(-0.0), -0.0),
        (f.atan(NAN), NAN),
        (f.atan(1.0), math.pi / 4),
        (f.asin(1.0), math.pi / 2),
        (f.asin(-1.0), -math.pi / 2),
        (f.asin(1.1), NAN),
        (f.acos(1.0), 0.0),
        (f.acos(-1.0), math.pi),
        (f.acos(-2.0), NAN),
        (f.hypot(3.0, 4.0), 5.0),
        (f.hypot(INF, 1.0), INF),
        (f.hypot(1e200, 0.0), INF),
        (f.sign(-3.0), -1.0),
        (f.sign(-0.0), -0.0),
        (f.sign(0.1), 1.0),
        (f.sign(NAN), NAN),
        (f.floor(-0.3), -1.0),
        (f.floor(-0.0), -0.0),
        (f.ceil(-0.3), -0.0),
        (f.ceil(0.3), 1.0),
        (f.floor(INF), INF),
        (f.ceil(NAN), NAN),
        (f.round_half_even(2.5), 2.0),
        (f.round_half_even(-0.4), -0.0),
        (f.round_half_even(4503599627370495.5), 4503599627370496.0),
        (f.power(0.0, 0.0), 1.0),
        (f.power(NAN, 0.0), 1.0),
        (f.power(0.0, -1.0), INF),
        (f.power(-0.0, -3.0), -INF),
        (f.power(-8.0, 3.0), -512.0),
        (f.power(-8.0, 1 / 3), NAN),
        (f.power(0.0, 2.5), 0.0),
        (f.power(0.0, -2.5), INF),
        (f.power(4.0, -0.5), 0.5),
        (f.power(2.0, 1e5), INF),
        (f.power(-1.0, 2001.0), -1.0),
        (f.power(INF, 0.3), INF),
        (f.power(1.0, NAN), NAN),
        (f.power(10.0, 400.0), INF),
        (f.minimum(1.0, NAN), 1.0),
        (f.minimum(NAN, 1.0), NAN),
        (f.maximum(2.0, 3.0), 3.0),
        (f.maximum(NAN, 3.0), NAN),
        (f.wrap(math.pi), -math.pi),
        (f.wrap(-math.pi), -math.pi),
        (f.wrap(3 * math.pi), -math.pi),
        (f.wrap(math.nextafter(math.pi, 0.0)), math.nextafter(math.pi, 0.0)),
        (f.wrap(math.nextafter(-math.pi, -4.0)), math.nextafter(-math.pi, -4.0) + 2 * math.pi),
        (f.wrap(1.5 * math.pi), -0.5 * math.pi),
        (f.wrap(2 * math.pi), 0.0),
        (f.wrap(-1e-20), -1e-20),
        (f.wrap(-0.0), 0.0),
        (f.wrap(1e300), NAN),
        (f.wrap(INF), NAN),
        (f.wrap(NAN), NAN),
        (f.degrees(math.pi), 180.0),
        (f.radians(180.0), math.pi),
    ],
)
def test_special_values(got: float, expected: float) -> None:
    assert same_bits(np.array([got]), np.array([expected]))


@pytest.mark.parametrize("y", [0.0, -0.0, 1.0, -1.0, INF, -INF, NAN])
@pytest.mark.parametrize("x", [0.0, -0.0, 1.0, -1.0, INF, -INF, NAN])
def test_atan2_on_the_axes_and_at_infinity_is_c_s(y: float, x: float) -> None:
    assert same_bits(np.array([f.atan2(y, x)]), np.array([math.atan2(y, x)]))


@given(st.floats())
def test_only_numbers_are_finite(x: float) -> None:
    assert f.is_finite(x) == math.isfinite(x)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_rounding_is_python_s(x: float) -> None:
    assert (f.floor(x), f.ceil(x), f.round_half_even(x)) == (math.floor(x), math.ceil(x), round(x))


# --- The same bits in plain Python, in compiled scalar code and in a vectorized loop over lanes

EXPRESSIONS = (
    "exp(x)",
    "tanh(x)",
    "log(x)",
    "log2(x)",
    "log10(x)",
    "sin(x)",
    "cos(x)",
    "tan(x)",
    "atan(x)",
    "asin(x)",
    "acos(x)",
    "degrees(x)",
    "radians(x)",
    "sqrt(x)",
    "floor(x)",
    "ceil(x)",
    "round_half_even(x)",
    "wrap(x)",
    "sign(x)",
    "whole_power(x, 3)",
    "whole_power(x, -2)",
    "power(x, 2.0)",
    "power(x, -0.5)",
    "atan2(x, y)",
    "hypot(x, y)",
    "divide(x, y)",
    "copysign(x, y)",
    "minimum(x, y)",
    "maximum(x, y)",
    "modulo(x, y)",
    "quick_modulo(x, y)",
    "floor_divide(x, y)",
    "power(x, y)",
    "select(is_finite(x) & (x < y), 1.0, 2.0)",
    "add_where(x, x < y, y)",
    "blend(x < y, x, y)",
    "maximum_where(x, is_finite(x), y)",
    "maximum_where(-5, x < y, cell_of(y < 1.0)) * 0.5",
)


def source_of(expression: str) -> str:
    names = ", ".join(sorted({"atan", *re.findall(r"[a-z_0-9]+(?=\()", expression)}))
    return f"""
from bbsd.kernel.functions import {names}

def scalar(x, y):
    return {expression}

def lanes(floats, steps):
    xs = floats[0:{LANES}]
    ys = floats[{LANES}:{2 * LANES}]
    results = floats[{2 * LANES}:{3 * LANES}]
    more = floats[{3 * LANES}:{4 * LANES}]
    for step in range(steps):
        for lane in range({LANES}):
            x = xs[lane]
            y = ys[lane]
            results[lane] = {expression}
            more[lane] = atan(x)  # a short loop would be unrolled before it is vectorized
"""


@cache
def kernel(expression: str, compiled: bool) -> ModuleType:
    return load_kernel(source_of(expression), "trial", ("scalar", "lanes"), compiled)


@pytest.fixture(autouse=True, scope="module")
def own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("BBSD_CACHE_DIR", str(tmp_path_factory.mktemp("cache")))
        yield


def same_bits(a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
    """Say whether two arrays hold the same bits, all NaN being equal."""
    nan = np.isnan(a)
    return bool(
        np.array_equal(nan, np.isnan(b)) and np.array_equal(a[~nan].view(np.uint64), b[~nan].view(np.uint64))
    )


def by_lanes(expression: str, xs: list[float], ys: list[float]) -> NDArray[np.float64]:
    floats = np.zeros(4 * LANES)
    floats[: len(xs)], floats[LANES : LANES + len(ys)] = xs, ys
    kernel(expression, True).lanes(floats, 2)
    return floats[2 * LANES : 2 * LANES + len(xs)]


def assert_same_everywhere(expression: str, xs: list[float], ys: list[float]) -> None:
    plain = np.array(
        [kernel(expression, False).scalar(x, y) for x, y in zip(xs, ys, strict=True)], dtype=float
    )
    scalar = np.array([kernel(expression, True).scalar(x, y) for x, y in zip(xs, ys, strict=True)])
    assert same_bits(plain, scalar)
    assert same_bits(plain, by_lanes(expression, xs, ys))


@pytest.mark.slow
@pytest.mark.parametrize("expression", EXPRESSIONS)
def test_special_points_give_the_same_bits_everywhere(expression: str) -> None:
    pairs = [(x, y) for x in SPECIAL for y in SPECIAL]
    for start in range(0, len(pairs), LANES):
        xs, ys = zip(*pairs[start : start + LANES], strict=True)
        assert_same_everywhere(expression, list(xs), list(ys))


@pytest.mark.slow
@pytest.mark.parametrize("expression", EXPRESSIONS)
def test_any_number_gives_the_same_bits_everywhere(expression: str) -> None:
    number = st.one_of(st.floats(), st.floats(-10, 10), st.floats(-1e6, 1e6))
    numbers = st.lists(number, min_size=LANES, max_size=LANES)

    @settings(max_examples=15, deadline=None)
    @given(numbers, numbers)
    def agree(xs: list[float], ys: list[float]) -> None:
        assert_same_everywhere(expression, xs, ys)

    agree()


@pytest.mark.slow
@pytest.mark.parametrize("expression", EXPRESSIONS)
def test_a_loop_over_lanes_is_vectorized(expression: str) -> None:
    by_lanes(expression, [1.0], [1.0])
    (code,) = kernel(expression, True).lanes.inspect_llvm().values()
    assert re.search(r"<\d+ x double>", code)
    assert not re.search(r"call [^@]*double @(?!llvm\.)", code)


@pytest.mark.parametrize(
    ("x", "index"),
    [(-INF, 0), (-1.0, 0), (-0.0, 0), (0.0, 0), (1.0, 1), (4.0, 4), (5.0, 4), (1e300, 4), (INF, 4), (NAN, 0)],
)
def test_an_index_goes_to_the_nearest_end_and_never_wraps(x, index):
    found = f.clamp_index(x, 4)
    assert (found, type(found)) == (index, int)
    assert f.clamp_index(x, 0) == 0
