#include "src/compare/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace polargrain {

namespace {

constexpr double k_same = 1e-3;
constexpr double k_most_percent = 1000.0;  ///< beyond, a ratio to a small number says nothing
constexpr int k_most_decimals = 7;

/// Two-sided 5 % point of Student's distribution for a number of degrees of freedom, rounded down.
double student_5_percent(double degrees) {
    constexpr std::array k_points{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
                                  2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086,
                                  2.080,  2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042};
    const auto whole = static_cast<std::size_t>(std::max(1.0, std::floor(degrees)));
    return whole <= k_points.size() ? k_points[whole - 1] : 2.0;
}

/// Square of the standard error of a mean.
double error_squared(const Spread& s) { return s.deviation * s.deviation / s.count; }

bool significant(const Spread& a, const Spread& b, double difference) {
    const double of_a = error_squared(a);
    const double of_b = error_squared(b);
    const double sum = of_a + of_b;
    if (sum == 0.0) return true;
    const double degrees =
        sum * sum / (of_a * of_a / std::max(1, a.count - 1) + of_b * of_b / std::max(1, b.count - 1));
    return std::abs(difference) > student_5_percent(degrees) * std::sqrt(sum);
}

std::string percent(double relative) {
    const double value = 100.0 * relative;
    if (!(std::abs(value) <= k_most_percent)) return "";
    return std::abs(value) < 10.0 ? fmt::format(" ({:+.2g} %)", value) : fmt::format(" ({:+.0f} %)", value);
}

}  // namespace

Spread spread_of(std::span<const double> values) {
    Spread spread;
    double sum = 0.0;
    for (const double v : values) {
        if (!std::isfinite(v)) continue;
        ++spread.count;
        sum += v;
    }
    if (spread.count == 0) return {0, std::numeric_limits<double>::quiet_NaN(), 0.0};
    spread.mean = sum / spread.count;
    if (spread.count == 1) return spread;
    double squares = 0.0;
    for (const double v : values) {
        if (std::isfinite(v)) squares += (v - spread.mean) * (v - spread.mean);
    }
    spread.deviation = std::sqrt(squares / (spread.count - 1));
    return spread;
}

Verdict compare_means(const Spread& reference, const Spread& other) {
    if (reference.count == 0 || other.count == 0) return {};
    Verdict verdict;
    verdict.difference = other.mean - reference.mean;
    verdict.relative = verdict.difference == 0.0 ? 0.0 : verdict.difference / std::abs(reference.mean);
    if (std::abs(verdict.relative) <= k_same) {
        verdict.agreement = Agreement::same;
    } else if (reference.count == 1 || other.count == 1) {
        verdict.agreement = Agreement::single;
    } else {
        verdict.agreement =
            significant(reference, other, verdict.difference) ? Agreement::differs : Agreement::within_spread;
    }
    return verdict;
}

std::string to_string(const Verdict& verdict, const std::string& unit) {
    const std::string by =
        fmt::format("{:+.3g}{}{}{}", verdict.difference, unit.empty() ? "" : " ", unit, percent(verdict.relative));
    switch (verdict.agreement) {
        case Agreement::same: return "the same";
        case Agreement::within_spread: return "agrees within the spread: " + by;
        case Agreement::differs: return "differs by " + by;
        case Agreement::single: return "one run only: " + by;
        case Agreement::unknown: break;
    }
    return "has no value";
}

std::string to_string(const Spread& spread) {
    if (spread.count == 0) return "-";
    if (!(spread.deviation > 0.0)) return fmt::format("{:.4g}", spread.mean);
    // Down to the second digit of the spread.
    const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(spread.deviation))));
    if (decimals > k_most_decimals) return fmt::format("{:.6g} +- {:.2g}", spread.mean, spread.deviation);
    return fmt::format("{:.{}f} +- {:.{}f}", spread.mean, decimals, spread.deviation, decimals);
}

}  // namespace polargrain
