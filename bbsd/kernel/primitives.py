"""The operations that all else is built of: exact, or rounded once as IEEE 754 says, so alike on any machine.

Plain Python here; `kernel.intrinsics` gives compiled code the one machine instruction that does the same.
None of them raises for a float: where Python would, they return the infinity or NaN that the hardware does.
"""

from __future__ import annotations

import math
from struct import Struct
from typing import TypeVar

Value = TypeVar("Value", int, float)

INFINITY = math.inf
NAN = math.nan
MASK = 0xFFFFFFFFFFFFFFFF
WHOLE = 2.0**52  # from here on every binary64 number is whole

# x + SHIFT rounds x to a whole number, half to even, which then stands in the lowest bits of the sum.
SHIFT = 6755399441055744.0  # 1.5 * 2**52
SHIFT_BITS = 0x4338000000000000

_FLOAT = Struct("<d")
_SIGNED = Struct("<q")
_UNSIGNED = Struct("<Q")


def select(condition: bool, then: Value, otherwise: Value) -> Value:
    """Return `then` where the condition holds, else `otherwise`; both are evaluated, nothing branches."""
    return then if condition else otherwise


def blend(condition: bool, then: float, otherwise: float) -> float:
    """Select between floats bit by bit: for `select` LLVM may choose an address first, and that cannot vectorize."""
    return then if condition else otherwise


def minimum(a: Value, b: Value) -> Value:
    """Return the smaller of two numbers; a where they do not compare."""
    return b if b < a else a  # noqa: FURB136 - not min: this is what the hardware is told


def maximum(a: Value, b: Value) -> Value:
    """Return the greater of two numbers; a where they do not compare."""
    return b if b > a else a  # noqa: FURB136


def add_where(total: float, condition: bool, term: float) -> float:
    """Return the sum of both where the condition holds, else the total alone."""
    return total + term if condition else total


def maximum_where(highest: Value, condition: bool, other: Value) -> Value:
    """Return the greater of two numbers where the condition holds, else the first."""
    return maximum(highest, other) if condition else highest


def cell_of(truth: bool) -> int:
    """Return the cell of a truth: 0 if false, 1 if true."""
    return int(truth)


def bits_of(x: float) -> int:
    """Return the 64 bits of a binary64 number as a signed whole number."""
    bits: int = _SIGNED.unpack(_FLOAT.pack(x))[0]
    return bits


def float_of(bits: int) -> float:
    """Return the binary64 number whose bits are the lowest 64 of a whole number."""
    x: float = _FLOAT.unpack(_UNSIGNED.pack(bits & MASK))[0]
    return x


def word_of(number: int) -> int:
    """Return a whole number as an unsigned 64-bit word; compiled code has no other way from int64 to uint64."""
    return int(number) & MASK


def copysign(magnitude: float, sign: float) -> float:
    """Return the magnitude of the first with the sign bit of the second."""
    return math.copysign(magnitude, sign)


def divide(dividend: float, divisor: float) -> float:
    """Return the quotient: an infinity where only the divisor is zero, NaN where both are."""
    if divisor:
        return dividend / divisor
    return dividend * math.copysign(INFINITY, divisor)


def truncated_remainder(dividend: float, divisor: float) -> float:
    """Return C's `fmod`, exact and with the sign of the dividend; NaN by zero and of an infinity."""
    if divisor == 0.0 or math.isinf(dividend):
        return NAN
    return math.fmod(dividend, divisor)


def sqrt(x: float) -> float:
    """Return the square root, NaN below zero."""
    return math.sqrt(x) if x >= 0.0 else NAN


def round_half_even(x: float) -> float:
    """Return the nearest whole number, the even one of two; keeps the sign of zero."""
    if abs(x) < WHOLE:
        return math.copysign((abs(x) + WHOLE) - WHOLE, x)
    return x


def floor(x: float) -> float:
    """Return the greatest whole number that is not above x."""
    nearest = round_half_even(x)
    return math.copysign(nearest - 1.0, x) if nearest > x else nearest


def ceil(x: float) -> float:
    """Return the least whole number that is not below x."""
    nearest = round_half_even(x)
    return math.copysign(nearest + 1.0, x) if nearest < x else nearest


PRIMITIVES = (
    select,
    blend,
    add_where,
    maximum_where,
    cell_of,
    minimum,
    maximum,
    bits_of,
    float_of,
    word_of,
    copysign,
    divide,
    truncated_remainder,
    sqrt,
    round_half_even,
    floor,
    ceil,
)
