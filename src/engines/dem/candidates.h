#pragma once

#include <span>
#include <vector>

#include "src/detect/wall_search.h"
#include "src/engines/dem/numbering.h"
#include "src/engines/dem/pair_search.h"
#include "src/engines/dem/soft_walls.h"

namespace polargrain {

/// A grain and a wall piece that may touch.
struct WallCandidate {
    std::int32_t piece;
    GrainIndex grain;
};

/// What may touch what, kept over several steps where the search is a Verlet list and found anew every step otherwise.
class Candidates {
public:
    Candidates(const Scene& scene, const DemSettings& settings);

    /// Which grain of the scene stands at each place; the lists are made anew.
    void renumber(const Numbering& numbers);

    /// Brings the lists up to date for grains at (x[3k], x[3k + 1]) and walls as placed.
    void update(std::span<const double> x, const SoftWalls& walls);

    const std::vector<GrainPair>& pairs() const { return pairs_; }  ///< ascending
    /// Ascending in (BodyIndex of the wall, grain).
    const std::vector<WallCandidate>& at_walls() const { return at_walls_; }

private:
    bool still_good(std::span<const double> x, const SoftWalls& walls) const;
    void rebuild(std::span<const double> x, const SoftWalls& walls);
    void find_at_walls(const std::vector<SoftPiece>& pieces);

    const Scene& scene_;
    PairFinder finder_;
    double skin_;  ///< margin over a grain's radius
    std::vector<double> radii_;
    std::vector<double> margin_;  ///< of each grain [m]
    double least_margin_ = 0.0;
    bool built_ = false;
    std::vector<double> built_at_;
    std::vector<Vec2> walls_at_;
    std::vector<BoundingCircle> circles_;
    std::vector<GrainPair> pairs_;
    WallSearch wall_search_;
    std::vector<PlacedPiece> placed_;
    std::vector<std::int32_t> near_;
    std::vector<WallCandidate> at_walls_;
};

}  // namespace polargrain
