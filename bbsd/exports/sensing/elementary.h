#define BBSD_SHIFT 6755399441055744.0 /* 1.5 * 2^52: x + BBSD_SHIFT has the nearest whole number in its lowest bits */

static inline uint64_t bbsd_bits(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double bbsd_from_bits(uint64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The bits, shifted to the right with the sign. */
static inline uint64_t bbsd_shifted(uint64_t bits, unsigned by) {
    return bits >> 63 ? ~(~bits >> by) : bits >> by;
}

/* a where the two do not compare. */
static inline double bbsd_minimum(double a, double b) {
    return b < a ? b : a;
}

/* a where the two do not compare. */
static inline double bbsd_maximum(double a, double b) {
    return b > a ? b : a;
}

/* The whole number x as an index from 0 to last; NaN is 0. */
static inline int bbsd_clamp_index(double x, int last) {
    return x > 0.0 ? (x < (double)last ? (int)x : last) : 0;
}

/* The index of a cell, from 0 to last: what lies beyond goes to the nearest end. */
static inline int bbsd_clamp_cell(int cell, int last) {
    return cell < 0 ? 0 : (cell < last ? cell : last);
}

/* -1, 0 or 1, with the sign of x. */
static inline double bbsd_sign(double x) {
    return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : x);
}

/* The nearest whole number, of two the even one. */
static inline double bbsd_round_half_even(double x) {
    const double size = fabs(x);
    return size < 4503599627370496.0 ? copysign((size + 4503599627370496.0) - 4503599627370496.0, x) : x;
}

static inline double bbsd_degrees(double x) {
    return x * 57.29577951308232;
}

static inline double bbsd_radians(double x) {
    return x * 0.017453292519943295;
}

static inline double bbsd_hypot(double x, double y) {
    return sqrt(x * x + y * y);
}

/* The upper 26 bits of a number (Veltkamp). */
static inline double bbsd_high_half(double x) {
    const double stretched = 134217729.0 * x;
    return stretched - (stretched - x);
}

/* The exact product of a and b less the rounded one (Dekker). */
static inline double bbsd_product_error(double a, double b, double product) {
    const double a_high = bbsd_high_half(a), b_high = bbsd_high_half(b);
    const double a_low = a - a_high, b_low = b - b_high;
    return a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

/* dividend - quotient * divisor, rounded once. */
static inline double bbsd_remainder(double dividend, double divisor, double quotient) {
    const double finite = fabs(divisor) < (double)INFINITY ? divisor : 0.0 * quotient;
    const double product = quotient * finite;
    return (dividend - product) - bbsd_product_error(quotient, finite, product);
}

/* The greatest whole number that is not above the quotient. */
static inline double bbsd_floor_divide(double dividend, double divisor) {
    const double quotient = floor(dividend / divisor);
    return bbsd_remainder(dividend, divisor, quotient) * bbsd_sign(divisor) < 0.0 ? quotient - 1.0 : quotient;
}

/* What a whole quotient leaves, with the sign of the divisor. */
static inline double bbsd_modulo(double dividend, double divisor) {
    const double rest = fmod(dividend, divisor);
    if (rest == 0.0) {
        return copysign(0.0, divisor);
    }
    return rest * bbsd_sign(divisor) < 0.0 ? rest + divisor : rest;
}

/* The angle less whole turns, -pi included, pi not. */
static inline double bbsd_wrap(double angle) {
    const double turns = floor(angle * 0.15915494309189535 + 0.5);
    const double whole = fabs(turns) < 4503599627370496.0 ? turns : (double)NAN;
    const double rest = bbsd_remainder(angle, 6.283185307179586, whole);
    const double lowered = rest >= 3.141592653589793 ? rest - 6.283185307179586 : rest;
    return lowered < -3.141592653589793 ? lowered + 6.283185307179586 : lowered;
}

/* exp(r) - 1 for the rest r of x beside the multiple of log 2 in shifted. */
static inline double bbsd_fraction_of_exponential(double x, double shifted) {
    const double count = shifted - BBSD_SHIFT;
    const double r = (x - count * 0.6931471805598903) - count * 5.497923018708371e-14;
    double p = 2.762221795554647e-07 + r * 2.5046260333848234e-08;
    p = 2.4801516368796397e-05 + r * (2.7557424175025626e-06 + r * p);
    p = 0.0013888888920494161 + r * (0.0001984126971009363 + r * p);
    p = 0.041666666666620014 + r * (0.008333333333388152 + r * p);
    return r + r * r * (0.5 + r * (0.16666666666666602 + r * p));
}

/* 2^n for the n in the lowest bits. */
static inline double bbsd_power_of_two(uint64_t bits) {
    return bbsd_from_bits((bits + 1023u) << 52);
}

static inline double bbsd_exp(double x) {
    const double bounded = bbsd_minimum(bbsd_maximum(x, -746.0), 710.0);
    const double shifted = bounded * 1.4426950408889634 + BBSD_SHIFT;
    const uint64_t bits = bbsd_bits(shifted), half = bbsd_shifted(bits, 1);
    const double value = 1.0 + bbsd_fraction_of_exponential(bounded, shifted);
    return value * bbsd_power_of_two(half) * bbsd_power_of_two(bits - half);
}

static inline double bbsd_tanh(double x) {
    const double doubled = 2.0 * bbsd_minimum(fabs(x), 22.0);
    const double shifted = doubled * 1.4426950408889634 + BBSD_SHIFT;
    const double scale = bbsd_power_of_two(bbsd_bits(shifted));
    const double less_one = scale * bbsd_fraction_of_exponential(doubled, shifted) + (scale - 1.0);
    const double below = less_one + 2.0;
    const double missed = less_one < 2.0 ? less_one - (below - 2.0) : 0.0;
    const double quotient = less_one / below;
    return copysign(quotient - quotient * (missed * (0.5 - 0.5 * quotient)), x);
}

/* n of x = 2^n * (1 + f), sqrt(1/2) <= 1 + f < sqrt(2), for positive finite x; f is written. */
static inline double bbsd_exponent_and_fraction(double x, double *f) {
    const int subnormal = x < 2.2250738585072014e-308;
    const uint64_t bits = bbsd_bits(subnormal ? x * 18014398509481984.0 : x) + UINT64_C(0x00095F619980C433);
    const double shifted = bbsd_from_bits(bbsd_shifted(bits, 52) + UINT64_C(0x4338000000000000));
    *f = bbsd_from_bits((bits & UINT64_C(0x000FFFFFFFFFFFFF)) + UINT64_C(0x3FE6A09E667F3BCD)) - 1.0;
    return shifted - (subnormal ? BBSD_SHIFT + 1077.0 : BBSD_SHIFT + 1023.0);
}

/* log(1 + f) - f + f*f/2. */
static inline double bbsd_series_of_logarithm(double f, double half_square) {
    const double s = f / (2.0 + f);
    const double z = s * s;
    double p = 0.18183563483572848 + z * (0.15314069458252424 + z * 0.14795786180542614);
    p = 0.28571428742189325 + z * (0.2222219859144666 + z * p);
    return s * (half_square + z * (0.6666666666666734 + z * (0.3999999999941566 + z * p)));
}

/* The logarithm where x is positive and finite, else what every logarithm has there. */
static inline double bbsd_with_poles(double x, double logarithm) {
    if (!(x < (double)INFINITY)) {
        return x;
    }
    return x > 0.0 ? logarithm : (x == 0.0 ? -(double)INFINITY : (double)NAN);
}

static inline double bbsd_log(double x) {
    double f;
    const double exponent = bbsd_exponent_and_fraction(x, &f);
    const double half_square = 0.5 * f * f;
    const double rest = half_square - (bbsd_series_of_logarithm(f, half_square) + exponent * 5.497923018708371e-14);
    return bbsd_with_poles(x, exponent * 0.6931471805598903 - (rest - f));
}

static inline double bbsd_log2(double x) {
    double f;
    const double exponent = bbsd_exponent_and_fraction(x, &f);
    const double half_square = 0.5 * f * f;
    const double fraction = f - (half_square - bbsd_series_of_logarithm(f, half_square));
    return bbsd_with_poles(x, exponent + fraction * 1.4426950408889634);
}

static inline double bbsd_log10(double x) {
    double f;
    const double exponent = bbsd_exponent_and_fraction(x, &f);
    const double half_square = 0.5 * f * f;
    const double fraction = f - (half_square - bbsd_series_of_logarithm(f, half_square));
    const double low = exponent * 2.8363394551044964e-14 + fraction * 0.4342944819032518;
    return bbsd_with_poles(x, exponent * 0.30102999566395283 + low);
}

/* x^n for a whole n, -1023 to 1023, by repeated squaring. */
static inline double bbsd_whole_power(double x, int n) {
    const int count = n < 0 ? -n : n;
    double product = 1.0, square = x;
    for (int place = 0; place < 10; place++) {
        if ((count >> place) & 1) {
            product = product * square;
        }
        square = square * square;
    }
    return n < 0 ? 1.0 / product : product;
}

/* x^y for y = 0.5 and -0.5. */
static inline double bbsd_root_power(double x, double y) {
    const double root = sqrt(x);
    return y < 0.0 ? 1.0 / root : root;
}

/* x^y through the logarithm. */
static inline double bbsd_general_power(double x, double y) {
    const double size = bbsd_exp(y * bbsd_log(fabs(x))), half = 0.5 * y;
    if (!(x < 0.0)) {
        return size;
    }
    return floor(y) != y ? (double)NAN : (floor(half) != half ? -size : size);
}

static inline double bbsd_power(double x, double y) {
    const double size = fabs(y);
    if (floor(y) == y && size < 1024.0) {
        return bbsd_whole_power(x, (int)y);
    }
    return size == 0.5 ? bbsd_root_power(x, y) : bbsd_general_power(x, y);
}

/* The rest of x beside the quarter turns in shifted; its rounding error is written. */
static inline double bbsd_within_quarter(double x, double shifted, double *rest) {
    const double count = shifted - BBSD_SHIFT;
    const double first = x - count * 1.5707963267341256;
    const double product = count * 6.077100506303966e-11;
    const double second = first - product;
    const double low = ((first - second) - product) - count * 2.0222662487959506e-21;
    const double r = second + low;
    *rest = (second - r) + low;
    return r;
}

/* sin(r + rest) - r. */
static inline double bbsd_sine_beyond(double r, double rest) {
    const double z = r * r;
    double p = -2.5050747056250412e-08 + z * 1.5896187969448742e-10;
    p = -0.00019841269829577374 + z * (2.755731361701532e-06 + z * p);
    return r * (z * (-0.1666666666666663 + z * (0.008333333333322104 + z * p))) + (rest - rest * (0.5 * z));
}

/* 1 - cos(r + rest). */
static inline double bbsd_cosine_below(double r, double rest) {
    const double z = r * r;
    double p = 2.087570028907216e-09 + z * -1.1358507223669601e-11;
    p = 2.480158728883832e-05 + z * (-2.755731417532794e-07 + z * p);
    p = 0.041666666666666595 + z * (-0.0013888888888873036 + z * p);
    return (0.5 * z - z * z * p) + r * rest;
}

/* sin(x + turn * pi/2); NaN where an angle has no digit left that says where on the circle it is. */
static inline double bbsd_wave(double x, uint64_t turn) {
    const double angle = fabs(x) < 1125899906842624.0 ? x : (double)NAN;
    const double shifted = angle * 0.6366197723675814 + BBSD_SHIFT;
    double rest;
    const double r = bbsd_within_quarter(angle, shifted, &rest);
    const uint64_t quarter = bbsd_bits(shifted) + turn;
    const double size = (quarter & 1u) == 0 ? r + bbsd_sine_beyond(r, rest) : 1.0 - bbsd_cosine_below(r, rest);
    return (quarter & 2u) == 0 ? size : -size;
}

static inline double bbsd_sin(double x) {
    return bbsd_wave(x, 0);
}

static inline double bbsd_cos(double x) {
    return bbsd_wave(x, 1);
}

static inline double bbsd_tan(double x) {
    const double angle = fabs(x) < 1125899906842624.0 ? x : (double)NAN;
    const double shifted = angle * 0.6366197723675814 + BBSD_SHIFT;
    double rest;
    const double r = bbsd_within_quarter(angle, shifted, &rest);
    const double beyond = bbsd_sine_beyond(r, rest), below = bbsd_cosine_below(r, rest);
    const double sine = r + beyond, cosine = 1.0 - below;
    const double sine_rest = beyond - (sine - r), cosine_rest = (1.0 - cosine) - below;
    const int even = (bbsd_bits(shifted) & 1u) == 0;
    const double divisor = even ? cosine : sine, divisor_rest = even ? cosine_rest : sine_rest;
    const double quotient = (even ? sine : -cosine) / divisor;
    return quotient + ((even ? sine_rest : -cosine_rest) - quotient * divisor_rest) / divisor;
}

/* The angle of a right triangle, or pi less it. */
static inline double bbsd_angle(double opposite, double adjacent, int leftward) {
    const int flat = opposite <= 0.41421356237309503 * adjacent;
    const int steep = opposite > 2.414213562373095 * adjacent;
    const double above = flat ? opposite : (steep ? -adjacent : opposite - adjacent);
    const double below = flat ? adjacent : (steep ? opposite : opposite + adjacent);
    const double level = leftward ? 3.141592653589793 : 0.0;
    const double slant = leftward ? 2.356194490192345 : 0.7853981633974483;
    const double base = flat ? level : (steep ? 1.5707963267948966 : slant);
    const double level_rest = leftward ? 1.2246467991473532e-16 : 0.0;
    const double slant_rest = leftward ? 9.184850993605148e-17 : 3.061616997868383e-17;
    const double base_rest = flat ? level_rest : (steep ? 6.123233995736766e-17 : slant_rest);
    const double t = (leftward ? -above : above) / below;
    const double z = t * t;
    double p = -0.05038975330045011 + z * (0.03805655938015656 + z * -0.017898809046130823);
    p = -0.06663092950455685 + z * (0.05847812614151057 + z * p);
    p = -0.09090897696109673 + z * (0.07692059182472918 + z * p);
    p = -0.1428571428014781 + z * (0.1111111078117738 + z * p);
    p = -0.333333333333332 + z * (0.1999999999995307 + z * p);
    return base + (t + (t * (z * p) + base_rest));
}

static inline double bbsd_atan(double x) {
    return copysign(bbsd_angle(fabs(x), 1.0, 0), x);
}

/* The angle of the point (x, y). */
static inline double bbsd_atan2(double y, double x) {
    const double opposite = fabs(y), adjacent = fabs(x);
    const int alike = opposite == adjacent;
    const int leftward = x < 0.0 || (y == 0.0 && copysign(1.0, x) < 0.0);
    const double size = bbsd_angle(alike ? (y == 0.0 ? 0.0 : 1.0) : opposite, alike ? 1.0 : adjacent, leftward);
    return copysign(size, y);
}

/* The arcsine of s less s, s*s = z. */
static inline double bbsd_arc_beyond(double s, double z) {
    double p = 0.021734622430162158 + z * (-0.02103853675164118 + z * 0.032653932809421575);
    p = 0.01078304771586376 + z * (0.0036955417818017974 + z * p);
    p = 0.013980877748590899 + z * (0.01139842863065648 + z * p);
    p = 0.02237221523440639 + z * (0.01735160740741593 + z * p);
    p = 0.0446428571747788 + z * (0.030381942699388702 + z * p);
    return s * (z * (0.1666666666666676 + z * (0.07499999999970634 + z * p)));
}

static inline double bbsd_asin(double x) {
    const double size = fabs(x);
    const int is_near = size <= 0.5;
    const double z = is_near ? size * size : 0.5 * (1.0 - size);
    const double s = is_near ? size : sqrt(z);
    const double beyond = bbsd_arc_beyond(s, z);
    const double distant = 0.7853981633974483 - ((2.0 * beyond - 6.123233995736766e-17) - (0.7853981633974483 - 2.0 * s));
    return copysign(is_near ? s + beyond : distant, x);
}

static inline double bbsd_acos(double x) {
    const double size = fabs(x);
    const int is_near = size <= 0.5;
    const double z = is_near ? size * size : 0.5 * (1.0 - size);
    const double s = is_near ? size : sqrt(z);
    const double arc = s + bbsd_arc_beyond(s, z);
    const double distant = x > 0.0 ? 2.0 * arc : 3.141592653589793 - (2.0 * arc - 1.2246467991473532e-16);
    return is_near ? 1.5707963267948966 - (copysign(arc, x) - 6.123233995736766e-17) : distant;
}

/* A whole number from first to last, both included, by a random number in [0, 1). */
static inline double bbsd_integers(double random, double first, double last) {
    const double span = bbsd_maximum(last - first + 1.0, 1.0);
    return first + bbsd_minimum(floor(random * span), span - 1.0);
}
