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

/// Spearman's coefficient of rank correlation, 1 for the same order and -1 for the opposite one; equal values share the
/// mean of their ranks. Pairs with a value that is not finite are left out; NaN where fewer than two are left or either
/// column has one value only. Both columns are equally long.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

/// Counts of the values in equal bins, as bars over the middles of the bins; values outside are left out.
Series histogram(const std::vector<double>& values, double low, double high, int bins, const std::string& label,
                 int colour);

}  // namespace polargrain
