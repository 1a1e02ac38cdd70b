#include "src/detect/overlap.h"

#include <algorithm>
#include <cmath>

#include "src/detect/boundary.h"
#include "src/detect/facing.h"

namespace polargrain {

namespace {

/// Nearest distance from a point to a piece, squared.
double distance_squared(const Vec2& point, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double s = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (a + s * along - point).squaredNorm();
}

/// Calls visit(p, q) for each edge of `grain` that can reach a body about the origin of the pose's frame: those with an
/// end that faces it, see any_facing_vertex. Stops at the first true.
template <typename Visit>
bool any_facing_edge(const PolarPolygon& grain, const Pose& pose, double other_reach, Visit visit) {
    int last_end = -1;
    return any_facing_vertex(grain, pose, other_reach, [&](int k) {
        const Vec2 v = pose.to_world(grain.vertex(k));
        // The edge before ends here; it has been visited if the vertex before faces too.
        if (last_end != k && visit(pose.to_world(grain.vertex(grain.previous(k))), v)) return true;
        last_end = k + 1;
        return visit(v, pose.to_world(grain.vertex(grain.next(k))));
    });
}

double tolerance_of(double radius_a, double radius_b) { return k_touch_tolerance * std::min(radius_a, radius_b); }

bool overlap_pair(const Disk& a, const Pose& pose_a, const Disk& b, const Pose& pose_b) {
    const double reach = a.radius() + b.radius() - tolerance_of(a.radius(), b.radius());
    return (pose_b.centre - pose_a.centre).squaredNorm() < reach * reach;
}

/// Is a point at the squared distance d2 from the centre of mass deep inside the grain?
bool holds_centre(const PolarPolygon& grain, const Pose& pose, const Vec2& point, double d2, double tolerance) {
    return d2 < grain.outer_radius() * grain.outer_radius() && grain.depth(pose.to_local(point)) > tolerance;
}

bool overlap_pair(const PolarPolygon& a, const Pose& pose_a, const Disk& b, const Pose& pose_b) {
    const Vec2 between = pose_b.centre - pose_a.centre;
    const double d2 = between.squaredNorm();
    const double tolerance = tolerance_of(a.outer_radius(), b.radius());
    const double reach = a.outer_radius() + b.radius();
    if (d2 >= reach * reach) return false;
    const double sure = a.inner_radius() + b.radius() - tolerance;
    if (d2 < sure * sure || holds_centre(a, pose_a, pose_b.centre, d2, tolerance)) return true;
    const double touching = (b.radius() - tolerance) * (b.radius() - tolerance);
    return any_facing_edge(
        a, Pose{pose_a.centre - pose_b.centre, pose_a.cosine, pose_a.sine}, b.radius(),
        [&](const Vec2& p, const Vec2& q) { return distance_squared(Vec2::Zero(), p, q) < touching; });
}

bool overlap_pair(const Disk& a, const Pose& pose_a, const PolarPolygon& b, const Pose& pose_b) {
    return overlap_pair(b, pose_b, a, pose_a);
}

bool overlap_pair(const PolarPolygon& a, const Pose& pose_a, const PolarPolygon& b, const Pose& pose_b) {
    const double d2 = (pose_b.centre - pose_a.centre).squaredNorm();
    const double reach = a.outer_radius() + b.outer_radius();
    if (d2 >= reach * reach) return false;
    const double tolerance = tolerance_of(a.outer_radius(), b.outer_radius());
    const double sure = a.inner_radius() + b.inner_radius() - tolerance;
    if (d2 < sure * sure) return true;
    // Overlapping without the outlines meeting means one inside the other, centre and all.
    if (holds_centre(a, pose_a, pose_b.centre, d2, tolerance) ||
        holds_centre(b, pose_b, pose_a.centre, d2, tolerance)) {
        return true;
    }
    const Pose relative = pose_a.relative_to(pose_b);
    return any_facing_edge(a, relative, reach_towards(b, relative),
                           [&](const Vec2& p, const Vec2& q) { return piece_enters(b, p, q, tolerance); });
}

bool overlap_piece(const Disk& disk, const Pose& pose, const WallPiece& piece) {
    const double reach = disk.radius() * (1.0 - k_touch_tolerance);
    return distance_squared(pose.centre, piece.a, piece.b) < reach * reach;
}

bool overlap_piece(const PolarPolygon& grain, const Pose& pose, const WallPiece& piece) {
    if (distance_squared(pose.centre, piece.a, piece.b) >= grain.outer_radius() * grain.outer_radius()) return false;
    return piece_enters(grain, pose.to_local(piece.a), pose.to_local(piece.b),
                        k_touch_tolerance * grain.outer_radius());
}

}  // namespace

bool overlap(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
    // The answer is computed from one fixed side, so that round-off cannot make it depend on who is called a.
    const bool in_order = pose_a.centre.x() < pose_b.centre.x() ||
                          (pose_a.centre.x() == pose_b.centre.x() && pose_a.centre.y() <= pose_b.centre.y());
    const Shape& first = in_order ? a : b;
    const Shape& second = in_order ? b : a;
    const Pose& pose_first = in_order ? pose_a : pose_b;
    const Pose& pose_second = in_order ? pose_b : pose_a;
    return std::visit([&](const auto& s, const auto& t) { return overlap_pair(s, pose_first, t, pose_second); }, first,
                      second);
}

bool overlap(const Shape& grain, const Pose& pose, const WallPiece& piece) {
    return std::visit([&](const auto& s) { return overlap_piece(s, pose, piece); }, grain);
}

}  // namespace polargrain
