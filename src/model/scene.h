#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "src/geometry/shape.h"
#include "src/model/grains.h"
#include "src/model/materials.h"
#include "src/model/wall.h"

namespace polargrain {

/// The problem: what there is at time zero and what acts on it. An engine solves it and never changes it.
struct Scene {
    std::vector<std::shared_ptr<const Shape>> shapes;
    Materials materials;
    std::vector<Wall> walls;
    Grains grains;
    Vec2 gravity = Vec2::Zero();  ///< [m/s^2], in the frame in which an incline lies along x: g (sin beta, -cos beta)
    std::uint64_t seed = 1;
    int threads = 1;

    ShapeIndex add(std::shared_ptr<const Shape> shape);
    /// Mass and inertia follow from shape and density.
    GrainIndex add(const Grain& grain);

    const Shape& shape(ShapeIndex s) const { return *shapes[static_cast<std::size_t>(s)]; }
    const Shape& shape_of(GrainIndex k) const { return shape(grains.shape[Grains::at(k)]); }
};

/// A state of the problem. time = step x dt, never a running sum.
struct World {
    double time = 0.0;      ///< [s]
    std::int64_t step = 0;  ///< steps taken
    Grains grains;
};

World initial_world(const Scene& scene);

/// Kinetic and potential energy per metre of depth [J/m]; potential measured from the origin, against gravity.
struct Energy {
    double translational = 0.0;
    double rotational = 0.0;
    double potential = 0.0;
    double kinetic() const { return translational + rotational; }
    double total() const { return kinetic() + potential; }
};

Energy energy(const Grains& grains, const Vec2& gravity);

/// Fingerprint of the exact bits of the state: step, poses, velocities.
std::string state_hash(const World& world);

/// Extent of a scene along gravity: what can fall how far.
struct Drop {
    double lowest = 0.0;  ///< least height of any wall point at rest or grain [m], heights measured against gravity
    double height = 0.0;  ///< H: largest possible drop of a grain [m], also of one that a wall lifts until it stops
};

Drop largest_drop(const Scene& scene);

/// Speed that grains reach at most while none falls farther than the largest drop H: sqrt(2 g H + v0^2), v0 the largest
/// initial speed of any point of one, plus the largest wall speed [m/s].
double largest_speed(const Scene& scene);

/// Largest time step at which no grain can pass its neighbour unseen: R_in / (largest closing speed) [HN94, eq. 6].
///
/// The closing speed is 2 v, v = sqrt(2 g H + v0^2) with the largest initial speed v0 (the paper starts from
/// rest), and with moving walls 2 (v + largest wall speed). Infinite where nothing can ever move.
double critical_time_step(const Scene& scene);

}  // namespace polargrain
