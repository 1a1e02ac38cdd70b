#include "src/run/observables.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polargrain {

namespace {

Vec2 upwards(const Scene& scene) { return -scene.gravity / std::sqrt(scene.gravity.squaredNorm()); }

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

}  // namespace polargrain
