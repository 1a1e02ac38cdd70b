#include "src/detect/wall_run.h"

#include <algorithm>

namespace polargrain {

namespace {

constexpr std::ptrdiff_t k_longest_run = 32;
/// Sine of a bend that is none.
constexpr double k_straight = 1e-9;

/// Corners of a chain; round and round where it is closed.
struct Corners {
    const std::vector<Vec2>& chain;
    bool closed;
    std::ptrdiff_t pieces;

    bool has(std::ptrdiff_t k) const { return closed || (k >= 0 && k <= pieces); }
    const Vec2& at(std::ptrdiff_t k) const {
        return chain[static_cast<std::size_t>(closed ? ((k % pieces) + pieces) % pieces : k)];
    }
};

/// How far the line of the piece from corner k to k + 1 bounds the free space on a side (+1 left) past its end in a
/// direction along the chain (+1 or -1) [m].
double run_past(const Corners& corners, std::ptrdiff_t k, std::ptrdiff_t direction, double side) {
    const Vec2 along = unit(corners.at(k + 1) - corners.at(k));
    const std::ptrdiff_t end = direction > 0 ? k + 1 : k;
    Vec2 last = along;
    double farthest = 0.0;
    for (std::ptrdiff_t n = 1; n <= std::min(k_longest_run, corners.pieces - 1); ++n) {
        const std::ptrdiff_t next = end + direction * n;
        if (!corners.has(next)) break;
        const Vec2 way = static_cast<double>(direction) * unit(corners.at(next) - corners.at(next - direction));
        const double bend = static_cast<double>(direction) * side * cross(last, way);
        if (bend <= k_straight || way.dot(along) <= 0.0) break;
        farthest = static_cast<double>(direction) * along.dot(corners.at(next) - corners.at(end));
        last = way;
    }
    return farthest;
}

}  // namespace

WallRun run_of_piece(const std::vector<Vec2>& chain, bool closed, std::size_t k) {
    const Corners corners{chain, closed, static_cast<std::ptrdiff_t>(chain.size()) - 1};
    const auto piece = static_cast<std::ptrdiff_t>(k);
    return {run_past(corners, piece, -1, 1.0), run_past(corners, piece, 1, 1.0), run_past(corners, piece, -1, -1.0),
            run_past(corners, piece, 1, -1.0)};
}

}  // namespace polargrain
