"""The trigonometric functions, in radians; they keep the promises that `functions` makes for its own."""

from __future__ import annotations

from bbsd.kernel.primitives import NAN, SHIFT, bits_of, copysign, divide, select, sqrt

PI, PI_REST = 3.141592653589793, 1.2246467991473532e-16
HALF_PI, HALF_PI_REST = 1.5707963267948966, 6.123233995736766e-17
QUARTER_PI, QUARTER_PI_REST = 0.7853981633974483, 3.061616997868383e-17
THREE_QUARTER_PI, THREE_QUARTER_PI_REST = 2.356194490192345, 9.184850993605148e-17

STEEPEST = 1.55  # the tangent is 48 there
LARGEST_ANGLE = 2.0**50  # beyond it an angle has no digit left that says where on the circle it is


def _within_quarter(x: float, shifted: float) -> tuple[float, float]:
    """Return the rest of x beside the quarter turns in `shifted`, and its rounding error; pi/2 has three parts."""
    count = shifted - SHIFT
    first = x - count * 1.5707963267341256
    product = count * 6.077100506303966e-11
    second = first - product
    low = ((first - second) - product) - count * 2.0222662487959506e-21
    r = second + low
    return r, (second - r) + low


def _sine_beyond(r: float, rest: float) -> float:
    """Return sin(r + rest) - r for |r| <= pi/4, error 1.1e-17 of the sine."""
    z = r * r
    p = -2.5050747056250412e-08 + z * 1.5896187969448742e-10
    p = -0.00019841269829577374 + z * (2.755731361701532e-06 + z * p)
    return r * (z * (-0.1666666666666663 + z * (0.008333333333322104 + z * p))) + (rest - rest * (0.5 * z))


def _cosine_below(r: float, rest: float) -> float:
    """Return 1 - cos(r + rest) for |r| <= pi/4, error 1.2e-18 of the cosine."""
    z = r * r
    p = 2.087570028907216e-09 + z * -1.1358507223669601e-11
    p = 2.480158728883832e-05 + z * (-2.755731417532794e-07 + z * p)
    p = 0.041666666666666595 + z * (-0.0013888888888873036 + z * p)
    return (0.5 * z - z * z * p) + r * rest


def _wave(x: float, turn: int) -> float:
    """Return sin(x + turn * pi/2)."""
    angle = select(abs(x) < LARGEST_ANGLE, x, NAN)
    shifted = angle * 0.6366197723675814 + SHIFT
    r, rest = _within_quarter(angle, shifted)
    quarter = bits_of(shifted) + turn
    size = select(quarter & 1 == 0, r + _sine_beyond(r, rest), 1.0 - _cosine_below(r, rest))
    return select(quarter & 2 == 0, size, -size)


def sin(x: float) -> float:
    """Return the sine, within 1.5 ulp for |x| <= 1e6; up to 2**50 the angle is off by its last bit, then NaN."""
    return _wave(x, 0)


def cos(x: float) -> float:
    """Return the cosine, as exact as `sin`."""
    return _wave(x, 1)


def tan(x: float) -> float:
    """Return the tangent, within 2 ulp for |x| <= 1e6, beyond as `sin`."""
    angle = select(abs(x) < LARGEST_ANGLE, x, NAN)
    shifted = angle * 0.6366197723675814 + SHIFT
    r, rest = _within_quarter(angle, shifted)
    beyond, below = _sine_beyond(r, rest), _cosine_below(r, rest)
    sine, cosine = r + beyond, 1.0 - below
    sine_rest, cosine_rest = beyond - (sine - r), (1.0 - cosine) - below
    even = bits_of(shifted) & 1 == 0
    divisor, divisor_rest = select(even, cosine, sine), select(even, cosine_rest, sine_rest)
    quotient = divide(select(even, sine, -cosine), divisor)
    return quotient + divide(select(even, sine_rest, -cosine_rest) - quotient * divisor_rest, divisor)


def _angle(opposite: float, adjacent: float, leftward: bool) -> float:
    """Return the angle of a right triangle, or pi less it: one division, |t| <= tan(pi/8), error 6.5e-18 of it."""
    flat = opposite <= 0.41421356237309503 * adjacent
    steep = opposite > 2.414213562373095 * adjacent
    above = select(flat, opposite, select(steep, -adjacent, opposite - adjacent))
    below = select(flat, adjacent, select(steep, opposite, opposite + adjacent))
    level, slant = select(leftward, PI, 0.0), select(leftward, THREE_QUARTER_PI, QUARTER_PI)
    base = select(flat, level, select(steep, HALF_PI, slant))
    level_rest, slant_rest = (
        select(leftward, PI_REST, 0.0),
        select(leftward, THREE_QUARTER_PI_REST, QUARTER_PI_REST),
    )
    base_rest = select(flat, level_rest, select(steep, HALF_PI_REST, slant_rest))
    t = divide(select(leftward, -above, above), below)
    z = t * t
    p = -0.05038975330045011 + z * (0.03805655938015656 + z * -0.017898809046130823)
    p = -0.06663092950455685 + z * (0.05847812614151057 + z * p)
    p = -0.09090897696109673 + z * (0.07692059182472918 + z * p)
    p = -0.1428571428014781 + z * (0.1111111078117738 + z * p)
    p = -0.333333333333332 + z * (0.1999999999995307 + z * p)
    return base + (t + (t * (z * p) + base_rest))


def atan(x: float) -> float:
    """Return the arctangent, within 2 ulp."""
    return copysign(_angle(abs(x), 1.0, False), x)


def atan2(y: float, x: float) -> float:
    """Return the angle of the point (x, y), -pi .. pi, within 2 ulp for coordinates 0 or in 1e-290 .. 1e307."""
    opposite, adjacent = abs(y), abs(x)
    alike = opposite == adjacent  # both zero or both infinite, too
    leftward = (x < 0.0) | ((y == 0.0) & (copysign(1.0, x) < 0.0))
    size = _angle(
        select(alike, select(y == 0.0, 0.0, 1.0), opposite),
        select(alike, 1.0, adjacent),
        leftward,
    )
    return copysign(size, y)


def tangent_slack(angle: float) -> float:
    """Return the distance from tan(angle) beyond which a number compares with it as its arctangent does with the angle.

    That is three hundred times the greatest rounding error (`atan`, `tan`, degrees and a difference of two arctangents
    have 3e-15 in all), for -1.55 <= angle <= 1.55; NaN beyond, where the tangent is too steep.
    """
    tangent = tan(angle)
    return select(abs(angle) <= STEEPEST, 1e-12 * (1.0 + tangent * tangent), NAN)


def _arc_beyond(s: float, z: float) -> float:
    """Return the arcsine of s less s, 0 <= s <= 1/2, s*s = z, error 2.8e-18 of the arcsine."""
    p = 0.021734622430162158 + z * (-0.02103853675164118 + z * 0.032653932809421575)
    p = 0.01078304771586376 + z * (0.0036955417818017974 + z * p)
    p = 0.013980877748590899 + z * (0.01139842863065648 + z * p)
    p = 0.02237221523440639 + z * (0.01735160740741593 + z * p)
    p = 0.0446428571747788 + z * (0.030381942699388702 + z * p)
    return s * (z * (0.1666666666666676 + z * (0.07499999999970634 + z * p)))


def asin(x: float) -> float:
    """Return the arcsine, within 1.5 ulp; NaN beyond -1 .. 1."""
    size = abs(x)
    near = size <= 0.5
    z = select(near, size * size, 0.5 * (1.0 - size))
    s = select(near, size, sqrt(z))
    beyond = _arc_beyond(s, z)
    far = QUARTER_PI - ((2.0 * beyond - HALF_PI_REST) - (QUARTER_PI - 2.0 * s))
    return copysign(select(near, s + beyond, far), x)


def acos(x: float) -> float:
    """Return the arccosine, within 1.5 ulp; NaN beyond -1 .. 1."""
    size = abs(x)
    near = size <= 0.5
    z = select(near, size * size, 0.5 * (1.0 - size))
    s = select(near, size, sqrt(z))
    arc = s + _arc_beyond(s, z)
    far = select(x > 0.0, 2.0 * arc, PI - (2.0 * arc - PI_REST))
    return select(near, HALF_PI - (copysign(arc, x) - HALF_PI_REST), far)


COMPILABLE = (
    _within_quarter,
    _sine_beyond,
    _cosine_below,
    _wave,
    sin,
    cos,
    tan,
    _angle,
    atan,
    atan2,
    tangent_slack,
    _arc_beyond,
    asin,
    acos,
)
