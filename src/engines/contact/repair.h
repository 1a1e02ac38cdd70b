#pragma once

#include <vector>

#include "src/engines/contact/by_grain.h"
#include "src/engines/contact/gap_detection.h"

namespace polargrain {

/// Pushes apart the few grains whose trial poses still overlap, with their neighbours giving way.
///
/// What linear gaps cannot foresee (a vertex sliding over a re-entrant corner, a fast turn) leaves a handful of
/// overlapping pairs in thousands of grains. Rejecting them would reject all that depend on them; moving them a
/// fraction of the resting gap costs nothing of note. Each pass solves on the actual gaps of the overlapping grains and
/// of a ring of neighbours that grows from pass to pass, then detects the moved grains again.
class Repair {
public:
    static constexpr int k_passes = 12;
    static constexpr int k_sweeps = 20;
    static constexpr double k_part = 0.3;  ///< of the resting gap: what overlapping pairs are opened to
    static constexpr double k_near = 5.0;  ///< gaps beyond this many resting gaps cannot get in the way
    static constexpr double k_ring = 1.2;  ///< neighbours through contacts nearer than this many resting gaps

    /// Returns the number of overlapping pairs that are left.
    int run(GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& before, PoseSet& trial);

private:
    void choose_grains(const GapDetection& detection, int rings);
    void solve(const GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& trial);
    void collect_rows(const GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& trial);
    void add_row(std::int32_t contact, const GapDetection& detection, const std::vector<SolverBody>& bodies,
                 const PoseSet& trial);

    /// Only chosen grains give way; the others stand like walls.
    bool gives_way(BodyIndex body) const { return !is_wall(body) && chosen_[Grains::at(body)]; }

    struct Row {
        std::int32_t contact;
        double aim, arm_ni, arm_nj, mass, push;
    };
    std::vector<char> chosen_;
    std::vector<GrainIndex> edge_, next_edge_;  ///< grains chosen last
    ByGrain by_grain_;                          ///< pairs
    std::vector<Row> rows_;
    std::vector<Vec2> way_;
    std::vector<double> turn_;
};

}  // namespace polargrain
