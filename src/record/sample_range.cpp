#include "src/record/sample_range.h"

#include <algorithm>

namespace polargrain {

namespace {

constexpr double k_rounding = 1e-3;  ///< of an interval or a step
/// With longer steps than this share of the interval, a sample that is late for one time is early for another.
constexpr double k_short_step = 0.5;

}  // namespace

SampleRange samples_between(std::span<const double> times, double from, double to, double time_step) {
    if (times.empty()) return {};
    const double count = static_cast<double>(times.size());
    const double interval = times.size() > 1 ? (times.back() - times.front()) / (count - 1.0) : time_step;
    const double tolerance = k_rounding * interval;
    const double late = time_step < k_short_step * interval ? (1.0 - k_rounding) * time_step : 0.0;
    const auto first = std::ranges::lower_bound(times, from - tolerance);
    const auto last = std::ranges::upper_bound(times, to + std::max(late, tolerance));
    return {static_cast<std::size_t>(first - times.begin()),
            static_cast<std::size_t>(std::max(first, last) - times.begin())};
}

}  // namespace polargrain
