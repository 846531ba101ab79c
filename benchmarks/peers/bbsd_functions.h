/* bbsd/kernel/functions.py and angles.py, operation by operation: the same bits as bbsd's kernels. */
#include <stdint.h>
#include <string.h>

static const double SHIFT = 6755399441055744.0; /* 1.5 * 2**52: rounds a number that it is added to */

static inline int64_t bits_of(double x) {
    int64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double float_of(int64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static inline double wave(double x, int64_t turn) {
    double shifted = x * 0.6366197723675814 + SHIFT, count = shifted - SHIFT;
    double first = x - count * 1.5707963267341256, product = count * 6.077100506303966e-11;
    double second = first - product, low = ((first - second) - product) - count * 2.0222662487959506e-21;
    double r = second + low, rest = (second - r) + low, z = r * r, size;
    int64_t quarter = bits_of(shifted) + turn;
    if ((quarter & 1) == 0) {
        double p = -2.5050747056250412e-08 + z * 1.5896187969448742e-10;
        p = -0.00019841269829577374 + z * (2.755731361701532e-06 + z * p);
        size = r + (r * (z * (-0.1666666666666663 + z * (0.008333333333322104 + z * p))) + (rest - rest * (0.5 * z)));
    } else {
        double p = 2.087570028907216e-09 + z * -1.1358507223669601e-11;
        p = 2.480158728883832e-05 + z * (-2.755731417532794e-07 + z * p);
        p = 0.041666666666666595 + z * (-0.0013888888888873036 + z * p);
        size = 1.0 - ((0.5 * z - z * z * p) + r * rest);
    }
    return (quarter & 2) == 0 ? size : -size;
}

static inline double bbsd_sin(double x) { return wave(x, 0); }
static inline double bbsd_cos(double x) { return wave(x, 1); }

static inline double bbsd_atan2(double y, double x) {
    double opposite = fabs(y), adjacent = fabs(x), above, below, base, rest;
    int leftward = x < 0;
    if (opposite <= 0.41421356237309503 * adjacent) {
        above = opposite, below = adjacent;
        base = leftward ? 3.141592653589793 : 0, rest = leftward ? 1.2246467991473532e-16 : 0;
    } else if (opposite > 2.414213562373095 * adjacent) {
        above = -adjacent, below = opposite, base = 1.5707963267948966, rest = 6.123233995736766e-17;
    } else {
        above = opposite - adjacent, below = opposite + adjacent;
        base = leftward ? 2.356194490192345 : 0.7853981633974483;
        rest = leftward ? 9.184850993605148e-17 : 3.061616997868383e-17;
    }
    double t = (leftward ? -above : above) / below, z = t * t;
    double p = -0.05038975330045011 + z * (0.03805655938015656 + z * -0.017898809046130823);
    p = -0.06663092950455685 + z * (0.05847812614151057 + z * p);
    p = -0.09090897696109673 + z * (0.07692059182472918 + z * p);
    p = -0.1428571428014781 + z * (0.1111111078117738 + z * p);
    p = -0.333333333333332 + z * (0.1999999999995307 + z * p);
    return copysign(base + (t + (t * (z * p) + rest)), y);
}

/* For 0 < x <= 1, not subnormal, as a draw is. */
static inline double bbsd_log(double x) {
    int64_t bits = bits_of(x) + 0x00095F619980C433;
    double exponent = float_of((bits >> 52) + 0x4338000000000000) - (SHIFT + 1023.0);
    double f = float_of((bits & 0x000FFFFFFFFFFFFF) + 0x3FE6A09E667F3BCD) - 1.0;
    double half_square = 0.5 * f * f, s = f / (2.0 + f), z = s * s;
    double p = 0.18183563483572848 + z * (0.15314069458252424 + z * 0.14795786180542614);
    p = 0.28571428742189325 + z * (0.2222219859144666 + z * p);
    double series = s * (half_square + z * (0.6666666666666734 + z * (0.3999999999941566 + z * p)));
    double rest = half_square - (series + exponent * 5.497923018708371e-14);
    return exponent * 0.6931471805598903 - (rest - f);
}
