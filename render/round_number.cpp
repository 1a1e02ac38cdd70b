#include "render/round_number.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace polargrain {

namespace {

double power_of_ten_below(double x) { return std::pow(10.0, std::floor(std::log10(x))); }

}  // namespace

double round_up(double x) {
    constexpr std::array<double, 10> k_round = {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0};
    const double power = power_of_ten_below(x);
    for (const double candidate : k_round) {
        // What is round already must not be pushed on by the last bit.
        if (candidate * power >= x * (1.0 - 1e-12)) return candidate * power;
    }
    return 10.0 * power;
}

double round_down(double x) {
    const double power = power_of_ten_below(x);
    for (const double candidate : {5.0, 2.0}) {
        if (candidate * power <= x * (1.0 + 1e-12)) return candidate * power;
    }
    return power;
}

std::vector<double> ticks(double low, double high, int most) {
    if (!(high > low)) return {low};
    double step = round_down((high - low) / most);
    while ((high - low) / step > most - 1 + 1e-9) step = round_down(2.5 * step);
    std::vector<double> values;
    const auto first = static_cast<long>(std::ceil(low / step - 1e-9));
    const auto last = static_cast<long>(std::floor(high / step + 1e-9));
    for (long k = first; k <= last; ++k) values.push_back(static_cast<double>(k) * step);
    return values;
}

ScaledUnit scaled_unit(double largest, const std::string& unit) {
    if (largest >= 1e4) return {1e3, "k" + unit};
    if (largest >= 0.1 || largest <= 0.0) return {1.0, unit};
    if (largest >= 1e-4) return {1e-3, "m" + unit};
    return {1e-6, "\u00b5" + unit};
}

std::string length_text(double length) {
    struct Unit {
        double metres;
        const char* name;
    };
    constexpr std::array<Unit, 4> k_units = {{{1.0, "m"}, {1e-2, "cm"}, {1e-3, "mm"}, {1e-6, "\u00b5m"}}};
    for (const Unit& unit : k_units) {
        if (length >= unit.metres * (1.0 - 1e-12)) return fmt::format("{:.4g} {}", length / unit.metres, unit.name);
    }
    return fmt::format("{:.4g} {}", length / k_units.back().metres, k_units.back().name);
}

}  // namespace polargrain
