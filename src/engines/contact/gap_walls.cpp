#include "src/engines/contact/gap_walls.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

Joint joint_between(const Vec2& before, const Vec2& at, const Vec2& after) {
    const Vec2 in = unit(at - before);
    const Vec2 out = unit(after - at);
    const double turn = cross(in, out);
    constexpr double k_straight = 1e-9;
    if (std::abs(turn) < k_straight && in.dot(out) > 0.0) return Joint::straight;
    return turn > 0.0 ? Joint::left_turn : Joint::right_turn;
}

}  // namespace

GapWalls::GapWalls(const Scene& scene) : scene_(scene) {
    for (const Wall& wall : scene.walls) {
        any_moves_ = any_moves_ || wall.moves();
        speed_.push_back(largest_speed(wall));
        top_speed_ = std::max(top_speed_, speed_.back());
        find_joints(wall);
    }
}

void GapWalls::find_joints(const Wall& wall) {
    const std::vector<Vec2>& p = wall.points;
    const std::size_t last = p.size() - 1;
    std::vector<Ends> ends(last, {Joint::free_end, Joint::free_end});
    for (std::size_t k = 0; k < last; ++k) {
        if (k > 0 || wall.closed()) ends[k].at_a = joint_between(k > 0 ? p[k - 1] : p[last - 1], p[k], p[k + 1]);
        if (k + 1 < last || wall.closed()) ends[k].at_b = joint_between(p[k], p[k + 1], k + 1 < last ? p[k + 2] : p[1]);
    }
    joints_.push_back(std::move(ends));
}

/// Are the same walls there as when this was asked last?
bool GapWalls::same_presence(double time) {
    bool same = present_.size() == scene_.walls.size();
    present_.resize(scene_.walls.size(), 0);
    for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
        const char there = scene_.walls[w].present(time) ? 1 : 0;
        same = same && present_[w] == there;
        present_[w] = there;
    }
    return same;
}

void GapWalls::place(double time_before, double time_now) {
    if (same_presence(time_now) && !any_moves_) return;
    placed_.clear();
    pieces_.clear();
    for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
        if (present_[w]) place(static_cast<int>(w), time_before, time_now);
    }
    link();
    search_.place(placed_);
}

/// Tells every piece its neighbours along the chain.
void GapWalls::link() {
    for (std::size_t first = 0; first < pieces_.size();) {
        const Wall& wall = scene_.walls[static_cast<std::size_t>(placed_[first].wall)];
        const auto count = static_cast<std::size_t>(wall.segments());
        for (std::size_t k = 0; k < count; ++k) {
            GapPiece& piece = pieces_[first + k];
            if (k > 0 || wall.closed()) piece.previous = &pieces_[first + (k > 0 ? k : count) - 1];
            if (k + 1 < count || wall.closed()) piece.next = &pieces_[first + (k + 1 < count ? k + 1 : 0)];
        }
        first += count;
    }
}

void GapWalls::place(int number, double time_before, double time_now) {
    const auto w = static_cast<std::size_t>(number);
    const Wall& wall = scene_.walls[w];
    const WallState now = wall_state(wall, time_now);
    const WallState before = wall_state(wall, time_before);
    const std::size_t first = placed_.size();
    add_pieces(wall, number, now, placed_);
    const std::size_t count = placed_.size() - first;
    for (std::size_t k = 0; k < count; ++k) {
        GapPiece piece;
        piece.one_sided = wall.moves();
        piece.now = placed_[first + k].piece;
        piece.before = {before.point(wall.points[k]), before.point(wall.points[k + 1])};
        piece.at_a = joints_[w][k].at_a;
        piece.at_b = joints_[w][k].at_b;
        pieces_.push_back(piece);
    }
}

}  // namespace polargrain
