#include <algorithm>
#include <limits>

#include "scenarios/fill.h"

namespace polargrain {

namespace {

/// Direction towards the free side at the end `point` of a piece: halfway to its neighbour's where another piece goes
/// on there; none at a free end.
Vec2 free_side_at_end(std::span<const StartPiece> pieces, const StartPiece& end, const Vec2& point) {
    const Vec2 own = unit(left_normal(end.piece.b - end.piece.a));
    for (const StartPiece& other : pieces) {
        const bool follows = other.piece.a == point && end.piece.b == point;
        const bool precedes = other.piece.b == point && end.piece.a == point;
        if (follows || precedes) return own + unit(left_normal(other.piece.b - other.piece.a));
    }
    return Vec2::Zero();
}

}  // namespace

std::vector<StartPiece> pieces_at_start(std::span<const Wall> walls, bool settle) {
    std::vector<StartPiece> pieces;
    for (std::size_t w = 0; w < walls.size(); ++w) {
        const Wall& wall = walls[w];
        if (!wall.present(0.0) && !settle) continue;
        const WallState state = wall_state(wall, 0.0);
        for (int s = 0; s < wall.segments(); ++s) {
            const auto k = static_cast<std::size_t>(s);
            pieces.push_back({{state.point(wall.points[k]), state.point(wall.points[k + 1])}, static_cast<int>(w), s});
        }
    }
    return pieces;
}

bool behind_walls(std::span<const StartPiece> pieces, const Vec2& point) {
    double nearest = std::numeric_limits<double>::infinity();
    bool behind = false;
    for (const StartPiece& placed : pieces) {
        const auto& [a, b] = placed.piece;
        const Vec2 along = b - a;
        const double s = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
        const Vec2 foot = s == 0.0 ? a : s == 1.0 ? b : Vec2(a + s * along);
        const double distance = (point - foot).squaredNorm();
        if (!(distance < nearest)) continue;
        nearest = distance;
        const bool at_end = s == 0.0 || s == 1.0;
        const Vec2 free_side = at_end ? free_side_at_end(pieces, placed, foot) : left_normal(along);
        behind = free_side.dot(point - foot) < 0.0;
    }
    return behind;
}

}  // namespace polargrain
