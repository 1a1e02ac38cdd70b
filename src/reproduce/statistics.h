#pragma once

#include <string>
#include <vector>

#include "src/plot/plot.h"

namespace polargrain {

struct MeanSpread {
    double mean = 0.0;
    double spread = 0.0;  ///< standard deviation of the sample (n - 1); zero for one value
};

/// Of the values that are finite; NaN where there is none.
MeanSpread mean_and_spread(const std::vector<double>& values);

/// Counts of the values in equal bins, as bars over the middles of the bins; values outside are left out.
Series histogram(const std::vector<double>& values, double low, double high, int bins, const std::string& label,
                 int colour);

}  // namespace polargrain
