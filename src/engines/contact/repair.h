#pragma once

#include <vector>

#include "src/core/parallel.h"
#include "src/engines/contact/by_grain.h"
#include "src/engines/contact/gap_detection.h"
#include "src/engines/contact/gap_opening.h"

namespace polargrain {

/// Pushes apart the few grains whose trial poses still overlap, with their neighbours giving way.
///
/// What linear gaps cannot foresee (a vertex sliding over a re-entrant corner, a fast turn) leaves a handful of
/// overlapping pairs in thousands of grains. Rejecting them would reject all that depend on them; moving them a
/// fraction of the resting gap costs nothing of note. Each pass solves on the actual gaps of the overlapping grains and
/// of a ring of neighbours that grows from pass to pass, then detects the moved grains again. Grains that are not
/// connected through others are solved apart, on several threads.
class Repair {
public:
    static constexpr int k_passes = 12;
    static constexpr int k_sweeps = 60;
    static constexpr int k_few_sweeps = 20;  ///< in a bed that settles: rows that fill a box would lock under stress
    // Gaps that repair asks for, in resting gaps. A pair left at no gap at all overlaps again with the next shift of a
    // neighbour, by what the linear gaps miss.
    static constexpr double k_tight = 0.05;  ///< a pair nearer than this is opened
    static constexpr double k_opened = 0.3;  ///< to this
    static constexpr double k_least = 0.1;   ///< others may close to this
    static constexpr double k_near = 5.0;    ///< gaps beyond this many resting gaps cannot get in the way
    static constexpr double k_ring = 1.2;    ///< neighbours through contacts nearer than this many resting gaps

    explicit Repair(const Scene& scene);

    /// Takes up to so many sweeps in a pass. Returns the number of overlapping pairs that are left.
    int run(GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& before, PoseSet& trial,
            int sweeps);

private:
    void choose_grains(const GapDetection& detection, int rings);
    void choose(BodyIndex body);
    void solve(const GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& trial, int sweeps);
    void collect_rows(const GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& trial);
    void add_row(const PairContacts& pair, const GapPoint& p, double resting, const std::vector<SolverBody>& bodies,
                 const PoseSet& trial);
    void part_islands();
    GrainIndex root_of(GrainIndex grain);
    void move_chosen(PoseSet& trial);

    /// Only chosen grains give way; the others stand like walls.
    bool gives_way(BodyIndex body) const { return !is_wall(body) && chosen_[Grains::at(body)]; }

    /// Rows that share no grain with those of others.
    struct Island {
        std::size_t first, last;
    };
    void solve_island(const Island& island, int sweeps);

    Parallel parallel_;
    std::vector<char> chosen_;
    std::vector<GrainIndex> grains_;  ///< chosen, in rings
    ByGrain by_grain_;                ///< pairs
    std::vector<std::int32_t> chosen_pairs_;
    std::vector<GapOpening> rows_, sorted_;
    std::vector<GrainIndex> parent_;       ///< towards the grain that stands for the island
    std::vector<std::int32_t> island_of_;  ///< of such a grain
    std::vector<Island> islands_;
    std::vector<Shift> shift_;
};

}  // namespace polargrain
