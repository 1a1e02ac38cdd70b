#pragma once

#include <cstdint>
#include <vector>

#include "src/detect/gap_points.h"
#include "src/detect/wall_search.h"
#include "src/model/scene.h"

namespace polargrain {

/// The pieces of the walls that are there, as grains near them see them, and which of them are near.
///
/// Pieces are numbered in order of wall and segment; as long as no wall goes, they keep their numbers.
class GapWalls {
public:
    explicit GapWalls(const Scene& scene);
    GapWalls(const GapWalls&) = delete;  // pieces point to their neighbours
    GapWalls& operator=(const GapWalls&) = delete;

    /// Puts pieces where they are at a time [s], and remembers where they were at another.
    void place(double time_before, double time_now);

    std::size_t size() const { return pieces_.size(); }
    int wall(std::int32_t piece) const { return placed_[static_cast<std::size_t>(piece)].wall; }
    const GapPiece& geometry(std::int32_t piece) const { return pieces_[static_cast<std::size_t>(piece)]; }
    /// Largest speed that any point of the piece's wall ever has, and of all walls [m/s].
    double speed(std::int32_t piece) const { return speed_[static_cast<std::size_t>(wall(piece))]; }
    double top_speed() const { return top_speed_; }

    const WallSearch& search() const { return search_; }

private:
    struct Ends {
        Joint at_a, at_b;
    };

    void find_joints(const Wall& wall);
    bool same_presence(double time);
    void place(int number, double time_before, double time_now);
    void link();

    const Scene& scene_;
    bool any_moves_ = false;
    std::vector<double> speed_;
    double top_speed_ = 0.0;
    std::vector<std::vector<Ends>> joints_;  ///< of each wall: motion does not change them
    std::vector<char> present_;
    std::vector<PlacedPiece> placed_;
    std::vector<GapPiece> pieces_;
    WallSearch search_;
};

}  // namespace polargrain
