#include "src/detect/penetration.h"

#include <cmath>

#include "src/detect/facing.h"

namespace polargrain {

namespace {

/// towards: unit, from the owner to the other, in the owner's frame; only vertices farther along it than `limit` can be
/// inside.
void find_inside(const PolarPolygon& owner, const PolarPolygon& other, const Pose& relative, const Vec2& towards,
                 double limit, double tolerance, std::vector<InsideVertex>& found) {
    found.clear();
    const double reach = other.outer_radius() * other.outer_radius();
    any_vertex_beyond(owner, towards, limit, [&](int k) {
        const Vec2 p = relative.to_world(owner.vertex(k));
        if (p.squaredNorm() >= reach) return false;
        const int sector = other.sector_of(p);
        const double depth = other.depth(p, sector);
        if (depth > tolerance) found.push_back({k, sector, depth});
        return false;
    });
}

}  // namespace

void vertices_inside(const PolarPolygon& a, const Pose& pose_a, const PolarPolygon& b, const Pose& pose_b,
                     double tolerance, std::vector<InsideVertex>& of_a_in_b, std::vector<InsideVertex>& of_b_in_a) {
    const Vec2 way = pose_b.centre - pose_a.centre;
    const double distance = std::sqrt(way.squaredNorm());
    const Vec2 direction = distance > 0.0 ? Vec2(way / distance) : Vec2(Vec2::UnitX());
    const Vec2 from_a = pose_a.turned_back(direction);
    const Vec2 from_b = pose_b.turned_back(-direction);
    find_inside(a, b, pose_a.relative_to(pose_b), from_a, distance - reach_along(b, from_b), tolerance, of_a_in_b);
    find_inside(b, a, pose_b.relative_to(pose_a), from_b, distance - reach_along(a, from_a), tolerance, of_b_in_a);
}

}  // namespace polargrain
