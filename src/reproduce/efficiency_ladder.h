#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/reproduce/statistics.h"

namespace polargrain {

/// What the runs of one engine with one time step have given: the same scene from several beginnings.
struct Rung {
    std::string label;           ///< the step, as a table shows it
    std::vector<double> values;  ///< of the observable, one for each run
    std::vector<double> costs;   ///< processor time per simulated second, one for each run
};

/// The value that refinement leads to, and how well it is known.
struct ConvergedValue {
    double value = 0.0;
    double uncertainty = 0.0;  ///< half the difference of the methods that it is taken from, or its standard error
};

/// Where a rung stands in a plot of error over cost.
struct RungResult {
    std::string label;
    double cost = 0.0;  ///< mean over the runs
    double value = 0.0, spread = 0.0;
    double error = 0.0;        ///< |mean - converged| / converged; NaN where no run has a value
    double uncertainty = 0.0;  ///< standard error of the mean / converged
};

/// Mean of the finest rungs of several methods. The uncertainty is the larger of their half range and of the standard
/// error of that mean.
ConvergedValue converged_value(const std::vector<Rung>& finest);

RungResult rung_result(const Rung& rung, const ConvergedValue& converged);

/// The cheapest rung of a ladder, coarse to fine, that is right and stays right: its error and those of all finer rungs
/// are at most the tolerance. So a coarse step that is right by chance does not count.
std::optional<RungResult> cheapest_right(const std::vector<RungResult>& ladder, double tolerance);

}  // namespace polargrain
