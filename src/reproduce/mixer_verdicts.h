#pragma once

#include <array>
#include <string>
#include <vector>

#include "src/reproduce/finding.h"
#include "src/reproduce/mixer_runs.h"
#include "src/reproduce/statistics.h"

namespace polargrain {

/// A value for each set, A to H.
using MixerRow = std::array<double, k_mixer_sets.size()>;

/// Something that is measured of each set, and in which order [K02] finds the sets by it.
struct MixerQuantity {
    std::string name;    ///< with its unit
    std::string column;  ///< of the CSV file
    double (*of)(const MixerRun& run);
    /// From least to most, as far as the words of [K02] tell the sets apart; NaN where they say nothing of one.
    MixerRow order;
    std::string words;         ///< of [K02], in short
    std::string why_not = {};  ///< where the order is another here
};

const std::vector<MixerQuantity>& mixer_quantities();

/// How far the speeds lie from the measured ones, from near to far, A left out: the agreement in [K02, sec. 4.2] is
/// B ~ A ~ F > C ~ D > E > H ~ G. We hold the speeds to those of set A, which says nothing of A itself.
const MixerRow& mixer_speed_order();

MeanSpread over_seeds(const MixerSetRuns& set, double (*of)(const MixerRun& run));
/// Means over the seeds, A to H.
MixerRow means_of_sets(const std::vector<MixerSetRuns>& sets, double (*of)(const MixerRun& run));
/// Of the speeds of each set from those of A, see speed_difference; for A itself that between its first and last seed.
MixerRow speed_differences(const std::vector<MixerSetRuns>& sets);
/// See rank_correlation: sets of which either says nothing are left out.
double same_order(const MixerRow& a, const MixerRow& b);

/// Everything that is held to [K02].
std::vector<Finding> mixer_findings(const std::vector<MixerSetRuns>& sets);

}  // namespace polargrain
