#include "src/run/observables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace polargrain {

namespace {

Vec2 upwards(const Scene& scene) { return -scene.gravity / std::sqrt(scene.gravity.squaredNorm()); }

/// Least and greatest station of any wall point along a direction.
std::pair<double, double> wall_width(const Scene& scene, const Vec2& across) {
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (const Wall& wall : scene.walls) {
        for (const Vec2& p : wall.points) {
            left = std::min(left, across.dot(p));
            right = std::max(right, across.dot(p));
        }
    }
    return {left, right};
}

}  // namespace

std::optional<double> outlet_height(const Scene& scene) {
    if (scene.walls.empty() || scene.gravity.squaredNorm() == 0.0) return std::nullopt;
    const Vec2 up = upwards(scene);
    double lowest = std::numeric_limits<double>::infinity();
    for (const Wall& wall : scene.walls) {
        for (const Vec2& p : wall.points) lowest = std::min(lowest, up.dot(p));
    }
    return lowest;
}

bool is_out(const Scene& scene, double outlet, GrainIndex k, const Vec2& position) {
    return upwards(scene).dot(position) < outlet - outer_radius(scene.shape_of(k));
}

GrainIndex count_out(const Scene& scene, const Grains& grains) {
    const std::optional<double> outlet = outlet_height(scene);
    if (!outlet) return 0;
    GrainIndex out = 0;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        if (is_out(scene, *outlet, k, grains.position(k))) ++out;
    }
    return out;
}

double area_fraction(const Scene& scene, const Grains& grains) {
    const std::optional<double> floor = outlet_height(scene);
    if (!floor || grains.empty()) return std::nan("");
    const Vec2 up = upwards(scene);
    const Vec2 across = right_normal(up);
    const auto [left, right] = wall_width(scene, across);
    double radii = 0.0;
    for (const ShapeIndex s : grains.shape) radii += outer_radius(scene.shape(s));
    const double columns = std::max(1.0, std::round((right - left) / (2.0 * radii / grains.size())));
    const double width = (right - left) / columns;
    std::vector<double> heights(static_cast<std::size_t>(columns), 0.0);
    double filled = 0.0;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const Shape& shape = scene.shape(grains.shape[Grains::at(k)]);
        const double height = up.dot(grains.position(k)) - *floor;
        const double station = std::floor((across.dot(grains.position(k)) - left) / width);
        if (height < 0.0 || station < 0.0 || station >= columns) continue;
        filled += area(shape);
        double& top = heights[static_cast<std::size_t>(station)];
        top = std::max(top, height + outer_radius(shape));
    }
    double under = 0.0;
    for (const double height : heights) under += width * height;
    return under > 0.0 ? filled / under : std::nan("");
}

}  // namespace polargrain
