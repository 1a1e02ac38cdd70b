#pragma once

#include <cstdint>
#include <vector>

#include "src/core/hash.h"
#include "src/core/vec2.h"
#include "src/geometry/pose.h"
#include "src/model/materials.h"

namespace polargrain {

using GrainIndex = std::int32_t;
using ShapeIndex = std::int32_t;

/// State of all grains as a structure of arrays; entry k of each belongs to grain k.
///
/// Centre of mass [m], angle [rad] counter-clockwise, velocity [m/s], spin [rad/s]; mass and inertia (about the
/// centre of mass) per metre of depth [kg/m, kg m].
struct Grains {
    std::vector<double> x, y, angle;
    std::vector<double> vx, vy, spin;
    std::vector<double> mass, inertia;
    std::vector<ShapeIndex> shape;
    std::vector<MaterialIndex> material;

    GrainIndex size() const { return static_cast<GrainIndex>(x.size()); }
    bool empty() const { return x.empty(); }

    Vec2 position(GrainIndex k) const { return {x[at(k)], y[at(k)]}; }
    Vec2 velocity(GrainIndex k) const { return {vx[at(k)], vy[at(k)]}; }
    Pose pose(GrainIndex k) const { return Pose::at(position(k), angle[at(k)]); }
    void set_position(GrainIndex k, const Vec2& p) { x[at(k)] = p.x(), y[at(k)] = p.y(); }
    void set_velocity(GrainIndex k, const Vec2& v) { vx[at(k)] = v.x(), vy[at(k)] = v.y(); }

    static std::size_t at(GrainIndex k) { return static_cast<std::size_t>(k); }
};

/// One grain, as it is put into Grains.
struct Grain {
    ShapeIndex shape = 0;
    MaterialIndex material = 0;
    Vec2 position = Vec2::Zero();
    double angle = 0.0;
    Vec2 velocity = Vec2::Zero();
    double spin = 0.0;
};

}  // namespace polargrain
