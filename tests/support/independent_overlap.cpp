#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/scenes.h"

namespace polargrain::testing {

namespace {

/// An outline in the world; a disk as its centre and radius.
struct Outline {
    bool disk = false;
    Vec2 centre = Vec2::Zero();
    double radius = 0.0;
    std::vector<Vec2> points;
};

Outline outline_of(const Scene& scene, const Grains& grains, GrainIndex k) {
    Outline outline;
    outline.centre = grains.position(k);
    const Shape& shape = scene.shape_of(k);
    outline.radius = outer_radius(shape);
    const auto* polygon = std::get_if<PolarPolygon>(&shape);
    outline.disk = polygon == nullptr;
    if (outline.disk) return outline;
    const double c = std::cos(grains.angle[Grains::at(k)]);
    const double s = std::sin(grains.angle[Grains::at(k)]);
    for (const Vec2& v : polygon->vertices()) {
        outline.points.emplace_back(outline.centre.x() + c * v.x() - s * v.y(),
                                    outline.centre.y() + s * v.x() + c * v.y());
    }
    return outline;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double t = std::clamp((p - a).dot(along) / along.dot(along), 0.0, 1.0);
    return (p - a - t * along).norm();
}

double distance_to_outline(const Vec2& p, const std::vector<Vec2>& points) {
    double least = 1e300;
    for (std::size_t k = 0; k < points.size(); ++k) {
        least = std::min(least, distance_to_segment(p, points[k], points[(k + 1) % points.size()]));
    }
    return least;
}

int winding_number(const Vec2& p, const std::vector<Vec2>& points) {
    int winding = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec2& a = points[k];
        const Vec2& b = points[(k + 1) % points.size()];
        const double side = cross(Vec2(b - a), Vec2(p - a));
        if (a.y() <= p.y() && b.y() > p.y() && side > 0.0) ++winding;
        if (a.y() > p.y() && b.y() <= p.y() && side < 0.0) --winding;
    }
    return winding;
}

bool deep_inside(const Vec2& p, const std::vector<Vec2>& points, double tolerance) {
    return winding_number(p, points) != 0 && distance_to_outline(p, points) > tolerance;
}

/// Do the segments cross, with all four ends farther than the tolerance from the other's line?
bool cross_properly(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, double tolerance) {
    const double lab = (b - a).norm();
    const double lcd = (d - c).norm();
    const double c1 = cross(Vec2(b - a), Vec2(c - a)) / lab;
    const double c2 = cross(Vec2(b - a), Vec2(d - a)) / lab;
    const double a1 = cross(Vec2(d - c), Vec2(a - c)) / lcd;
    const double a2 = cross(Vec2(d - c), Vec2(b - c)) / lcd;
    const auto opposite = [tolerance](double p, double q) {
        return (p > tolerance && q < -tolerance) || (p < -tolerance && q > tolerance);
    };
    return opposite(c1, c2) && opposite(a1, a2);
}

bool overlapping(const Outline& a, const Outline& b, double tolerance) {
    if (a.disk && b.disk) return (a.centre - b.centre).norm() < a.radius + b.radius - tolerance;
    if (b.disk) return overlapping(b, a, tolerance);
    if (a.disk) {
        return winding_number(a.centre, b.points) != 0 ||
               distance_to_outline(a.centre, b.points) < a.radius - tolerance;
    }
    for (const Vec2& p : a.points) {
        if (deep_inside(p, b.points, tolerance)) return true;
    }
    for (const Vec2& p : b.points) {
        if (deep_inside(p, a.points, tolerance)) return true;
    }
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        for (std::size_t j = 0; j < b.points.size(); ++j) {
            if (cross_properly(a.points[i], a.points[(i + 1) % a.points.size()], b.points[j],
                               b.points[(j + 1) % b.points.size()], tolerance)) {
                return true;
            }
        }
    }
    return winding_number(a.centre, b.points) != 0 || winding_number(b.centre, a.points) != 0;
}

bool overlaps_piece(const Outline& grain, const Vec2& a, const Vec2& b, double tolerance) {
    if (grain.disk) return distance_to_segment(grain.centre, a, b) < grain.radius - tolerance;
    if (deep_inside(a, grain.points, tolerance) || deep_inside(b, grain.points, tolerance)) return true;
    for (std::size_t k = 0; k < grain.points.size(); ++k) {
        if (cross_properly(grain.points[k], grain.points[(k + 1) % grain.points.size()], a, b, tolerance)) return true;
    }
    return false;
}

}  // namespace

int count_overlaps(const Scene& scene, const Grains& grains, double time, double tolerance) {
    std::vector<Outline> outlines;
    for (GrainIndex k = 0; k < grains.size(); ++k) outlines.push_back(outline_of(scene, grains, k));
    int count = 0;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        for (std::size_t j = i + 1; j < outlines.size(); ++j) {
            const double reach = outlines[i].radius + outlines[j].radius;
            if ((outlines[i].centre - outlines[j].centre).norm() < reach &&
                overlapping(outlines[i], outlines[j], tolerance)) {
                ++count;
            }
        }
        for (const Wall& wall : scene.walls) {
            if (!wall.present(time)) continue;
            const WallState state = wall_state(wall, time);
            for (std::size_t k = 0; k + 1 < wall.points.size(); ++k) {
                if (overlaps_piece(outlines[i], state.point(wall.points[k]), state.point(wall.points[k + 1]),
                                   tolerance)) {
                    ++count;
                }
            }
        }
    }
    return count;
}

}  // namespace polargrain::testing
