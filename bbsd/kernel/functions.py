"""The elementary functions of the language: the same bits in plain Python, in compiled code, on any machine.

Built of `primitives` and the four operations, without branches that depend on the data, so that a loop over
lanes that calls them vectorizes. No function raises for a float; infinities and NaN are as in IEEE 754.
"Within n ulp" was measured against mpmath. The coefficients are minimax (Remez) approximations made for the
intervals stated beside them, the reductions the classical ones (Cody and Waite 1980; Muller, Elementary
Functions, 2016).
"""

from __future__ import annotations

from bbsd.kernel import angles
from bbsd.kernel.angles import acos, asin, atan, atan2, cos, sin, tan, tangent_slack
from bbsd.kernel.primitives import (
    INFINITY,
    NAN,
    PRIMITIVES,
    SHIFT,
    SHIFT_BITS,
    add_where,
    bits_of,
    blend,
    ceil,
    cell_of,
    copysign,
    divide,
    float_of,
    floor,
    maximum,
    maximum_where,
    minimum,
    round_half_even,
    select,
    sqrt,
    truncated_remainder,
)

__all__ = [
    "COMPILABLE",
    "PRIMITIVES",
    "acos",
    "add_where",
    "asin",
    "atan",
    "atan2",
    "blend",
    "ceil",
    "cell_of",
    "clamp_index",
    "copysign",
    "cos",
    "degrees",
    "divide",
    "exp",
    "floor",
    "floor_divide",
    "hypot",
    "is_finite",
    "log",
    "log2",
    "log10",
    "maximum",
    "maximum_where",
    "minimum",
    "modulo",
    "power",
    "quick_modulo",
    "radians",
    "round_half_even",
    "select",
    "sign",
    "sin",
    "sqrt",
    "tan",
    "tangent_slack",
    "tanh",
    "truncated_remainder",
    "whole_power",
    "wrap",
]


def is_finite(x: float) -> bool:
    """Say whether x is neither an infinity nor NaN."""
    return x - x == 0.0


def clamp_index(x: float, last: int) -> int:
    """Return the whole number x as an index from 0 to last: what lies beyond goes to the nearest end, NaN to 0."""
    return int(select(x > 0.0, select(x < last, x, float(last)), 0.0))


def sign(x: float) -> float:
    """Return -1, 0 or 1, with the sign of x; NaN for NaN."""
    return select(x > 0.0, 1.0, select(x < 0.0, -1.0, x))


def degrees(x: float) -> float:
    """Convert radians to degrees, within 1.5 ulp."""
    return x * 57.29577951308232


def radians(x: float) -> float:
    """Convert degrees to radians, within 1.5 ulp."""
    return x * 0.017453292519943295


def hypot(x: float, y: float) -> float:
    """Return sqrt(x*x + y*y), within 1.5 ulp; beyond magnitudes of 1e-145 .. 1e154 squares are 0 or infinite."""
    return sqrt(x * x + y * y)


# --- Division with a whole quotient


def _high_half(x: float) -> float:
    """Return the upper 26 bits of a number below 2**996 (Veltkamp 1968)."""
    stretched = 134217729.0 * x  # 2**27 + 1
    return stretched - (stretched - x)


def _product_error(a: float, b: float, product: float) -> float:
    """Return the rounding error of a * b, the exact product less the rounded one (Dekker 1971)."""
    a_high, b_high = _high_half(a), _high_half(b)
    a_low, b_low = a - a_high, b - b_high
    return a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)


def _remainder(dividend: float, divisor: float, quotient: float) -> float:
    """Return dividend - quotient * divisor, rounded once; the dividend where the divisor is infinite."""
    finite = select(abs(divisor) < INFINITY, divisor, 0.0 * quotient)
    product = quotient * finite
    return (dividend - product) - _product_error(quotient, finite, product)


def floor_divide(dividend: float, divisor: float) -> float:
    """Divide as Python's `//` where the quotient is below 2**52; an infinity or NaN where the divisor is zero."""
    quotient = floor(divide(dividend, divisor))
    return select(_remainder(dividend, divisor, quotient) * sign(divisor) < 0.0, quotient - 1.0, quotient)


def modulo(dividend: float, divisor: float) -> float:
    """Return Python's `%`, with the sign of the divisor, for all numbers; NaN by zero and of an infinity."""
    return _with_sign_of(divisor, truncated_remainder(dividend, divisor))


def quick_modulo(dividend: float, divisor: float) -> float:
    """Return Python's `%` where the quotient is below 2**52 and the divisor of a magnitude in 1e-270 .. 1e270."""
    quotient = floor(divide(dividend, divisor))
    return _with_sign_of(divisor, _remainder(dividend, divisor, quotient))


def _with_sign_of(divisor: float, rest: float) -> float:
    """Return a remainder that has the sign of the divisor, for one that may have the other."""
    wrapped = select(rest * sign(divisor) < 0.0, rest + divisor, rest)
    return select(rest == 0.0, copysign(0.0, divisor), wrapped)


TURN = 6.283185307179586  # 2 * pi
HALF_TURN = 3.141592653589793


def wrap(angle: float) -> float:
    """Return the angle less whole turns of 2 * pi, exactly: -pi <= wrap(x) < pi; NaN beyond 2**52 turns.

    The turn is binary64's 2 * pi, so that angles that were added up of parts of it come back to themselves.
    """
    turns = floor(angle * 0.15915494309189535 + 0.5)
    rest = _remainder(angle, TURN, select(abs(turns) < 4503599627370496.0, turns, NAN))
    lowered = select(rest >= HALF_TURN, rest - TURN, rest)
    return select(lowered < -HALF_TURN, lowered + TURN, lowered)


# --- Exponentials


def _fraction_of_exponential(x: float, shifted: float) -> float:
    """Return exp(r) - 1, error 2.5e-17 of it, for the rest r of x beside the multiple of log 2, |r| <= 0.3466."""
    count = shifted - SHIFT
    r = (x - count * 0.6931471805598903) - count * 5.497923018708371e-14
    p = 2.762221795554647e-07 + r * 2.5046260333848234e-08
    p = 2.4801516368796397e-05 + r * (2.7557424175025626e-06 + r * p)
    p = 0.0013888888920494161 + r * (0.0001984126971009363 + r * p)
    p = 0.041666666666620014 + r * (0.008333333333388152 + r * p)
    return r + r * r * (0.5 + r * (0.16666666666666602 + r * p))


def _power_of_two(bits: int) -> float:
    """Return 2**n for the n in the lowest bits, -1022 <= n <= 1023."""
    return float_of((bits + 1023) << 52)


def exp(x: float) -> float:
    """Return e**x, within 1 ulp; infinite above 709.78, 0 below -745.13, as steps of 5e-324 below -708.4."""
    bounded = minimum(maximum(x, -746.0), 710.0)
    shifted = bounded * 1.4426950408889634 + SHIFT
    bits = bits_of(shifted)
    half = bits >> 1
    value = 1.0 + _fraction_of_exponential(bounded, shifted)
    return value * _power_of_two(half) * _power_of_two(bits - half)


def tanh(x: float) -> float:
    """Return the hyperbolic tangent, within 2 ulp."""
    doubled = 2.0 * minimum(abs(x), 22.0)
    shifted = doubled * 1.4426950408889634 + SHIFT
    scale = _power_of_two(bits_of(shifted))
    less_one = scale * _fraction_of_exponential(doubled, shifted) + (scale - 1.0)
    below = less_one + 2.0
    missed = select(less_one < 2.0, less_one - (below - 2.0), 0.0)
    quotient = less_one / below  # 1 / below is (1 - quotient) / 2
    return copysign(quotient - quotient * (missed * (0.5 - 0.5 * quotient)), x)


# --- Logarithms

SMALLEST_NORMAL = 2.2250738585072014e-308
ROOT_HALF_BITS = 0x3FE6A09E667F3BCD
ROOT_HALF_TO_ONE = 0x0009_5F61_9980_C433  # the bits of 1 less those of sqrt(1/2)
FRACTION_BITS = 0x000FFFFFFFFFFFFF


def _exponent_and_fraction(x: float) -> tuple[float, float]:
    """Return n and f of x = 2**n * (1 + f), sqrt(1/2) <= 1 + f < sqrt(2), for positive finite x."""
    subnormal = x < SMALLEST_NORMAL
    bits = bits_of(select(subnormal, x * 18014398509481984.0, x)) + ROOT_HALF_TO_ONE
    exponent = float_of((bits >> 52) + SHIFT_BITS) - select(subnormal, SHIFT + 1077.0, SHIFT + 1023.0)
    return exponent, float_of((bits & FRACTION_BITS) + ROOT_HALF_BITS) - 1.0


def _series_of_logarithm(f: float, half_square: float) -> float:
    """Return log(1 + f) - f + f*f/2 through s = f / (2 + f), |s| <= 0.1716, error 1.6e-18 of the logarithm."""
    s = f / (2.0 + f)
    z = s * s
    p = 0.18183563483572848 + z * (0.15314069458252424 + z * 0.14795786180542614)
    p = 0.28571428742189325 + z * (0.2222219859144666 + z * p)
    return s * (half_square + z * (0.6666666666666734 + z * (0.3999999999941566 + z * p)))


def _with_poles(x: float, logarithm: float) -> float:
    """Return the logarithm where x is positive and finite, else the value that every logarithm has there."""
    outside = select(x == 0.0, -INFINITY, NAN)
    return select(x < INFINITY, select(x > 0.0, logarithm, outside), x)


def log(x: float) -> float:
    """Return the natural logarithm, within 1 ulp; -inf at 0, NaN below."""
    exponent, f = _exponent_and_fraction(x)
    half_square = 0.5 * f * f
    rest = half_square - (_series_of_logarithm(f, half_square) + exponent * 5.497923018708371e-14)
    return _with_poles(x, exponent * 0.6931471805598903 - (rest - f))


def log2(x: float) -> float:
    """Return the logarithm to the base 2, within 2 ulp, exact for powers of two."""
    exponent, f = _exponent_and_fraction(x)
    half_square = 0.5 * f * f
    fraction = f - (half_square - _series_of_logarithm(f, half_square))
    return _with_poles(x, exponent + fraction * 1.4426950408889634)


def log10(x: float) -> float:
    """Return the logarithm to the base 10, within 2 ulp."""
    exponent, f = _exponent_and_fraction(x)
    half_square = 0.5 * f * f
    fraction = f - (half_square - _series_of_logarithm(f, half_square))
    low = exponent * 2.8363394551044964e-14 + fraction * 0.4342944819032518
    return _with_poles(x, exponent * 0.30102999566395283 + low)


# --- Powers


def whole_power(x: float, n: int) -> float:
    """Return x**n for a whole n, -1023 .. 1023, by repeated squaring, within |n| ulp; 1 / x**-n for negative n."""
    count = abs(n)
    product = 1.0
    square = x
    for place in range(10):
        product = select((count >> place) & 1 == 1, product * square, product)
        square = square * square
    return select(n < 0, divide(1.0, product), product)


def _root_power(x: float, y: float) -> float:
    """Return x**y for y = 0.5 and -0.5, rounded as `sqrt` is."""
    root = sqrt(x)
    return select(y < 0.0, divide(1.0, root), root)


def _general_power(x: float, y: float) -> float:
    """Return x**y through the logarithm; for x < 0 with the sign of an odd y, NaN where y is not whole."""
    size = exp(y * log(abs(x)))
    half = 0.5 * y
    below = select(floor(y) != y, NAN, select(floor(half) != half, -size, size))
    return select(x < 0.0, below, size)


def power(x: float, y: float) -> float:
    """Return x**y: by squaring for whole |y| up to 1023, as a square root for |y| = 0.5, else as exp(y * log(x)).

    The last is within about 2 + 2 * |y * log(x)| ulp. NaN where x is negative and y not whole; x**0 is 1.
    """
    size = abs(y)
    whole = (floor(y) == y) & (size < 1024.0)
    count = bits_of(select(whole, size, 0.0) + SHIFT) & 1023
    by_squaring = whole_power(x, select(y < 0.0, -count, count))
    return select(whole, by_squaring, select(size == 0.5, _root_power(x, y), _general_power(x, y)))


COMPILABLE = (
    clamp_index,
    is_finite,
    sign,
    degrees,
    radians,
    hypot,
    _high_half,
    _product_error,
    _remainder,
    floor_divide,
    _with_sign_of,
    modulo,
    wrap,
    quick_modulo,
    _fraction_of_exponential,
    _power_of_two,
    exp,
    tanh,
    _exponent_and_fraction,
    _series_of_logarithm,
    _with_poles,
    log,
    log2,
    log10,
    whole_power,
    _root_power,
    _general_power,
    power,
    *angles.COMPILABLE,
)
