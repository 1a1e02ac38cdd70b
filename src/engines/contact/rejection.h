#pragma once

#include <vector>

#include "src/engines/contact/gap_detection.h"
#include "src/engines/contact/motion_update.h"

namespace polargrain {

/// The guarantee: grains whose trial poses still overlap stay where they were, by the rule of 1994.
///
/// Of each overlapping pair the grain with fewer dependants stays, with all that depend on it; grains that overlap a
/// wall stay first [HN94, Fig. 8]. The dependency graph is only built when something overlaps. A grain that stays is
/// stopped: with the velocity that it could not follow, it would press on its neighbours, and be rejected, again.
class Rejection {
public:
    static constexpr int k_rounds = 5;

    explicit Rejection(const Scene& scene) : scene_(scene) {}

    /// Returns the number of rejected grains; trial poses of those are set back to `before`.
    int run(GapDetection& detection, const PoseSet& before, PoseSet& trial, std::vector<SolverBody>& bodies);

private:
    void find(const GapDetection& detection, const PoseSet& before, const PoseSet& trial);

    const Scene& scene_;
    TrialOverlaps found_;
    MotionUpdate update_;
    std::vector<char> rejected_;
};

}  // namespace polargrain
