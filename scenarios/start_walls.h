#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/detect/wall_search.h"
#include "src/geometry/pose.h"
#include "src/geometry/shape.h"

namespace polargrain {

/// Where the pieces of all walls are before the first step: of those present at time zero, and with `settle` of those,
/// too, that are removed at time zero.
class StartWalls {
public:
    StartWalls(std::span<const Wall> walls, bool settle);

    const PlacedPiece& piece(std::int32_t number) const { return pieces_[static_cast<std::size_t>(number)]; }

    /// The number of the first piece that a grain overlaps.
    std::optional<std::int32_t> overlapped(const Shape& grain, const Pose& pose) const;

    /// True where the nearest piece has its free side turned away from the point: the inside of a wall. Beyond the end
    /// of an open chain nothing is behind. Quickest where a piece is within `guess` [m].
    bool behind(const Vec2& point, double guess) const;

private:
    /// The piece nearest to a point, and which point of it.
    struct Nearest {
        std::optional<std::int32_t> piece;
        Vec2 foot;
    };
    Nearest nearest_of(std::span<const std::int32_t> near, const Vec2& point) const;
    Vec2 free_side(std::span<const std::int32_t> near, std::int32_t number, const Vec2& point) const;

    std::vector<PlacedPiece> pieces_;
    WallSearch search_;
    double extent_ = 0.0;  ///< no coordinate of a piece is larger [m]
};

}  // namespace polargrain
