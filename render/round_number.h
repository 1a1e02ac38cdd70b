#pragma once

#include <string>
#include <vector>

namespace polargrain {

/// Least of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10 times a power of ten that is not below x > 0.
double round_up(double x);

/// Greatest of 1, 2, 5 times a power of ten that is not above x > 0: the length of a scale bar, the step of ticks.
double round_down(double x);

/// Round numbers from low to high, both included where they are round, at most `most` of them (two at least).
std::vector<double> ticks(double low, double high, int most);

/// A unit with a prefix that suits values up to `largest`: value / factor is given in `unit`.
struct ScaledUnit {
    double factor = 1.0;
    std::string unit;
};
ScaledUnit scaled_unit(double largest, const std::string& unit);

/// "5 mm", "20 cm", "1 m": a round length [m] in the unit people use for it.
std::string length_text(double length);

}  // namespace polargrain
