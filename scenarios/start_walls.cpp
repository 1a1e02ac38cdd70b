#include "scenarios/start_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polargrain {

StartWalls::StartWalls(std::span<const Wall> walls, bool settle) {
    for (std::size_t w = 0; w < walls.size(); ++w) {
        if (!walls[w].present(0.0) && !settle) continue;
        add_pieces(walls[w], static_cast<int>(w), wall_state(walls[w], 0.0), pieces_);
    }
    for (const PlacedPiece& placed : pieces_) {
        const auto& [a, b] = placed.piece;
        extent_ = std::max({extent_, a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()});
    }
    search_.place(pieces_);
}

std::optional<std::int32_t> StartWalls::overlapped(const Shape& grain, const Pose& pose) const {
    std::optional<std::int32_t> first;
    search_.any_near(pose.centre, outer_radius(grain), [&](std::int32_t number) {
        if ((!first || number < *first) && overlap(grain, pose, piece(number).piece)) first = number;
        return false;
    });
    return first;
}

bool StartWalls::behind(const Vec2& point, double guess) const {
    // All is within the last reach.
    const double farthest = 2.0 * std::sqrt(2.0) * std::max(extent_, point.cwiseAbs().maxCoeff());
    std::vector<std::int32_t> near;
    for (double reach = guess;; reach *= 4.0) {
        search_.find(point, reach, near);
        const Nearest nearest = nearest_of(near, point);
        const Vec2 way = point - nearest.foot;
        if (!(way.squaredNorm() <= reach * reach) && reach <= farthest) continue;
        return nearest.piece && free_side(near, *nearest.piece, nearest.foot).dot(way) < 0.0;
    }
}

/// Of several as near as one another, the first.
StartWalls::Nearest StartWalls::nearest_of(std::span<const std::int32_t> near, const Vec2& point) const {
    Nearest nearest{std::nullopt, Vec2::Constant(std::numeric_limits<double>::infinity())};
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t number : near) {
        const auto& [a, b] = piece(number).piece;
        const Vec2 along = b - a;
        const double s = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
        const Vec2 foot = s == 0.0 ? a : s == 1.0 ? b : Vec2(a + s * along);
        const double distance = (point - foot).squaredNorm();
        if (!(distance < least)) continue;
        least = distance;
        nearest = {number, foot};
    }
    return nearest;
}

/// Direction towards the free side at a point of a piece; at an end of it, halfway to its neighbour's where another
/// piece goes on there, and none at a free end. The neighbour is as near as the point, and so among those that are
/// near.
Vec2 StartWalls::free_side(std::span<const std::int32_t> near, std::int32_t number, const Vec2& point) const {
    const auto& [from, to] = piece(number).piece;
    if (point != from && point != to) return left_normal(to - from);
    for (const std::int32_t other : near) {
        const auto& [a, b] = piece(other).piece;
        const bool follows = a == point && to == point;
        const bool precedes = b == point && from == point;
        if (follows || precedes) return unit(left_normal(to - from)) + unit(left_normal(b - a));
    }
    return Vec2::Zero();
}

}  // namespace polargrain
