#pragma once

#include <cstddef>
#include <span>

namespace polargrain {

/// Samples first to last - 1; none where the two are equal.
struct SampleRange {
    std::size_t first = 0, last = 0;
};

/// The samples from time `from` to time `to` [s], both included. times: of all samples, in ascending order.
///
/// A time that is off by rounding, up to a thousandth of the mean interval between samples, is still in between. So is
/// a sample that was due at `to`, and was taken at the first step after it: up to a time step [s] late, where that is
/// short against the interval. time_step: zero where it is not known.
SampleRange samples_between(std::span<const double> times, double from, double to, double time_step);

}  // namespace polargrain
