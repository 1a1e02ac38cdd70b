#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scenarios/start_walls.h"
#include "src/core/vec2.h"
#include "src/geometry/pose.h"
#include "src/geometry/shape.h"

namespace polargrain {

/// A rectangle that grains are put into: knows what is there already and says whether one more fits.
///
/// A grid of cells holds every shape in each cell that it can reach, so that a question costs O(1) and the logarithm of
/// the number of wall pieces; the memory is bounded by the number of grains, however large or thin the rectangle is.
class FillSpace {
public:
    /// `count` grains of about `radius` are to come.
    FillSpace(const Vec2& lower, const Vec2& upper, const StartWalls& walls, std::size_t count, double radius);

    void add(std::shared_ptr<const Shape> shape, const Pose& pose);

    /// Clear of everything added and of the walls, in front of them, and with its bounding circle in the rectangle.
    bool fits(const Shape& shape, const Pose& pose) const;

    const Vec2& lower() const { return lower_; }
    const Vec2& upper() const { return upper_; }

private:
    struct Placed {
        std::shared_ptr<const Shape> shape;
        Pose pose;
        double radius;
    };
    struct CellRange {
        int x0, y0, x1, y1;
    };

    CellRange cells(const Vec2& low, const Vec2& high) const;
    std::size_t cell(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    }

    Vec2 lower_, upper_;
    const StartWalls* walls_;
    double cell_size_;
    int columns_, rows_;
    std::vector<Placed> placed_;
    std::vector<std::vector<int>> grains_in_cell_;
};

/// What a fill is about to place: its own stream of random numbers decides where.
struct FillGrain {
    std::shared_ptr<const Shape> shape;
    Pose pose;
    double angle = 0.0;
};

/// Names the random numbers of one fill.
struct FillKey {
    std::uint64_t seed;
    std::uint64_t fill;
};

/// Puts one grain after the other, the largest first, at a uniformly random place and angle where it fits (random
/// sequential addition).
/// Returns how many found a place: fewer than all where one of them failed k_most_tries times, or all together
/// failed too often.
std::size_t place_at_random(FillSpace& space, std::span<FillGrain> grains, const FillKey& key);

/// Puts the grains on a hexagonal lattice, as wide as the count allows, each moved at random by the room left and
/// turned at random; denser than random places can be. Returns how many found a place.
std::size_t place_on_lattice(FillSpace& space, std::span<FillGrain> grains, const FillKey& key);

}  // namespace polargrain
