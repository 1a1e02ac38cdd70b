#include "tests/support/scenes.h"

#include <algorithm>
#include <cmath>

#include "shapes/library.h"
#include "shapes/outline.h"
#include "shapes/shape_spec.h"
#include "src/core/random.h"

namespace polargrain::testing {

Scene empty_scene(double restitution, double friction, double gravity) {
    Scene scene;
    scene.materials.add({"stone", 2000.0, {restitution, 0.0}, friction});
    scene.gravity = {0.0, -gravity};
    return scene;
}

void add_wall(Scene& scene, const std::string& name, std::vector<Vec2> points, WallMotion motion) {
    scene.walls.push_back({name, 0, std::move(points), std::move(motion), std::nullopt});
}

void add_box(Scene& scene, double width, double height) {
    add_wall(scene, "box", {{0.0, height}, {0.0, 0.0}, {width, 0.0}, {width, height}});
}

namespace {

ShapeIndex add_spec(Scene& scene, const std::string& name, const ShapeSpec& spec, std::uint64_t draw = 0) {
    return scene.add(std::make_shared<const Shape>(make_shape(name, spec, scene.seed, draw)));
}

}  // namespace

ShapeIndex add_rectangle(Scene& scene, double width, double height, int vertices) {
    return add_spec(scene, "rectangle", RectangleSpec{width, height, vertices});
}

ShapeIndex add_disk(Scene& scene, double radius) { return add_spec(scene, "disk", DiskSpec{radius}); }

ShapeIndex add_star(Scene& scene, double radius, double inner_radius, int points) {
    return add_spec(scene, "star", StarSpec{radius, inner_radius, points});
}

ShapeIndex add_stick(Scene& scene, double length, double width) {
    return add_spec(scene, "stick", StickSpec{length, width, 16});
}

ShapeIndex add_rough(Scene& scene, double radius, double roughness, std::uint64_t draw) {
    RoughSpec spec;
    spec.radius = radius;
    spec.roughness = roughness;
    return add_spec(scene, "rough", spec, draw);
}

Scene pour(PourShape shape, int n, std::uint64_t seed, double restitution, double friction, int columns) {
    const double d = 0.02;
    Scene scene = empty_scene(restitution, friction);
    scene.seed = seed;
    const double width = columns * d;
    const double pitch = 1.35 * d;
    const int per_row = static_cast<int>((width - 0.1 * d) / pitch);
    const int rows = (n + per_row - 1) / per_row;
    add_box(scene, width, (rows + 2) * pitch + width);
    RandomStream random(seed, RandomPurpose::test);
    const ShapeIndex disk = shape == PourShape::disk || shape == PourShape::mixed ? add_disk(scene, 0.5 * d) : -1;
    const ShapeIndex star =
        shape == PourShape::star || shape == PourShape::mixed ? add_star(scene, 0.6 * d, 0.25 * d, 5) : -1;
    const ShapeIndex stick =
        shape == PourShape::stick || shape == PourShape::mixed ? add_stick(scene, 1.3 * d, 0.3 * d) : -1;
    for (int k = 0; k < n; ++k) {
        Grain grain;
        const int kind = shape == PourShape::mixed ? k % 4 : static_cast<int>(shape);
        if (kind == static_cast<int>(PourShape::rough)) {
            grain.shape = add_rough(scene, 0.5 * d, 0.2, static_cast<std::uint64_t>(k));
        } else {
            grain.shape = kind == static_cast<int>(PourShape::disk)   ? disk
                          : kind == static_cast<int>(PourShape::star) ? star
                                                                      : stick;
        }
        const double margin = 0.5 * (width - (per_row - 1) * pitch);
        const int row = k / per_row;
        grain.position = {margin + (k % per_row) * pitch, d + row * pitch};
        grain.angle = random.uniform(-k_pi, k_pi);
        grain.velocity = {0.1 * random.normal(), 0.1 * random.normal()};
        scene.add(grain);
    }
    return scene;
}

Scene pour_outline(const std::string& outline, int n, int across, std::uint64_t seed) {
    const double d = 0.02;
    Scene scene = empty_scene(0.3, 0.3);
    scene.seed = seed;
    const OutlineFile file = find_outline(outline, shape_library_folder());
    const double reach = prepare_outline(outline, file.points).outer_radius();
    std::vector<Vec2> points = file.points;
    for (Vec2& p : points) p *= 0.5 * d / reach;
    const ShapeIndex shape = scene.add(std::make_shared<const Shape>(prepare_outline(outline, points)));
    const int rows = (n + across - 1) / across;
    add_box(scene, (1.1 * across + 1.0) * d, (1.05 * rows + 8.0) * d);
    RandomStream random(seed, RandomPurpose::test);
    for (int k = 0; k < n; ++k) {
        const int row = k / across;
        const Vec2 place{(1.05 + 1.1 * (k % across)) * d, (0.6 + 1.05 * row) * d};
        scene.add(Grain{shape, 0, place, random.uniform(-k_pi, k_pi), {0.1 * random.normal(), 0.0}});
    }
    return scene;
}

std::vector<std::string> shipped_outlines() {
    std::vector<std::string> names;
    for (const OutlineFile& file : shape_library()) names.push_back(file.name);
    return names;
}

std::string test_name(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

Scene mirrored(Scene scene) {
    for (auto& wall : scene.walls) {
        for (Vec2& p : wall.points) p.x() = -p.x();
        std::reverse(wall.points.begin(), wall.points.end());
    }
    for (auto& shape : scene.shapes) {
        const auto& polygon = std::get<PolarPolygon>(*shape);
        std::vector<Vec2> vertices = polygon.vertices();
        for (Vec2& v : vertices) v.x() = -v.x();
        std::reverse(vertices.begin(), vertices.end());
        shape = std::make_shared<const Shape>(
            PolarPolygon(polygon.name(), vertices, {polygon.area(), Vec2::Zero(), polygon.polar_moment()}));
    }
    for (auto* values : {&scene.grains.x, &scene.grains.angle, &scene.grains.vx, &scene.grains.spin}) {
        for (double& v : *values) v = -v;
    }
    return scene;
}

}  // namespace polargrain::testing
