#include "src/engines/dem/contact_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/elementary.h"
#include "src/detect/facing.h"
#include "src/engines/dem/potential_contact.h"

namespace polargrain {

AreaEnergy::Value AreaEnergy::at(double area, double stiffness, double radius) const {
    const double scale = 0.5 * stiffness * target * target * radius * radius;
    const double share = area / (target * radius * radius);
    const double energy = scale * (exponent == 2.0 ? share * share : power(share, exponent));
    return {energy, exponent * energy / area};
}

namespace {

using WallBox = std::array<Vec2, 4>;

/// Behind the face that runs from one point to the other: counter-clockwise, its face first.
WallBox box_behind(const Vec2& from, const Vec2& to, double depth_over_length) {
    const Vec2 behind = left_normal(to - from) * depth_over_length;
    return {from, to, to + behind, from + behind};
}

double area_of(std::span<const OverlapRegion> regions) {
    double area = 0.0;
    for (const OverlapRegion& region : regions) area += region.area;
    return area;
}

}  // namespace

TouchFinder::TouchFinder(const DemSettings& settings)
    : polygons_(settings.polygons), energy_{settings.area_exponent, settings.target_overlap} {}

void TouchFinder::find(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, double stiffness,
                       std::vector<Touch>& touches) {
    const auto* polygon_a = std::get_if<PolarPolygon>(&a);
    const auto* polygon_b = std::get_if<PolarPolygon>(&b);
    if (polygon_a != nullptr && polygon_b != nullptr) {
        find(*polygon_a, pose_a, *polygon_b, pose_b, stiffness, touches);
    } else if (polygon_a != nullptr) {
        touch_polygon(*polygon_a, pose_a, pose_b.centre, std::get<Disk>(b).radius(), touches);
    } else if (polygon_b != nullptr) {
        const std::size_t first = touches.size();
        touch_polygon(*polygon_b, pose_b, pose_a.centre, std::get<Disk>(a).radius(), touches);
        for (std::size_t k = first; k < touches.size(); ++k) touches[k].normal = -touches[k].normal;
    }
}

void TouchFinder::find(const PolarPolygon& a, const Pose& pose_a, const PolarPolygon& b, const Pose& pose_b,
                       double stiffness, std::vector<Touch>& touches) {
    const double radius = std::min(a.inner_radius(), b.inner_radius());
    if (polygons_ == PolygonContact::potential) {
        const auto touch = potential_touch(a, pose_a, b, pose_b, 0.5 * stiffness * radius);
        if (touch) touches.push_back(*touch);
        return;
    }
    add_regions(overlap_.find(a, b, pose_b.relative_to(pose_a)), pose_a, stiffness, radius, touches);
}

void TouchFinder::find(const SoftPiece& piece, const PolarPolygon& grain, const Pose& pose, double stiffness,
                       std::vector<Touch>& touches) {
    const double side = cross(piece.along, pose.centre - piece.a);
    if (std::abs(side) >= grain.outer_radius()) return;
    const Vec2 a = pose.to_local(piece.a);
    const Vec2 b = pose.to_local(piece.b);
    const double deep = grain.inner_radius() / piece.length;
    const WallBox near = side >= 0.0 ? box_behind(b, a, deep) : box_behind(a, b, deep);
    std::span<const OverlapRegion> regions = overlap_.find(near, grain);
    if (regions.empty()) return;
    // Away from the ends of the piece the larger part of the grain lies on the side of its centre.
    const double reach = grain.outer_radius() * grain.outer_radius();
    if (a.squaredNorm() < reach || b.squaredNorm() < reach) {
        const WallBox far = side >= 0.0 ? box_behind(a, b, deep) : box_behind(b, a, deep);
        if (overlap_.area(far, grain) < area_of(regions)) regions = overlap_.find(far, grain);
    }
    add_regions(regions, pose, stiffness, grain.inner_radius(), touches);
}

void TouchFinder::add_regions(std::span<const OverlapRegion> regions, const Pose& frame, double stiffness,
                              double radius, std::vector<Touch>& touches) const {
    const double area = area_of(regions);
    if (!(area > 0.0)) return;
    const AreaEnergy::Value value = energy_.at(area, stiffness, radius);
    for (const OverlapRegion& region : regions) {
        touches.push_back({frame.to_world(region.point), frame.turned(region.normal), region.depth, region.width, false,
                           value.slope * region.width, value.energy * region.area / area});
    }
}

void touch_polygon(const PolarPolygon& polygon, const Pose& pose, const Vec2& centre, double radius,
                   std::vector<Touch>& touches) {
    const Vec2 p = pose.to_local(centre);
    const double distance = std::sqrt(p.squaredNorm());
    if (distance >= polygon.outer_radius() + radius || !(distance > 0.0) || polygon.depth(p) > 0.0) return;
    const auto add = [&](const Vec2& nearest, const Vec2& normal, double gap) {
        const double depth = radius - gap;
        touches.push_back(
            {pose.to_world(nearest - 0.5 * depth * normal), pose.turned(normal), depth, 0.0, true, 0.0, 0.0});
    };
    const auto station = [&](int edge) { return left_normal(polygon.normal(edge)).dot(p - polygon.vertex(edge)); };
    const auto length = [&](int edge) {
        return std::sqrt((polygon.vertex(polygon.next(edge)) - polygon.vertex(edge)).squaredNorm());
    };
    const auto face = [&](int edge) {
        const double gap = polygon.normal(edge).dot(p) - polygon.offset(edge);
        const double s = station(edge);
        if (gap < 0.0 || gap >= radius || s < 0.0 || s >= length(edge)) return;
        add(p - gap * polygon.normal(edge), polygon.normal(edge), gap);
    };
    const auto corner = [&](int vertex) {
        const Vec2 away = p - polygon.vertex(vertex);
        const double gap = std::sqrt(away.squaredNorm());
        const int before = polygon.previous(vertex);
        if (gap >= radius || !(gap > 0.0) || station(vertex) >= 0.0 || station(before) < length(before)) return;
        add(polygon.vertex(vertex), away / gap, gap);
    };
    int first_edge = -1;
    int last_edge = -1;
    const auto face_once = [&](int edge) {
        if (edge == first_edge || edge == last_edge) return;
        if (first_edge < 0) first_edge = edge;
        last_edge = edge;
        face(edge);
    };
    any_vertex_beyond(polygon, p / distance, distance - radius, [&](int k) {
        face_once(polygon.previous(k));
        face_once(k);
        corner(k);
        return false;
    });
}

}  // namespace polargrain
