#include "src/engines/dem/soft_walls.h"

#include <cmath>

#include "src/detect/wall_pieces.h"

namespace polargrain {

namespace {

/// Sine of the largest bend at which two pieces count as one.
constexpr double k_straight = 1e-9;

bool go_on_straight(const Vec2& first, const Vec2& second) {
    return std::abs(cross(first, second)) <= k_straight * std::sqrt(first.squaredNorm() * second.squaredNorm()) &&
           first.dot(second) > 0.0;
}

}  // namespace

SoftWalls::SoftWalls(const Scene& scene) : scene_(scene) {
    for (int w = static_cast<int>(scene.walls.size()) - 1; w >= 0; --w) {
        any_moves_ = any_moves_ || scene.walls[static_cast<std::size_t>(w)].moves();
        enter(w);
    }
    present_.assign(scene.walls.size(), 0);
    now_.assign(scene.walls.size(), Motion{});
    motions_ = now_;
    ways_.assign(scene.walls.size(), Way{});
}

void SoftWalls::enter(int wall) {
    const Wall& source = scene_.walls[static_cast<std::size_t>(wall)];
    const std::vector<Vec2>& points = source.points;
    std::vector<Vec2> corners;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const bool inside = k > 0 && k + 1 < points.size();
        if (inside && go_on_straight(points[k] - points[k - 1], points[k + 1] - points[k])) continue;
        corners.push_back(points[k]);
    }
    const auto first = static_cast<int>(pieces_.size());
    const auto count = static_cast<int>(corners.size()) - 1;
    const bool closed = source.closed();
    for (int k = 0; k < count; ++k) {
        SoftPiece piece;
        piece.wall = wall;
        piece.before = k > 0 ? first + k - 1 : (closed ? first + count - 1 : -1);
        piece.after = k + 1 < count ? first + k + 1 : (closed ? first : -1);
        pieces_.push_back(piece);
        const auto at = static_cast<std::size_t>(k);
        rest_.push_back({corners[at], corners[at + 1]});
    }
}

void SoftWalls::place(double time) {
    for (std::size_t w = 0; w < scene_.walls.size(); ++w) present_[w] = scene_.walls[w].present(time) ? 1 : 0;
    if (placed_ && !any_moves_) return;
    placed_ = true;
    std::vector<WallState> states;
    for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
        const Wall& wall = scene_.walls[w];
        states.push_back(wall_state(wall, time));
        const Motion before = now_[w];
        now_[w] = wall_motion(states[w]);
        const bool jumps = starts_or_ends(wall, time, 2.0 * step_);
        motions_[w] = jumps ? wall_motion(wall_state_over(wall, time, 2.0 * step_)) : now_[w];
        ways_[w] = way_of(wall, before, now_[w], time);
    }
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
        SoftPiece& piece = pieces_[k];
        const WallState& state = states[static_cast<std::size_t>(piece.wall)];
        piece.a = state.point(rest_[k].a);
        piece.b = state.point(rest_[k].b);
        piece.length = std::sqrt((piece.b - piece.a).squaredNorm());
        piece.along = (piece.b - piece.a) / piece.length;
    }
}

SoftWalls::Way SoftWalls::way_of(const Wall& wall, const Motion& before, const Motion& now, double time) const {
    constexpr double k_wider = 1.5;  // velocities at the ends of the step are not to be trusted near a jump either
    const double middle = time - 0.5 * step_;
    if (!starts_or_ends(wall, middle, k_wider * step_)) return {before, now};
    const Motion mean = wall_motion(wall_state_over(wall, middle, step_));
    return {mean, mean};
}

ChainTouch touch_chain(const std::vector<SoftPiece>& pieces, std::size_t k, const Vec2& centre) {
    const SoftPiece& piece = pieces[k];
    const double station = piece.along.dot(centre - piece.a);
    if (station >= 0.0 && station < piece.length) return {true, piece.a + station * piece.along};
    if (station >= piece.length) return {piece.after < 0, piece.b};
    if (piece.before < 0) return {true, piece.a};
    const SoftPiece& before = pieces[static_cast<std::size_t>(piece.before)];
    return {before.along.dot(centre - before.a) >= before.length, piece.a};
}

}  // namespace polargrain
