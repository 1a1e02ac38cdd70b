#include "src/observe/bed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "src/core/elementary.h"

namespace polargrain {

namespace {

/// Sum of the heights of the centres of n disks of radius r in the rows of a hexagonal packing over a width.
double hexagonal_height_sum(GrainIndex n, double r, double width) {
    const double long_row = std::floor(width / (2.0 * r) + 1e-9);
    const double short_row = std::max(1.0, std::floor((width - r) / (2.0 * r) + 1e-9));
    double left = n;
    double height = r;
    double sum = 0.0;
    for (bool even = true; left > 0.0; even = !even) {
        const double in_row = std::min(left, even ? long_row : short_row);
        sum += in_row * height;
        left -= in_row;
        height += std::sqrt(3.0) * r;
    }
    return sum;
}

}  // namespace

Vec2 upwards(const Scene& scene) {
    const double g = std::sqrt(scene.gravity.squaredNorm());
    return g > 0.0 ? Vec2(-scene.gravity / g) : Vec2(Vec2::UnitY());
}

std::pair<double, double> wall_width(const Scene& scene) {
    const Vec2 across = right_normal(upwards(scene));
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (const Wall& wall : scene.walls) {
        for (const Vec2& p : points_at_rest(wall)) {
            left = std::min(left, across.dot(p));
            right = std::max(right, across.dot(p));
        }
    }
    return {left, right};
}

std::optional<double> outlet_height(const Scene& scene) {
    if (scene.walls.empty() || scene.gravity.squaredNorm() == 0.0) return std::nullopt;
    const Vec2 up = upwards(scene);
    double lowest = std::numeric_limits<double>::infinity();
    for (const Wall& wall : scene.walls) {
        for (const Vec2& p : points_at_rest(wall)) lowest = std::min(lowest, up.dot(p));
    }
    return lowest;
}

bool is_out(const Scene& scene, double outlet, GrainIndex k, const Vec2& position) {
    return upwards(scene).dot(position) < outlet - outer_radius(scene.shape_of(k));
}

std::vector<GrainIndex> grains_in(const Scene& scene, const Grains& grains) {
    const std::optional<double> outlet = outlet_height(scene);
    std::vector<GrainIndex> in;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        if (!outlet || !is_out(scene, *outlet, k, grains.position(k))) in.push_back(k);
    }
    return in;
}

GrainIndex count_out(const Scene& scene, const Grains& grains) {
    return grains.size() - static_cast<GrainIndex>(grains_in(scene, grains).size());
}

double mean_outer_radius(const Scene& scene) {
    double radii = 0.0;
    for (const ShapeIndex s : scene.grains.shape) radii += outer_radius(scene.shape(s));
    return radii / scene.grains.size();
}

double potential_over_hexagonal(const Scene& scene, const Grains& grains) {
    const std::optional<double> floor = outlet_height(scene);
    const std::vector<GrainIndex> in = grains_in(scene, grains);
    if (!floor || in.empty()) return std::nan("");
    double weighted = 0.0;
    double mass = 0.0;
    double covered = 0.0;
    for (const GrainIndex k : in) {
        const double m = grains.mass[Grains::at(k)];
        weighted += m * (upwards(scene).dot(grains.position(k)) - *floor);
        mass += m;
        covered += area(scene.shape_of(k));
    }
    const auto n = static_cast<double>(in.size());
    const double radius = std::sqrt(covered / n / k_pi);
    const auto [left, right] = wall_width(scene);
    if (right - left < 2.0 * radius) return std::nan("");
    return weighted / (mass / n * hexagonal_height_sum(static_cast<GrainIndex>(in.size()), radius, right - left));
}

}  // namespace polargrain
