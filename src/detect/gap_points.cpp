#include "src/detect/gap_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/detect/edge_gaps.h"
#include "src/detect/facing.h"
#include "src/detect/gap_reduction.h"

namespace polargrain {

namespace {

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

}  // namespace polargrain
