#include "src/core/elementary.h"

#include <cmath>
#include <cstdint>

namespace polargrain {

namespace {

// pi/2 in three parts with trailing zero bits, so that a multiple of the first two is exact
// [CW80]; the count of quarter turns stays below 2^20 for |angle| < 1e6.
constexpr double k_half_pi_1 = 0x1.921fb544p+0;
constexpr double k_half_pi_2 = 0x1.0b4611a6p-34;
constexpr double k_half_pi_3 = 0x1.3198a2e037073p-69;

double sine_kernel(double x) {  // Taylor series, |x| <= pi/4: the first term left out is below 2e-18
    const double z = x * x;
    double p = 1.0 / 355687428096000.0;
    p = -1.0 / 1307674368000.0 + z * p;
    p = 1.0 / 6227020800.0 + z * p;
    p = -1.0 / 39916800.0 + z * p;
    p = 1.0 / 362880.0 + z * p;
    p = -1.0 / 5040.0 + z * p;
    p = 1.0 / 120.0 + z * p;
    p = -1.0 / 6.0 + z * p;
    return x + x * (z * p);
}

// log 2 in two parts, the first with trailing zero bits: a count of doublings times it is exact.
constexpr double k_log2_high = 0x1.62e42fee00000p-1;
constexpr double k_log2_low = 0x1.a39ef35793c76p-33;

double cosine_kernel(double x) {
    const double z = x * x;
    double p = -1.0 / 6402373705728000.0;
    p = 1.0 / 20922789888000.0 + z * p;
    p = -1.0 / 87178291200.0 + z * p;
    p = 1.0 / 479001600.0 + z * p;
    p = -1.0 / 3628800.0 + z * p;
    p = 1.0 / 40320.0 + z * p;
    p = -1.0 / 720.0 + z * p;
    p = 1.0 / 24.0 + z * p;
    return 1.0 - (0.5 * z - z * z * p);
}

}  // namespace

SineCosine sine_cosine(double angle) {
    const double quarters = std::nearbyint(angle * (2.0 / k_pi));
    const double high = angle - quarters * k_half_pi_1;
    const double low = quarters * k_half_pi_2;
    const double difference = high - low;
    // Near a multiple of pi/2 little is left of the angle: keep what the subtraction rounds away [CW80].
    const double back = difference - high;
    const double lost = (high - (difference - back)) - (low + back);
    const double r = difference + (lost - quarters * k_half_pi_3);
    const double s = sine_kernel(r);
    const double c = cosine_kernel(r);
    switch (static_cast<std::int64_t>(quarters) & 3) {
        case 0: return {s, c};
        case 1: return {c, -s};
        case 2: return {-s, -c};
        default: return {-c, s};
    }
}

double natural_log(double x) {
    int exponent = 0;
    double m = std::frexp(x, &exponent);  // exact: m in [1/2, 1)
    if (m < 0.70710678118654752) {
        m *= 2.0;
        --exponent;
    }
    const double f = (m - 1.0) / (m + 1.0);  // log m = 2 atanh f, |f| < 0.172
    const double z = f * f;
    double p = 0.0;
    for (int k = 21; k >= 3; k -= 2) p = (1.0 / k) + z * p;
    return exponent * k_log2_high + (2.0 * f + (2.0 * f * (z * p) + exponent * k_log2_low));
}

double exponential(double x) {
    const double doublings = std::nearbyint(x / (k_log2_high + k_log2_low));
    const double r = (x - doublings * k_log2_high) - doublings * k_log2_low;
    double p = 0.0;  // Taylor series, |r| <= 0.35: the first term left out is below 4e-18
    for (int k = 13; k >= 2; --k) p = (r / k) * (1.0 + p);
    return std::ldexp(1.0 + (r + r * p), static_cast<int>(doublings));
}

double power(double base, double exponent) { return exponential(exponent * natural_log(base)); }

}  // namespace polargrain
