#include <algorithm>
#include <cmath>
#include <optional>

#include "src/detect/edge_gaps.h"
#include "src/detect/gap_reduction.h"

namespace polargrain {

namespace {

/// A point as seen from a wall piece: signed distance from its line, positive on its left, and station along it.
struct OverPiece {
    double height;
    double station;
    double length;
    bool within() const { return station >= 0.0 && station <= length; }
};

/// The straight line of a wall piece.
struct PieceLine {
    Vec2 a, along;
    double length;
    Vec2 left;

    explicit PieceLine(const WallPiece& piece)
        : a(piece.a),
          along(piece.b - piece.a),
          length(std::sqrt(along.squaredNorm())),
          left(left_normal(along) / length) {}

    OverPiece over(const Vec2& p) const { return {left.dot(p - a), along.dot(p - a) / length, length}; }
};

/// Side of the piece (+1 left, -1 right) that a point belongs to (the left, where a moving wall has run over the
/// grain), and whether it has gone through since `before`. A point that was on the line, or all but, belongs to the
/// side of the grain's centre, home_side.
struct Side {
    double sign;
    bool through;

    /// Out of the piece, towards where the point belongs.
    Vec2 normal(const PieceLine& line) const { return sign > 0.0 ? line.left : Vec2(-line.left); }
    /// Of the point over the piece along that normal: negative where it has gone through [m].
    double height(const OverPiece& now) const { return through ? -std::abs(now.height) : std::abs(now.height); }
};

Side side_of(const OverPiece& now, const OverPiece& before, double home_side, double radius, bool overrun) {
    // Of the outer radius. A pose counts as free while the piece reaches less than k_touch_tolerance into the grain,
    // measured from its edges; the tip of a vertex may then be many times farther behind.
    constexpr double k_on_the_line = 1e-6;
    if (overrun) return {1.0, now.height < 0.0};
    const double was = std::abs(before.height) > k_on_the_line * radius ? before.height : home_side;
    if ((was > 0.0) == (now.height > 0.0) || now.height == 0.0) return {now.height == 0.0 ? was : now.height, false};
    // The signs differ: it went through the piece, or round one of its ends.
    const double part = std::clamp(before.height / (before.height - now.height), 0.0, 1.0);
    const double station = before.station + part * (now.station - before.station);
    const bool through = station >= 0.0 && station <= now.length;
    return {through ? was : now.height, through};
}

/// The side of the piece on which p is, over the piece or where its line bounds the free space past an end; none
/// elsewhere.
std::optional<Side> side_of_piece(const GapPiece& piece, const Vec2& p, const OverPiece& now, const OverPiece& before,
                                  double home_side, double radius, bool overrun) {
    if (now.within()) return side_of(now, before, home_side, radius, overrun);
    if (piece.bounds_past_end(p)) return Side{now.height, false};
    return {};
}

/// Can a point that stands on a side of the chain (+1 left) get round its end or joint?
bool bounds(Joint joint, double side) {
    switch (joint) {
        case Joint::free_end: return true;
        case Joint::straight: return false;
        case Joint::left_turn: return side < 0.0;
        case Joint::right_turn: return side > 0.0;
    }
    return true;
}

void wall_vertex_points(const PolarPolygon& grain, const Pose& pose, const Pose& pose_before, const GapPiece& piece,
                        bool overrun, const GapRules& rules, std::vector<GapPoint>& points) {
    const PieceLine line(piece.now);
    const PieceLine line_before(piece.before);
    const double home = line_before.over(pose_before.centre).height;
    for (int k = 0; k < grain.size(); ++k) {
        const Vec2 p = pose.to_world(grain.vertex(k));
        const OverPiece now = line.over(p);
        if (std::abs(now.height) > rules.margin + grain.outer_radius()) continue;
        const auto side = side_of_piece(piece, p, now, line_before.over(pose_before.to_world(grain.vertex(k))), home,
                                        grain.outer_radius(), overrun);
        if (!side) continue;
        const double gap = side->height(now);
        if (gap > rules.margin) continue;
        const Vec2 normal = side->normal(line);
        const Approach approach{p, pose.turned(grain.vertex(grain.previous(k)) - grain.vertex(k)),
                                pose.turned(grain.vertex(grain.next(k)) - grain.vertex(k))};
        if (gap >= 0.0 && neighbour_behind(approach, normal, gap)) continue;
        GapPoint point{p, normal, gap, 0.0, 0.0, k, 0, true};
        set_range(point, piece.now.a, bounds(piece.at_a, side->sign), piece.now.b, bounds(piece.at_b, side->sign),
                  rules.resting);
        points.push_back(point);
    }
}

/// Where the chain comes from to the start of the piece; that itself at a free end.
const Vec2& start_before(const GapPiece& piece) {
    return piece.previous != nullptr ? piece.previous->now.a : piece.now.a;
}

void wall_end_point(const PolarPolygon& grain, const Pose& pose, const Vec2& end, const Vec2& beyond, const Vec2& other,
                    int which, const GapRules& rules, std::vector<GapPoint>& points) {
    const Vec2 p = pose.to_local(end);
    const double circle = grain.outer_radius() + rules.margin;
    if (p.squaredNorm() >= circle * circle) return;
    const int sector = grain.sector_of(p);
    const double sector_gap = gap_to_edge(grain, sector, p);
    if (sector_gap > rules.margin) return;
    const Approach approach{p, pose.turned_back(beyond - end), pose.turned_back(other - end)};
    const EdgeGaps edges = edges_near(grain, approach, sector, sector_gap, rules);
    for (int n = 0; n < edges.count; ++n) {
        const auto [edge, gap] = edges.found[n];
        GapPoint point{end, -pose.turned(grain.normal(edge)), gap, 0.0, 0.0, which, edge, false};
        const int next = grain.next(edge);
        set_range(point, pose.to_world(grain.vertex(edge)), !reentrant(grain, edge), pose.to_world(grain.vertex(next)),
                  !reentrant(grain, next), rules.resting);
        points.push_back(point);
    }
}

void wall_points(const PolarPolygon& grain, const Pose& pose, const Pose& pose_before, const GapPiece& piece,
                 bool overrun, const GapRules& rules, std::vector<GapPoint>& points) {
    const std::size_t first = points.size();
    wall_vertex_points(grain, pose, pose_before, piece, overrun, rules, points);
    // A joint belongs to the piece that begins there.
    if (piece.at_a != Joint::straight && !piece.points_away_from(pose.centre))
        wall_end_point(grain, pose, piece.now.a, start_before(piece), piece.now.b, 0, rules, points);
    if (piece.at_b == Joint::free_end)
        wall_end_point(grain, pose, piece.now.b, piece.now.b, piece.now.a, 1, rules, points);
    reduce_gap_points(points, first);
}

void wall_points(const Disk& disk, const Pose& pose, const Pose& pose_before, const GapPiece& piece, bool overrun,
                 const GapRules& rules, std::vector<GapPoint>& points) {
    const PieceLine line(piece.now);
    const OverPiece now = line.over(pose.centre);
    const auto add = [&](const Vec2& at, const Vec2& normal, double gap, int which) {
        if (gap <= rules.margin) points.push_back({at, normal, gap, -k_unbounded, k_unbounded, -1, which, true});
    };
    const auto side = side_of_piece(piece, pose.centre, now, PieceLine(piece.before).over(pose_before.centre), 1.0,
                                    disk.radius(), overrun);
    if (side) {
        const Vec2 normal = side->normal(line);
        const double height = side->height(now);
        add(pose.centre - height * normal, normal, height - disk.radius(), 0);
        return;
    }
    const bool at_a = now.station < 0.0;
    if (at_a ? piece.at_a == Joint::straight : piece.at_b != Joint::free_end) return;  // the next piece's affair
    const Vec2 end = at_a ? piece.now.a : piece.now.b;
    const Vec2 out = pose.centre - end;
    if (at_a && out.dot(start_before(piece) - end) > 0.0) return;  // the piece before is nearer
    const double distance = std::sqrt(out.squaredNorm());
    if (distance > 0.0) add(end, out / distance, distance - disk.radius(), at_a ? 1 : 2);
}

}  // namespace

void find_gap_points(const Shape& i, const Pose& pose_i, const Pose& pose_before, const GapPiece& piece,
                     const GapRules& rules, std::vector<GapPoint>& points) {
    const bool overrun = piece.one_sided && overlap(i, pose_i, piece.now);
    std::visit([&](const auto& s) { wall_points(s, pose_i, pose_before, piece, overrun, rules, points); }, i);
}

}  // namespace polargrain
