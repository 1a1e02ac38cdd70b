#pragma once

#include <memory>
#include <vector>

#include "src/model/sample.h"
#include "src/observe/kind.h"

namespace polargrain::testing {

/// A scene with gravity downwards, the material "stone" and disks of the given radius at the given places.
inline Scene disks_at(const std::vector<Vec2>& places, double radius = 0.01) {
    Scene scene;
    scene.materials.add({"stone", 2000.0, {}, 0.0});
    scene.gravity = {0.0, -9.81};
    const ShapeIndex disk = scene.add(std::make_shared<const Shape>(Disk("disk", radius)));
    for (const Vec2& place : places) scene.add(Grain{disk, 0, place});
    return scene;
}

inline GrainMask all_of(const Scene& scene) { return GrainMask(scene.grains.x.size(), 1); }

/// An open box: left wall, floor and right wall in one chain called "box", its lower left corner at the origin.
inline void add_open_box(Scene& scene, double width, double height) {
    scene.walls.push_back({"box", 0, {{0.0, height}, {0.0, 0.0}, {width, 0.0}, {width, height}}, {}, std::nullopt});
}

/// A grain a that presses on b with the impulse [N s/m] along the line of their centres.
inline Contact press(const Scene& scene, BodyIndex a, BodyIndex b, double impulse) {
    Contact c;
    c.a = a;
    c.b = b;
    c.normal = unit(scene.grains.position(b) - scene.grains.position(a));
    c.point = 0.5 * (scene.grains.position(a) + scene.grains.position(b));
    c.impulse = impulse * c.normal;
    return c;
}

/// Wall w presses on grain b at the point.
inline Contact press(const Scene& scene, int wall, BodyIndex b, const Vec2& point, double impulse) {
    Contact c;
    c.a = wall_body(wall);
    c.b = b;
    c.normal = unit(scene.grains.position(b) - point);
    c.point = point;
    c.impulse = impulse * c.normal;
    return c;
}

}  // namespace polargrain::testing
