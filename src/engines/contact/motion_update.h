#pragma once

#include <vector>

#include "src/detect/neighbours.h"
#include "src/engines/contact/transitive_closure.h"

namespace polargrain {

/// What the trial configuration of a step has shown. [HN94, Fig. 8, steps 1 and 2]
struct TrialOverlaps {
    std::vector<GrainPair> conflicts;  ///< T: pairs (a < b) whose trial poses overlap, ascending
    std::vector<MoveOrder> order;      ///< E: (a, b) where the trial pose of b overlaps the current pose of a
    std::vector<char> blocked;         ///< per grain: its trial pose overlaps a wall that it may not overlap
};

/// Decides which grains may move to their trial poses. [HN94, Fig. 8, steps 3 to 6]
///
/// Blocked grains stay. Then for each conflict in ascending order, unless one of the two stays already, the one with
/// fewer dependants stays (on a tie the lower number). A grain that stays makes all that depend on it stay, at once.
/// Guarantee: if no two current poses overlap, no two poses overlap afterwards.
class MotionUpdate {
public:
    /// Per grain: 1 where the trial pose is rejected. Valid until the next call.
    const std::vector<char>& decide(const TrialOverlaps& found);

    /// The counts of the last decide(), for reports and tests.
    int dependants(GrainIndex a) { return reach_.dependants(a); }

private:
    void reject_with_dependants(GrainIndex a);

    ReachCount reach_;
    std::vector<char> rejected_;
    std::vector<GrainIndex> queue_;
};

}  // namespace polargrain
