#pragma once

#include <vector>

#include "src/core/parallel.h"
#include "src/detect/neighbours.h"
#include "src/model/scene.h"

namespace polargrain {

/// Pairs of grains that may touch, kept over several steps (a Verlet list).
///
/// Each grain gets a margin of k_margin of its radius, or of k_ways_ahead times its way in a step; the pairs of a grain
/// that has moved farther than its margin are found anew, or all, where many have. A pair that is not listed cannot
/// touch. What is listed beyond that never changes a result.
class PairList {
public:
    /// For the grains of a scene.
    explicit PairList(const Scene& scene);

    /// radii [m]: outer radii, one per grain.
    explicit PairList(std::vector<double> radii);

    /// Brings the list up to date for grains that may be anywhere on the way from `from` to `to`; true if it has
    /// changed. All pairs whose circles meet at either end are listed afterwards.
    bool update(std::span<const Pose> from, std::span<const Pose> to) { return update(from, to, {}); }

    /// The same for grains that want to know of others within a clearance [m] about them; one per grain, or none.
    bool update(std::span<const Pose> from, std::span<const Pose> to, std::span<const double> clearance);

    const std::vector<GrainPair>& pairs() const { return pairs_; }
    double radius(GrainIndex k) const { return radii_[Grains::at(k)]; }

private:
    static constexpr double k_margin = 0.2;
    static constexpr double k_ways_ahead = 4.0;
    static constexpr std::size_t k_few = 32;  ///< at most one grain in so many is few

    void find_left(std::span<const Pose> from, std::span<const Pose> to, std::span<const double> clearance);
    void draw_circle(std::span<const Pose> from, std::span<const Pose> to, std::span<const double> clearance,
                     std::size_t k);

    Parallel parallel_;
    std::vector<double> radii_;
    std::vector<Vec2> built_at_;
    std::vector<double> margin_;  ///< of the list as it was made [m]
    NeighbourSearch search_;
    std::vector<BoundingCircle> circles_;
    std::vector<char> has_left_;    ///< of a grain: its margin
    std::vector<GrainIndex> left_;  ///< those that have
    std::vector<GrainPair> pairs_;
};

}  // namespace polargrain
