#include "src/detect/gap_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "src/detect/facing.h"
#include "src/detect/gap_reduction.h"

namespace polargrain {

namespace {

constexpr double k_unbounded = std::numeric_limits<double>::infinity();

/// A vertex of one body with its neighbours, in the frame of the polygon it comes near.
struct Approach {
    Vec2 p;
    Vec2 to_previous, to_next;  ///< from p; zero where there is no neighbour
};

bool reentrant(const PolarPolygon& polygon, int vertex) {
    return cross(polygon.normal(polygon.previous(vertex)), polygon.normal(vertex)) < 0.0;
}

double gap_to_edge(const PolarPolygon& polygon, int edge, const Vec2& p) { return -polygon.depth(p, edge); }

/// Feature rule: does a neighbour of p lie behind the line of the edge?
bool neighbour_behind(const Approach& v, const Vec2& normal, double gap) {
    for (const Vec2& f : {v.to_previous, v.to_next}) {
        const double rise = f.dot(normal);
        if (gap + rise < 0.0 && rise < 0.0 && rise * rise > GapRules::k_behind * GapRules::k_behind * f.squaredNorm()) {
            return true;
        }
    }
    return false;
}

double least_rise(const Approach& v, const Vec2& normal) {
    return std::min(v.to_previous.dot(normal), v.to_next.dot(normal));
}

/// What a vertex near a polygon contributes: up to three edges and gaps.
struct EdgeGap {
    int edge;
    double gap;
};

struct EdgeGaps {
    EdgeGap found[3];
    int count = 0;
    void add(int edge, double gap) {
        if (count < 3) found[count++] = {edge, gap};
    }
};

/// Has p passed the end q of the edge, and does q face an edge of p's body instead? Then that is the contact, which the
/// other direction finds; the edge drawn out beyond its end would strike p too early, along the wrong normal.
bool end_faces_instead(const PolarPolygon& polygon, const Approach& v, int edge, const GapRules& rules) {
    const Vec2 along = -right_normal(polygon.normal(edge));  // from its first vertex to its second
    for (const int end : {edge, polygon.next(edge)}) {
        const Vec2 q = polygon.vertex(end) - v.p;
        const double passed = end == edge ? along.dot(q) : -along.dot(q);
        if (passed <= rules.resting || reentrant(polygon, end)) continue;
        const Vec2 ways[2] = {v.to_previous, v.to_next};
        for (int n = 0; n < 2; ++n) {
            const double length = std::sqrt(ways[n].squaredNorm());
            const double station = ways[n].dot(q);
            if (station <= rules.resting * length || station >= length * length) continue;
            const Vec2 outward = n == 0 ? Vec2(-right_normal(ways[n]) / length) : Vec2(right_normal(ways[n]) / length);
            const double gap = outward.dot(q);
            if (gap < 0.0 || gap > rules.margin) continue;
            const Approach back{polygon.vertex(end), polygon.vertex(polygon.previous(end)) - polygon.vertex(end),
                                polygon.vertex(polygon.next(end)) - polygon.vertex(end)};
            if (!neighbour_behind(back, outward, gap)) return true;
        }
    }
    return false;
}

/// The edge that bounds the free space of a vertex outside, by the feature and reflex rules; none where the true
/// contact is elsewhere.
/// `edge` is the edge of the sector that holds the vertex, `gap` the distance from it, not beyond the margin.
EdgeGaps edges_near(const PolarPolygon& polygon, const Approach& v, int edge, double gap, const GapRules& rules) {
    EdgeGaps edges;
    struct End {
        int vertex;
        int across;
    };
    const End ends[2] = {{edge, polygon.previous(edge)}, {polygon.next(edge), polygon.next(edge)}};
    const auto at_corner = [&](const End& end) {
        return !reentrant(polygon, end.vertex) &&
               (v.p - polygon.vertex(end.vertex)).squaredNorm() < 4.0 * rules.resting * rules.resting;
    };
    const auto faces_better = [&](int across) {
        return least_rise(v, polygon.normal(across)) > least_rise(v, polygon.normal(edge));
    };
    // Round-off puts a corner that stands exactly on a corner a hair inside; that is touching.
    const double touching = -k_touch_tolerance * polygon.outer_radius();
    if (gap < touching) {
        // Inside, close to a corner, the sector says nothing about the way out: the edge that faces the vertex does.
        for (const End& end : ends) {
            if (!at_corner(end) || !faces_better(end.across)) continue;
            const double other = gap_to_edge(polygon, end.across, v.p);
            if (other < touching) {
                edges.add(end.across, other);
                return edges;
            }
        }
        edges.add(edge, gap);
        return edges;
    }
    if (!neighbour_behind(v, polygon.normal(edge), gap)) {
        if (!end_faces_instead(polygon, v, edge, rules)) edges.add(edge, gap);
        for (const End& end : ends) {
            if (!reentrant(polygon, end.vertex)) continue;
            if ((v.p - polygon.vertex(end.vertex)).squaredNorm() >= 4.0 * rules.margin * rules.margin) continue;
            const double other = gap_to_edge(polygon, end.across, v.p);
            if (other >= touching && other <= rules.margin) edges.add(end.across, other);
        }
        return edges;
    }
    for (const End& end : ends) {
        if (!at_corner(end) || !faces_better(end.across)) continue;
        const double other = gap_to_edge(polygon, end.across, v.p);
        if (other < touching || other >= rules.margin) continue;
        edges.add(end.across, other);
        return edges;
    }
    return edges;
}

/// Edge-end rule: travel along t for which the point stays over the edge from a to b. An end that is re-entrant, or
/// has been passed already, does not bound.
void set_range(GapPoint& point, const Vec2& a, bool a_bounds, const Vec2& b, bool b_bounds, double slack) {
    const Vec2 t = right_normal(point.normal);
    const double at_a = t.dot(a - point.point);
    const double at_b = t.dot(b - point.point);
    // Travel of the point along its edge; where the point is j's, i travels the other way.
    double low = std::min(at_a, at_b);
    double high = std::max(at_a, at_b);
    bool low_bounds = at_a < at_b ? a_bounds : b_bounds;
    bool high_bounds = at_a < at_b ? b_bounds : a_bounds;
    if (!point.on_i) {
        std::swap(low, high);
        std::swap(low_bounds, high_bounds);
        low = -low;
        high = -high;
    }
    point.low = low_bounds && low <= 0.0 ? low - slack : -k_unbounded;
    point.high = high_bounds && high >= 0.0 ? high + slack : k_unbounded;
}

/// A vertex within the margin of the edge of the sector that holds it, in the frame of the other.
struct NearVertex {
    Vec2 p;
    double gap;
    int vertex;
    int sector;
};

/// Vertices of `owner` near `other`; the owner is i where on_i. towards: unit, from the owner to the other, in the
/// owner's frame; only vertices farther along it than `limit` can be near. Returns a length that no vertex is nearer to
/// the outline of the other; negative where one is inside.
double add_vertex_points(const PolarPolygon& owner, const Pose& owner_pose, const PolarPolygon& other,
                         const Pose& other_pose, bool on_i, const Vec2& towards, double limit, const GapRules& rules,
                         std::vector<GapPoint>& points) {
    const Pose relative = owner_pose.relative_to(other_pose);
    const double circle = other.outer_radius() + rules.margin;
    double least = rules.margin;
    thread_local std::vector<NearVertex> near;
    near.resize(static_cast<std::size_t>(owner.size()) + 1);
    std::size_t count = 0;
    any_vertex_beyond(owner, towards, limit, [&](int k) {
        const Vec2 p = relative.to_world(owner.vertex(k));
        const int sector = other.sector_of(p);
        const double gap = gap_to_edge(other, sector, p);
        near[count] = {p, gap, k, sector};
        count += static_cast<std::size_t>((p.squaredNorm() < circle * circle) & (gap <= rules.margin));
        return false;
    });
    for (std::size_t m = 0; m < count; ++m) {
        const auto& [p, sector_gap, k, sector] = near[m];
        const Vec2 v = owner.vertex(k);
        least = std::min(least, sector_gap);
        const Approach approach{p, relative.turned(owner.vertex(owner.previous(k)) - v),
                                relative.turned(owner.vertex(owner.next(k)) - v)};
        const EdgeGaps edges = edges_near(other, approach, sector, sector_gap, rules);
        for (int n = 0; n < edges.count; ++n) {
            const auto [edge, gap] = edges.found[n];
            const Vec2 outward = other_pose.turned(other.normal(edge));
            GapPoint point{other_pose.to_world(p), on_i ? outward : Vec2(-outward), gap, 0.0, 0.0, k, edge, on_i};
            const int end = other.next(edge);
            set_range(point, other_pose.to_world(other.vertex(edge)), !reentrant(other, edge),
                      other_pose.to_world(other.vertex(end)), !reentrant(other, end), rules.resting);
            points.push_back(point);
        }
    }
    return least * other.evenness();
}

Separation gap_points(const PolarPolygon& i, const Pose& pose_i, const PolarPolygon& j, const Pose& pose_j,
                      const GapRules& rules, std::vector<GapPoint>& points) {
    const Vec2 way = pose_i.centre - pose_j.centre;
    const double distance = std::sqrt(way.squaredNorm());
    const Vec2 direction = distance > 0.0 ? Vec2(way / distance) : Vec2(Vec2::UnitX());
    const Vec2 from_j = pose_j.turned_back(direction);
    const Vec2 from_i = pose_i.turned_back(-direction);
    const double reach_j = reach_along(j, from_j);
    const double reach_i = reach_along(i, from_i);
    const bool apart = reach_i + reach_j <= distance;
    if (reach_i + reach_j + rules.margin <= distance) return {apart, rules.margin};
    const std::size_t first = points.size();
    const double of_i =
        add_vertex_points(i, pose_i, j, pose_j, true, from_i, distance - reach_j - rules.margin, rules, points);
    const double of_j =
        add_vertex_points(j, pose_j, i, pose_i, false, from_j, distance - reach_i - rules.margin, rules, points);
    reduce_gap_points(points, first);
    return {apart, std::min(of_i, of_j)};
}

Separation gap_points(const Disk& i, const Pose& pose_i, const Disk& j, const Pose& pose_j, const GapRules& rules,
                      std::vector<GapPoint>& points) {
    const Vec2 apart = pose_i.centre - pose_j.centre;
    const double distance = std::sqrt(apart.squaredNorm());
    const double gap = distance - i.radius() - j.radius();
    if (gap > rules.margin || distance == 0.0) return {gap > 0.0, gap};
    const Vec2 normal = apart / distance;
    points.push_back(
        {pose_j.centre + normal * (j.radius() + 0.5 * gap), normal, gap, -k_unbounded, k_unbounded, -1, -1, true});
    return {gap >= 0.0, gap};
}

/// The nearest points of a polygon's boundary to a disk, where the distance has a local minimum. disk_is_i: the normal
/// points into the disk.
void add_disk_points(const Disk& disk, const Pose& disk_pose, const PolarPolygon& polygon, const Pose& pose,
                     bool disk_is_i, const GapRules& rules, std::vector<GapPoint>& points) {
    const Vec2 centre = pose.to_local(disk_pose.centre);
    const double near = disk.radius() + rules.margin;
    const auto add = [&](const Vec2& at, const Vec2& out, double gap, int edge) {
        const Vec2 normal = pose.turned(out);
        points.push_back({pose.to_world(at), disk_is_i ? normal : Vec2(-normal), gap, -k_unbounded, k_unbounded, -1,
                          edge, disk_is_i});
    };
    if (centre.squaredNorm() >= (polygon.outer_radius() + near) * (polygon.outer_radius() + near)) return;
    for (int k = 0; k < polygon.size(); ++k) {
        const Vec2 a = polygon.vertex(k);
        const Vec2 along = polygon.vertex(polygon.next(k)) - a;
        const double height = (centre - a).dot(polygon.normal(k));
        if (height <= 0.0 || height >= near) continue;
        const double station = (centre - a).dot(along) / along.squaredNorm();
        if (station > 0.0 && station < 1.0) add(a + station * along, polygon.normal(k), height - disk.radius(), k);
    }
    for (int k = 0; k < polygon.size(); ++k) {
        const Vec2 out = centre - polygon.vertex(k);
        const double d2 = out.squaredNorm();
        if (d2 >= near * near || d2 == 0.0 || reentrant(polygon, k)) continue;
        const Vec2 before = polygon.vertex(polygon.previous(k)) - polygon.vertex(k);
        const Vec2 after = polygon.vertex(polygon.next(k)) - polygon.vertex(k);
        if (out.dot(before) > 0.0 || out.dot(after) > 0.0) continue;  // an edge is nearer
        const double distance = std::sqrt(d2);
        add(polygon.vertex(k), out / distance, distance - disk.radius(), polygon.size() + k);
    }
}

Separation gap_points(const Disk& i, const Pose& pose_i, const PolarPolygon& j, const Pose& pose_j,
                      const GapRules& rules, std::vector<GapPoint>& points) {
    add_disk_points(i, pose_i, j, pose_j, true, rules, points);
    return {};
}

Separation gap_points(const PolarPolygon& i, const Pose& pose_i, const Disk& j, const Pose& pose_j,
                      const GapRules& rules, std::vector<GapPoint>& points) {
    add_disk_points(j, pose_j, i, pose_i, false, rules, points);
    return {};
}

}  // namespace

Separation find_gap_points(const Shape& i, const Pose& pose_i, const Shape& j, const Pose& pose_j,
                           const GapRules& rules, std::vector<GapPoint>& points) {
    return std::visit([&](const auto& s, const auto& t) { return gap_points(s, pose_i, t, pose_j, rules, points); }, i,
                      j);
}

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
