#pragma once

namespace polargrain {

inline constexpr double k_pi = 3.141592653589793238462643383279502884;
inline constexpr double k_radians_per_degree = k_pi / 180.0;

struct SineCosine {
    double sine;
    double cosine;
};

/// Sine and cosine of an angle [rad], the same bits on every machine and in every build.
///
/// The C library leaves the last bit free, and one bit is enough to send a granular bed another way;
/// therefore only +, -, * and rounding are used here, in a fixed order. Error below 2 ulp for
/// |angle| < 1e5 rad; beyond, the reduction loses one digit for every digit of the angle.
SineCosine sine_cosine(double angle);

/// Natural logarithm of x > 0, the same bits everywhere; relative error below 4e-16.
double natural_log(double x);

/// e to the power x for |x| < 700, the same bits everywhere; relative error below 4e-16.
double exponential(double x);

/// base > 0 to any real power with |exponent x log base| < 700, the same bits everywhere; relative error below
/// 4e-16 x (1 + |exponent x log base|).
double power(double base, double exponent);

}  // namespace polargrain
