#include "src/record/trajectory_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

constexpr double k_most = 1e100;

bool good(double value) { return std::abs(value) < k_most; }
bool good(const Vec2& point) { return good(point.x()) && good(point.y()); }

template <typename Index>
void expect_indices(const std::vector<Index>& indices, std::size_t count, const char* what) {
    const bool whole =
        std::ranges::all_of(indices, [count](Index k) { return k >= 0 && static_cast<std::size_t>(k) < count; });
    expect_whole(whole, fmt::format("a grain is of a {} that is not there", what));
}

bool is_body(BodyIndex body, const Scene& scene) {
    return is_wall(body) ? static_cast<std::size_t>(wall_index(body)) < scene.walls.size()
                         : static_cast<std::size_t>(body) < scene.grains.mass.size();
}

}  // namespace

void expect_whole(bool condition, const std::string& message) {
    if (!condition) throw h5::Failure(message);
}

void expect_numbers(std::span<const double> values, const std::string& what) {
    expect_whole(std::ranges::all_of(values, [](double value) { return good(value); }),
                 what + " is no number, or far too large");
}

void expect_whole(const Scene& scene) {
    expect_whole(good(scene.gravity), "gravity is no number");
    for (const auto& shape : scene.shapes) {
        expect_whole(good(area(*shape)) && good(polar_moment(*shape)) && good(outer_radius(*shape)),
                     fmt::format("the shape {} has no size", name(*shape)));
    }
    for (const Wall& wall : scene.walls) {
        expect_whole(wall.material >= 0 && wall.material < scene.materials.size(),
                     fmt::format("the wall {} is of a material that is not there", wall.name));
        expect_whole(std::ranges::all_of(wall.points, [](const Vec2& p) { return good(p); }),
                     fmt::format("a point of the wall {} is no number", wall.name));
    }
    const Grains& grains = scene.grains;
    const std::size_t n = grains.mass.size();
    expect_whole(grains.inertia.size() == n && grains.shape.size() == n && grains.material.size() == n,
                 "it has not as many masses as grains");
    expect_indices(grains.shape, scene.shapes.size(), "shape");
    expect_indices(grains.material, static_cast<std::size_t>(scene.materials.size()), "material");
    expect_numbers(grains.mass, "the mass of a grain");
    expect_numbers(grains.inertia, "the inertia of a grain");
}

void expect_whole(const Contact& contact, const Scene& scene) {
    expect_whole(is_body(contact.a, scene) && is_body(contact.b, scene), "a contact is of a grain that is not there");
}

}  // namespace polargrain
