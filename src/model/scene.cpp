#include "src/model/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polargrain {

ShapeIndex Scene::add(std::shared_ptr<const Shape> shape) {
    shapes.push_back(std::move(shape));
    return static_cast<ShapeIndex>(shapes.size()) - 1;
}

GrainIndex Scene::add(const Grain& grain) {
    const Shape& outline = shape(grain.shape);
    const double density = materials[grain.material].density;
    grains.x.push_back(grain.position.x());
    grains.y.push_back(grain.position.y());
    grains.angle.push_back(grain.angle);
    grains.vx.push_back(grain.velocity.x());
    grains.vy.push_back(grain.velocity.y());
    grains.spin.push_back(grain.spin);
    grains.mass.push_back(density * area(outline));
    grains.inertia.push_back(density * polar_moment(outline));
    grains.shape.push_back(grain.shape);
    grains.material.push_back(grain.material);
    return grains.size() - 1;
}

World initial_world(const Scene& scene) { return {0.0, 0, scene.grains}; }

Energy energy(const Grains& grains, const Vec2& gravity) {
    Energy sum;
    for (std::size_t k = 0; k < grains.x.size(); ++k) {
        sum.translational += 0.5 * grains.mass[k] * (grains.vx[k] * grains.vx[k] + grains.vy[k] * grains.vy[k]);
        sum.rotational += 0.5 * grains.inertia[k] * grains.spin[k] * grains.spin[k];
        sum.potential -= grains.mass[k] * (gravity.x() * grains.x[k] + gravity.y() * grains.y[k]);
    }
    return sum;
}

std::string state_hash(const World& world) {
    StateHash hash;
    hash.add(world.step);
    for (const auto* values : {&world.grains.x, &world.grains.y, &world.grains.angle, &world.grains.vx,
                               &world.grains.vy, &world.grains.spin}) {
        hash.add(*values);
    }
    return hash.hex();
}

namespace {

/// How far a wall carries against gravity what lies on it [m], as far as its motion comes to an end. Along itself it
/// carries nothing.
double lift(const Wall& wall, const Vec2& up) {
    const std::vector<Vec2> points = points_at_rest(wall);
    if (points.size() == wall.points.size()) return 0.0;
    const Vec2 way = points[wall.points.size()] - points.front();
    constexpr double k_along = 1e-9;  // sine of an angle
    for (std::size_t k = 1; k < wall.points.size(); ++k) {
        const Vec2 piece = points[k] - points[k - 1];
        const double sideways = std::abs(cross(way, piece));
        if (sideways > k_along * std::sqrt(way.squaredNorm() * piece.squaredNorm())) return std::max(0.0, up.dot(way));
    }
    return 0.0;
}

}  // namespace

Drop largest_drop(const Scene& scene) {
    const double g = std::sqrt(scene.gravity.squaredNorm());
    if (g == 0.0) return {};
    const Vec2 up = -scene.gravity / g;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        const double centre = up.dot(scene.grains.position(k));
        const double reach = outer_radius(scene.shape_of(k));
        lowest = std::min(lowest, centre - reach);
        highest = std::max(highest, centre + reach);
    }
    // Walls bound the fall from below: grains leaving a bin drop to the end of the walls at least.
    double lifted = 0.0;
    for (const Wall& wall : scene.walls) {
        for (const Vec2& p : points_at_rest(wall)) lowest = std::min(lowest, up.dot(p));
        lifted = std::max(lifted, lift(wall, up));
    }
    return {lowest, std::max(0.0, highest + lifted - lowest)};
}

double largest_speed(const Scene& scene) {
    double fastest = 0.0;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        const Shape& shape = scene.shape_of(k);
        fastest = std::max(fastest, std::sqrt(scene.grains.velocity(k).squaredNorm()) +
                                        std::abs(scene.grains.spin[Grains::at(k)]) * outer_radius(shape));
    }
    double wall_speed = 0.0;
    for (const Wall& wall : scene.walls) wall_speed = std::max(wall_speed, largest_speed(wall));
    const double g = std::sqrt(scene.gravity.squaredNorm());
    return std::sqrt(2.0 * g * largest_drop(scene).height + fastest * fastest) + wall_speed;
}

double critical_time_step(const Scene& scene) {
    double inner = std::numeric_limits<double>::infinity();
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) inner = std::min(inner, inner_radius(scene.shape_of(k)));
    const double speed = largest_speed(scene);
    return speed > 0.0 ? inner / (2.0 * speed) : std::numeric_limits<double>::infinity();
}

}  // namespace polargrain
